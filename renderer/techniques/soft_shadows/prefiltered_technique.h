// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/techniques/soft_shadows/prefiltered_settings.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {

/// Binding of a technique's windows, a variant of some of AnyWindow's alternatives.
template <class S, class... W>
Binding<S> windowBinding(std::variant<W...> S::*member) {
  return {member, "window", "Window that is averaged", "Schwarz 2009, section 3.2.1"};
}

/// Base of the techniques that average a shadow map before they compare with it (SS-03): one lookup of a
/// window instead of many comparisons. The window is fixed, or sized as for percentage-closer soft shadows by
/// the average depth of the blockers; the part beyond the map counts as lit, as nothing is known to block
/// there. The shader includes prefiltered_window.glsl and defines estimate().
class PrefilteredTechnique : public VisibilityTechnique {
 public:
  std::vector<Counter> count(frame::Frame& frame) override;
  /// Registration of a technique with that name and summary.
  static TechniqueInfo info(std::string name, std::string summary);

 protected:
  /// `prefilter` is common.prefilterSettings() with the technique's encoding of depths.
  template <class... W>
  PrefilteredTechnique(const std::string& name, const PrefilteredSettings& common,
                       const std::variant<W...>& window, const frame::PrefilterSettings& prefilter)
      : PrefilteredTechnique(name, common,
                             std::visit([](const auto& chosen) { return AnyWindow(chosen); }, window),
                             prefilter) {}
  PrefilteredTechnique(const std::string& name, const PrefilteredSettings& common, const AnyWindow& window,
                       const frame::PrefilterSettings& prefilter);
  const frame::LightFrustum& bindMap(frame::Frame& frame) override;
  void configure(const gl::Program& program) const override;

 private:
  frame::PrefilterSettings prefilter_;
  AnyWindow window_;
  const frame::PrefilteredMap* map_ = nullptr;
};

}  // namespace limen::techniques
