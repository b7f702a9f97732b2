// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "experiments/base/parameter_list.h"
#include "experiments/base/registry.h"
#include "experiments/base/settings_table.h"

namespace limen::perception {

/// Everything that a contrast sensitivity may depend on; each model reads what it uses.
struct CsfPoint {
  double frequencyCpd = 1.0;     ///< spatial
  double velocityDegS = 0.15;    ///< retinal; the drift of a fixating eye is about 0.15
  double luminanceCdM2 = 100.0;  ///< adaptation luminance
  double areaDeg2 = 187.0;       ///< of the stimulus
  double widthDeg = 17.0;        ///< angular display width
  double orientationDeg = 0.0;   ///< 0: along an axis
  double eccentricityDeg = 0.0;
  double distanceM = 0.6;  ///< of the viewer
};

enum class Channel { Achromatic, RedGreen, BlueYellow };

/// A contrast sensitivity function: 1 / threshold contrast. Finite and >= 0 for every argument, NaN included
/// (then 0). Arguments outside the valid range are clamped to it if the model would diverge, otherwise
/// extrapolated; each model's summary says which.
class Csf {
 public:
  virtual ~Csf() = default;
  virtual double sensitivity(const CsfPoint& point) const = 0;
  /// Largest sensitivity over spatial frequency, other arguments as in `point`; and where it is.
  struct Peak {
    double frequencyCpd = 0.0, sensitivity = 0.0;
  };
  /// Golden section on lg frequency in [0.05, 60] cpd unless a model overrides it.
  virtual Peak peak(const CsfPoint& point) const;
};

/// An argument a model reads, with the range its data cover.
struct CsfArgument {
  std::string name;  ///< of the member of CsfPoint, snake_case: "frequency_cpd"
  std::string unit;
  double validLow = 0.0, validHigh = 0.0;
};

/// Registration of a model: "barten89", "barten89_size", "barten03", "martin92", "martin92_rg",
/// "martin92_by", "daly93", "kelly79", "daly98", "burbeck_kelly80", "kelly83", and a modern comparator.
struct CsfInfo {
  static constexpr const char* kKind = "contrast sensitivity function";
  std::string name;
  int version = 1;
  std::string summary;  ///< including its behaviour outside the valid range
  std::string source = {};
  Channel channel = Channel::Achromatic;
  std::vector<CsfArgument> arguments = {};
  ParameterList parameters = {};  ///< constants of the model, with their defaults (daly98: c0, c1, c2 ...)
  std::function<std::unique_ptr<Csf>(const ParameterValues&)> make = {};
};
using CsfRegistry = Registry<CsfInfo>;

/// Registers a model with constants S (settings_table.h) at program start. `info` provides the rest; its
/// parameters and make are filled in. `defaults` are the constants of this registration.
template <class S>
struct RegisteredCsf {
  RegisteredCsf(CsfInfo info, std::unique_ptr<Csf> (*make)(const S&), const S& defaults = {}) {
    info.parameters = ParameterList([defaults] { return S::table().parameters(defaults); });
    info.make = [make](const ParameterValues& values) { return make(S::table().read(values)); };
    CsfRegistry::instance().add(std::move(info));
  }
};

/// The model with its default constants. Throws Error naming the nearest known model.
std::unique_ptr<Csf> makeCsf(const std::string& name, const std::string& where = {});
/// Names for a choice parameter.
std::vector<std::string> csfNames(Channel channel);
/// Member of `point` by its name in CsfArgument; the name must be one of them.
double argumentOf(const CsfPoint& point, const std::string& name);
double& argumentOf(CsfPoint& point, const std::string& name);
/// All names of arguments, in the order of CsfPoint's members.
const std::vector<std::string>& csfArgumentNames();
/// Names of the arguments of `info` whose value in `point` lies outside the valid range.
std::vector<std::string> outsideValidRange(const CsfInfo& info, const CsfPoint& point);

}  // namespace limen::perception
