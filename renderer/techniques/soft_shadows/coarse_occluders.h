// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/occluder_kinds.h"
#include "renderer/techniques/soft_shadows/quality/level_settings.h"

namespace limen::techniques {

/// Selection of the shadow-map level of micro-occluders other than by the budget, and the kinds of
/// micro-occluder that only coarse levels have: microrects and morphing microquads. Sources: Schwarz 2009,
/// sections 4.5 and 5.1.2.
class CoarseOccluders {
 public:
  CoarseOccluders(const OccluderChoice& occluders, const LevelSettings& levels);

  /// Whether all pixels use one level.
  bool isFixed() const { return fixedLevel_ >= 0; }
  /// Makes what the occluders are read from; leaves no bindings behind.
  void make(frame::Frame& frame, const frame::ShadowMapSettings& map);
  void bind() const;
  void configure(const gl::Program& program) const;
  /// Memory stored only for these occluders; 0 if they come from the pyramid.
  int64_t bytes() const { return rects_ ? rects_->bytes() : 0; }

 private:
  OccluderChoice occluders_;
  int fixedLevel_ = -1;  // below 0: by the budget
  const frame::MicrorectLevels* rects_ = nullptr;
};

}  // namespace limen::techniques
