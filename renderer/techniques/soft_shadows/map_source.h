// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "renderer/gl/program.h"
#include "renderer/techniques/soft_shadows/bitmask/light_maps.h"
#include "renderer/techniques/soft_shadows/map_settings.h"

namespace limen::techniques {

/// The shadow maps whose occluders a technique combines, and those that a frame reads.
class MapSource {
 public:
  MapSource(const MapSettings& map, const MapChoice& choice);

  /// Throws Error if the scene has no such maps.
  void prepare(const scene::Scene& scene);
  /// At least one; valid from prepare() on.
  const std::vector<frame::ShadowMapSettings>& maps() const { return maps_; }
  /// Passes over pixels that read them all.
  size_t passes() const { return maps_[0].together > 1 ? 1 : maps_.size(); }
  /// Those that a pass reads.
  std::span<const frame::ShadowMapSettings> mapsOf(size_t pass) const {
    return passes() == 1 ? std::span(maps_) : std::span(maps_).subspan(pass, 1);
  }
  /// For the shader of the search; valid from prepare() on.
  gl::ShaderDefines defines() const;
  /// Each map has its own masks, which are reused while its object does not change.
  bool perObject() const { return std::holds_alternative<ObjectMaps>(choice_); }

  /// Decides which maps the frame at this time reads: all, or some in turn while the camera rests.
  void choose(double timeS);
  void chooseAll() { isDue_.assign(maps_.size(), true); }
  bool isDue(size_t map) const { return isDue_[map]; }
  /// Maps that a frame reads while the camera rests.
  size_t mapsAtRest() const;

 private:
  frame::ShadowMapSettings usual_;
  MapChoice choice_;
  std::vector<frame::ShadowMapSettings> maps_;
  std::vector<bool> isDue_;  ///< of each map
  size_t nextUpdate_ = 0;
  double readForS_ = 0.0;  ///< time whose camera the last frame had
  bool wasRead_ = false;
};

}  // namespace limen::techniques
