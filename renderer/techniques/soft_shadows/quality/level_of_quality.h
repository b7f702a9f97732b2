// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gl/program.h"
#include "renderer/techniques/soft_shadows/quality/level_settings.h"

namespace limen::techniques {

/// How the level of a pixel's micro-occluders is chosen, smoothed and blended: Schwarz 2009, sections 5.2.1
/// and 5.2.2, including what they advise against, as controls.
class LevelOfQuality {
 public:
  LevelOfQuality(const LevelSettings& levels, const PassSettings& passes)
      : levels_(levels), passes_(passes) {}

  /// Classify, smooth and gather in separate passes.
  bool splits() const { return std::holds_alternative<SplitPasses>(passes_); }
  /// The list of pixels is sorted by the length of their loops.
  bool orders() const;
  /// Invocations that share a pixel's loop.
  int lanes() const;
  /// The filter of real-valued levels; null: they are not smoothed, or there are none.
  const LevelFilter* smoothing() const;
  /// Pixels of one level may choose differently.
  bool dithers() const { return ruleOf(levels_) == LevelRule::Dither; }
  /// Adds the defines that level_of_quality.glsl reads.
  void define(gl::ShaderDefines& defines) const;
  /// Sets the uniforms of level_of_quality.glsl, `budgetPerAxis` and `fixedLevel` aside.
  void configure(const gl::Program& program) const;
  /// Sets those of smooth_levels.comp.glsl that do not change from axis to axis.
  void configureSmoothing(const gl::Program& program) const;

 private:
  LevelSettings levels_;
  PassSettings passes_;
};

}  // namespace limen::techniques
