// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/parameter.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/scene/scene.h"

namespace limen::techniques {

/// The shadow maps whose occluders a bitmask joins: maps, layers, peel_bias, later_extent, light_points,
/// point_spread, updates. Source: Schwarz 2009, section 4.2.2.
class LightMaps {
 public:
  static std::vector<Parameter> parameters();
  /// Throws Error where values of these parameters do not go together.
  static void check(const ParameterValues& values);

  explicit LightMaps(const ParameterValues& values);

  /// Each object has a map and masks of its own, which stay while the object does.
  bool perObject() const { return perObject_; }
  /// Objects that a frame looks at anew, in turn; 0: all.
  size_t updates() const { return updates_; }
  /// Maps of a scene's first light, `usual` being the one from its centre. Throws Error where a scene has no
  /// such maps.
  std::vector<frame::ShadowMapSettings> of(const scene::Scene& scene, frame::ShadowMapSettings usual) const;

 private:
  std::string maps_;
  int layers_, points_;
  double peelBias_, laterExtent_, pointSpread_;
  size_t updates_;
  bool perObject_;
};

}  // namespace limen::techniques
