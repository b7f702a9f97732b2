// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/frame/prefiltered_map.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {

/// What averages are taken from, the first of `prefilters` being the default.
Parameter prefilterParameter(std::vector<std::string> prefilters);
frame::Prefilter prefilterOf(const ParameterValues& values);

/// Base of the techniques that average a shadow map before they compare with it (SS-03): one look-up of a
/// window instead of many comparisons. The window is fixed, or as wide as percentage-closer soft shadows have
/// it, from the average depth of the blockers; the part of it that lies beyond the map is lit, as nothing is
/// known to block there. The shader includes prefiltered_window.glsl and defines estimate().
class PrefilteredTechnique : public VisibilityTechnique {
 public:
  std::vector<Counter> count(frame::Frame& frame) override;
  static std::vector<Quantity> counterNames();
  /// Common parameters and those of window and averages. `windows` are the kinds of window that the technique
  /// has, the first being the default; `prefilters` likewise.
  static std::vector<Parameter> prefilterParameters(std::vector<std::string> windows,
                                                    std::vector<std::string> prefilters);
  /// What they all declare, with a name, a version, a summary and parameters of its own. `check` holds
  /// checkPrefilter().
  static TechniqueInfo declare(std::string name, int version, std::string summary,
                               std::vector<Parameter> parameters, decltype(TechniqueInfo::make) make,
                               decltype(TechniqueInfo::check) check = checkPrefilter);
  /// Refuses parameters of what is not there, and values too long for their sums.
  static void checkPrefilter(const ParameterValues& values);
  /// Map, way of averaging, form of the sums, as `values` has them.
  static frame::PrefilterSettings settingsOf(const ParameterValues& values);

 protected:
  PrefilteredTechnique(const ParameterValues& values, const std::string& name,
                       const frame::PrefilterSettings& settings);
  const frame::LightFrustum& bindMap(frame::Frame& frame) override;
  void configure(const gl::Program& program) const override;

 private:
  frame::PrefilterSettings settings_;
  double searchScale_, filterRadius_;
  int searchTaps_;
  const frame::PrefilteredMap* map_ = nullptr;
};

}  // namespace limen::techniques
