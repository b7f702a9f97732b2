// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/base/chosen_entry.h"
#include "experiments/base/parameter_list.h"
#include "experiments/base/registry.h"
#include "experiments/base/settings_table.h"

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

/// A point-wise model with its constants, in both forms; each follows from the other.
struct Masking {
  std::function<double(double)> elevation;   ///< of |c|, >= 1 if the model has no facilitation
  std::function<double(double)> transducer;  ///< odd in c
};
/// Registration: "none", "daly", "lubin", "self", "schwarz".
struct MaskingInfo {
  static constexpr const char* kKind = "masking model";
  std::string name;
  std::string summary;
  std::string source;
  ParameterList parameters = {};
  std::function<Masking(const ParameterValues&)> make = {};
};
using MaskingRegistry = Registry<MaskingInfo>;

/// Registers a model with constants S at program start. `info` provides the rest; its parameters and make are
/// filled in.
template <class S>
struct RegisteredMasking {
  RegisteredMasking(MaskingInfo info, Masking (*make)(const S&)) {
    info.parameters = ParameterList([] { return S::table().parameters(); });
    info.make = [make](const ParameterValues& values) { return make(S::table().read(values)); };
    MaskingRegistry::instance().add(std::move(info));
  }
};

/// Throws Error naming the nearest known model.
Masking makeMasking(const ChosenEntry& chosen, const std::string& where = {});
/// The model with its default constants.
Masking makeMasking(const std::string& name, const std::string& where = {});

// Constants of the models.
struct NoMasking {
  static const SettingsTable<NoMasking>& table();
};
struct DalyMasking {
  double k1 = 0.0153, k2 = 392.498, b = 4.0, s = 0.7;
  static const SettingsTable<DalyMasking>& table();
};
struct LubinMasking {
  double n = 2.2, w = 0.2;
  static const SettingsTable<LubinMasking>& table();
};
struct SelfMasking {
  double alpha = 0.7;
  static const SettingsTable<SelfMasking>& table();
};
struct SchwarzMasking {
  double b = 10.0, s = 0.3;
  static const SettingsTable<SchwarzMasking>& table();
};
/// (9.9) as in the thesis: elevation (1 + |c|^3)^(1/10), for which there is a faster form.
bool isCubic(const ChosenEntry& masking);

}  // namespace limen::perception
