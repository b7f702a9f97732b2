// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/parameter.h"
#include "renderer/gl/program.h"

namespace limen::techniques {

/// How the level of a pixel's micro-occluders is chosen, smoothed and blended: Schwarz 2009, sections 5.2.1
/// and 5.2.2, with what they advise against as controls.
class LevelOfQuality {
 public:
  /// `passes`, `levels` and what goes with them.
  static std::vector<Parameter> parameters();
  /// Throws Error where values of these parameters do not go together.
  static void check(const ParameterValues& values);

  explicit LevelOfQuality(const ParameterValues& values);

  /// Classify, smooth and gather in passes of their own.
  bool splits() const { return splits_; }
  /// The list of pixels is put in the order of their loops' lengths.
  bool orders() const { return orders_; }
  /// Half of the filter's support in pixels, without its middle; 0: levels are not smoothed.
  int smoothingRadius() const { return smoothingRadius_; }
  /// Pixels of one level may choose differently.
  bool dithers() const { return levels_ == Levels::Dither; }
  /// Adds to `defines` what level_of_quality.glsl reads.
  void define(gl::ShaderDefines& defines) const;
  /// Sets the uniforms of level_of_quality.glsl, `budgetPerAxis` aside.
  void configure(const gl::Program& program) const;
  /// Sets those of smooth_levels.comp.glsl that do not change from axis to axis.
  void configureSmoothing(const gl::Program& program) const;

 private:
  enum class Levels { FinestWithin, CoarsestOver, Blend, NarrowBlend, Dither };
  static Levels levelsOf(const ParameterValues& values);

  bool splits_, orders_, filtered_;
  Levels levels_;
  int smoothingRadius_;
  double blendWidth_, sigma_, depthThreshold_;
};

}  // namespace limen::techniques
