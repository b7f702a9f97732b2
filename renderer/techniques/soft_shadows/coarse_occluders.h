// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/frame/microrect_map.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

inline constexpr int64_t kDefaultBudget = 256;  ///< micro-occluders for a pixel

/// Which level of the shadow map micro-occluders come from other than by the budget, and those kinds of them
/// that only coarse levels have: microrects and morphing microquads. Sources: Schwarz 2009, sections 4.5 and
/// 5.1.2.
class CoarseOccluders {
 public:
  /// `values` must hold parameters(), and `occluders`, `budget` and `resolution`.
  explicit CoarseOccluders(const ParameterValues& values);
  static std::vector<Parameter> parameters(bool morphing);
  /// Throws Error where values of these parameters do not go together.
  static void check(const ParameterValues& values);

  /// Whether all pixels use one level.
  bool isFixed() const { return fixedLevel_ >= 0; }
  /// Makes what the occluders are read from; binds nothing that lasts.
  void make(frame::Frame& frame, const frame::ShadowMapSettings& map);
  /// From texture unit 10.
  void bind() const;
  void configure(const gl::Program& program) const;
  /// Of what is kept for these occluders alone; 0 where they come from the pyramid.
  int64_t bytes() const { return rects_ ? rects_->bytes() : 0; }

 private:
  bool microrects_;
  frame::MergeRule rule_;
  int fixedLevel_;  // below 0: by the budget
  float morphLevel_ = 0.0F;
  const frame::MicrorectLevels* rects_ = nullptr;
};

}  // namespace limen::techniques
