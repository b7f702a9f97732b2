// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/coarse_occluders.h"

#include <cmath>

#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {
CoarseOccluders::CoarseOccluders(const OccluderChoice& occluders, const LevelSettings& levels)
    : occluders_(occluders) {
  if (const auto* fixed = std::get_if<FixedLevel>(&levels)) fixedLevel_ = fixed->level;
  if (occluders.morphLevel) fixedLevel_ = static_cast<int>(std::floor(*occluders.morphLevel));
}

void CoarseOccluders::make(frame::Frame& frame, const frame::ShadowMapSettings& map) {
  if (occluders_.kind == OccluderKind::Microrects)
    rects_ = &frame.get<frame::MicrorectMap>(frame::MicrorectSettings{map, occluders_.merge}).levels();
}

void CoarseOccluders::bind() const {
  if (!rects_) return;
  rects_->sharedDepths().bindTexture(kRectDepthsUnit);
  rects_->sharedExtents().bindTexture(kRectExtentsUnit);
}

void CoarseOccluders::configure(const gl::Program& program) const {
  program.set("fixedLevel", fixedLevel_);
  if (occluders_.morphLevel) program.set("morphLevel", static_cast<float>(*occluders_.morphLevel));
}

}  // namespace limen::techniques
