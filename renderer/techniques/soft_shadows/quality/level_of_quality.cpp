// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/level_of_quality.h"

#include <cassert>

namespace limen::techniques {

bool LevelOfQuality::orders() const {
  const auto* split = std::get_if<SplitPasses>(&passes_);
  return split && split->order == WorkOrder::LoopLength;
}

int LevelOfQuality::lanes() const {
  const auto* split = std::get_if<SplitPasses>(&passes_);
  return split ? split->lanes : 1;
}

const LevelFilter* LevelOfQuality::smoothing() const {
  const auto* split = std::get_if<SplitPasses>(&passes_);
  const LevelRule rule = ruleOf(levels_);
  const bool whole = rule == LevelRule::FinestWithin || rule == LevelRule::CoarsestOver;
  return split && !whole ? std::get_if<LevelFilter>(&split->smoothing) : nullptr;
}

void LevelOfQuality::define(gl::ShaderDefines& defines) const {
  defineEnum(defines, "LEVELS", ruleOf(levels_));
  if (sourceOf(levels_) == LevelSource::FilteredDepth) defines["FILTERED_LEVEL"] = "1";
}

void LevelOfQuality::configure(const gl::Program& program) const {
  if (const auto* narrow = std::get_if<NarrowlyBlendedLevels>(&levels_))
    program.set("blendWidth", static_cast<float>(narrow->width));
}

void LevelOfQuality::configureSmoothing(const gl::Program& program) const {
  const LevelFilter* filter = smoothing();
  assert(filter);
  program.set("radius", filter->radius);
  program.set("sigma", static_cast<float>(filter->sigma));
  program.set("depthThreshold", static_cast<float>(filter->depthThreshold));
}

}  // namespace limen::techniques
