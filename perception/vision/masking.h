// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "experiments/base/registry.h"

/// Contrast masking within a channel. Contrasts c are CSF-normalised (1: just visible). All are finite for
/// any finite argument; NaN and infinity give 0. Source: Schwarz 2009, section 9.1.2.
namespace limen::perception {

/// Threshold elevation of Daly 1993 (9.7), c >= 0 (its magnitude is taken).
double elevationDaly(double c, double k1 = 0.0153, double k2 = 392.498, double b = 4.0, double s = 0.7);
/// Transducer of Lubin 1995 (9.8), odd in c.
double transducerLubin(double c, double n = 2.2, double w = 0.2);
/// Self-masking of JPEG 2000: sign(c) |c|^alpha.
double selfMask(double c, double alpha = 0.7);
/// Point-wise extended masking of JPEG 2000 (reconstructed): `neighbourMean` is the mean of |x_k|^beta.
double pointwiseExtendedMask(double x, double neighbourMean, double alpha = 0.7, double a = 1.0);
/// The thesis's transducer (9.9): c / (1 + |c|^(s b))^(1/b), with s = 0.3, b = 10.
double transducerSchwarz(double c);
/// Elevation that (9.9) amounts to: c / transducer.
double elevationSchwarz(double c);
/// Transducer that belongs to an elevation: c / elevation(|c|).
double transducerDaly(double c, double k1 = 0.0153, double k2 = 392.498, double b = 4.0, double s = 0.7);

/// A point-wise model with its constants bound, in both forms; each follows from the other.
struct Masking {
  std::function<double(double)> elevation;   ///< of |c|, >= 1 where the model knows no facilitation
  std::function<double(double)> transducer;  ///< odd in c
};
/// Registration: "none", "daly", "lubin", "self", "schwarz".
struct MaskingInfo {
  static constexpr const char* kKind = "masking model";
  std::string name;
  std::string summary;
  std::string source;
  std::vector<Parameter> parameters;
  std::function<Masking(const ParameterValues&)> make;
};
using MaskingRegistry = Registry<MaskingInfo>;
Masking makeMasking(const std::string& name, const std::string& where = {});

}  // namespace limen::perception
