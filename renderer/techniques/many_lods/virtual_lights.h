// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/techniques/many_lods/radiosity.h"

namespace limen::techniques {

/// Virtual point lights where light of the first light arrives first.
struct VirtualLightSettings {
  int64_t count = 256;
  double turnDeg = 0.0;
  int framesBefore = 0;
  double clamp = 0.05;
  double gain = 10.0;
  static const SettingsTable<VirtualLightSettings>& table();
};

/// Reflective shadow map by rays: light leaves the light's centre with the cosine of its direction along a
/// pattern of directions that is the same in every frame, so that light j stays light j as the light moves;
/// each ray carries an equal share of the light's flux, and what its first surface reflects leaves there
/// diffusely. Makes the view of each light as well, a hemisphere above its surface. The light may turn about
/// the vertical axis through the scene's centre. Source: Holländer 2013, section 3.6.1; rays in place of a
/// map, and pattern R2, are the bench's own.
class VirtualLights {
 public:
  VirtualLights(frame::Frame& frame, const VirtualLightSettings& settings);

  /// Lights of turn `step`: 0 is the scene's own. `tilePx`, `epsilonPx` of their views; `lift`: world units
  /// above the surface at which these stand.
  void make(frame::Frame& frame, int step, int tilePx, double epsilonPx, double lift) const;

  LightSet set() const { return {lights_, views_, count(), leastDistance2_}; }
  const gl::Buffer& lights() const { return lights_; }  ///< VirtualLight each
  const gl::Buffer& views() const { return views_; }    ///< CutView each
  uint32_t count() const { return static_cast<uint32_t>(settings_.count); }
  double range() const { return range_; }  ///< of depths in views, world units

 private:
  VirtualLightSettings settings_;
  double range_, leastDistance2_;
  const gl::Program& program_;
  gl::Buffer lights_, views_;
};

}  // namespace limen::techniques
