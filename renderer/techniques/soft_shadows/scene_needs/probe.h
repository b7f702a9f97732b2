// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "renderer/techniques/soft_shadows/backprojection/backprojection_settings.h"
#include "renderer/techniques/soft_shadows/bitmask/bitmask_settings.h"
#include "renderer/techniques/soft_shadows/pixel_counts.h"

namespace limen::techniques {

/// A hard shadow, which has only a map to choose, or soft ones.
using ShadowSetting = std::variant<MapSettings, BackprojectionSettings, BitmaskSettings>;
/// Its technique's registered name.
std::string techniqueOf(const ShadowSetting& setting);
std::unique_ptr<Technique> makeTechnique(const ShadowSetting& setting);
/// The technique, and "name=value" of everything that differs from its defaults.
std::string describe(const ShadowSetting& setting);

/// The result of a setting in a small picture of the scene.
struct Probed {
  std::vector<float> visibility;
  PixelCounts counted;
  double examined = 0.0;     ///< micro-occluders examined, over all pixels
  double processed = 0.0;    ///< pixels
  double coarseShare = 0.0;  ///< of the processed pixels, those with micro-occluders of level 2 and coarser
  double levelChangeShare = 0.0;  ///< of neighbours that are both processed, those that differ in level
};

/// Renders settings in a small picture of a frame's view, independent of the frame: its passes and inputs are
/// not touched.
class ShadowProbe {
 public:
  /// The picture has 1/`divisor` of the frame's width and height, at least 1 px.
  ShadowProbe(frame::Frame& frame, int divisor);
  /// Waits for the GPU. The technique must count pixels.
  Probed run(const ShadowSetting& setting);
  /// Widest penumbra that the scene's depths allow, in texels of a map: the light's extent as seen from the
  /// farthest receiver past the nearest caster. 0 without receivers or casters.
  double penumbraTexels(const frame::ShadowMapSettings& map);
  glm::ivec2 sizePx() const { return frame_.sizePx(); }

 private:
  frame::Frame frame_;
};

/// Mean of |a - b| over the pixels that `a` finds in shadow or penumbra (umbra or processed); 0 without any.
double meanDifference(const Probed& a, const Probed& b);
/// Mean of max(b - a, 0) over the same: light that `b` lets through.
double meanLightGained(const Probed& a, const Probed& b);

}  // namespace limen::techniques
