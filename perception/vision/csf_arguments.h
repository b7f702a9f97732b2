// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "perception/vision/csf.h"

/// Shared by the files that register contrast sensitivities.
namespace limen::perception {

inline CsfArgument frequencyArgument(double low, double high) { return {"frequency_cpd", "cpd", low, high}; }
inline CsfArgument velocityArgument(double low, double high) {
  return {"velocity_deg_s", "deg/s", low, high};
}
inline CsfArgument luminanceArgument(double low, double high) {
  return {"luminance_cd_m2", "cd/m2", low, high};
}
inline CsfArgument areaArgument(double low, double high) { return {"area_deg2", "deg2", low, high}; }

/// Included by every model: reported peaks differ by far more than the models' shapes.
struct CsfGain {
  double value = 1.0;  ///< factor on the sensitivity
  static const SettingsTable<CsfGain>& table();
};

/// A model that is one function of the point; times `gain`.
class FunctionCsf : public Csf {
 public:
  FunctionCsf(double gain, std::function<double(const CsfPoint&)> function)
      : gain_(gain), function_(std::move(function)) {}
  double sensitivity(const CsfPoint& point) const override { return gain_ * function_(point); }

 private:
  double gain_;
  std::function<double(const CsfPoint&)> function_;
};

inline std::unique_ptr<Csf> makeFunctionCsf(const CsfGain& gain,
                                            std::function<double(const CsfPoint&)> function) {
  return std::make_unique<FunctionCsf>(gain.value, std::move(function));
}

}  // namespace limen::perception
