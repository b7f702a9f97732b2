// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/inner_technique.h"
#include "renderer/techniques/soft_shadows/search_technique.h"

namespace limen::techniques {

/// Where the visibility of a shaded picture is found.
enum class VisibilityLoop {
  OwnPass,     ///< in passes of its own, before the shading pass
  Compute,     ///< in the shading pass, a compute shader
  FullScreen,  ///< in the shading pass, a fragment shader on a triangle over the picture
  Forward      ///< in the shading pass, a fragment shader on the scene's triangles
};
constexpr EnumNames<VisibilityLoop, 4> enumNames(VisibilityLoop) {
  return {{{{VisibilityLoop::OwnPass, "own_pass"},
            {VisibilityLoop::Compute, "compute"},
            {VisibilityLoop::FullScreen, "full_screen"},
            {VisibilityLoop::Forward, "forward"}}}};
}

struct ShadedShadowSettings {
  ChosenEntry inner{"soft_shadows/bitmask", {}};
  VisibilityLoop loop = VisibilityLoop::OwnPass;
  static const SettingsTable<ShadedShadowSettings>& table();
  /// Throws Error if the shading pass cannot evaluate all of the inner technique.
  void check() const;
};

/// The parts of an inner technique that searches a map. Throws Error for any other.
SearchParts innerParts(const ChosenEntry& inner);

}  // namespace limen::techniques
