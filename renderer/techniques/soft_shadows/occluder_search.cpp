// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/occluder_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer/frame/sampled_pyramid.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/visibility_pass.h"

namespace limen::techniques {
OccluderSearch::OccluderSearch(const SearchSettings& settings, const LevelSettings& levels,
                               const OccluderChoice& occluders)
    : budget_(mostOf(settings.budget)),
      refinements_(settings.refinements),
      structure_(settings.structure),
      occluders_(occluders),
      cells_(cellsOf(settings, occluders, levels)),
      coarse_(occluders, levels),
      bias_(settings.bias) {}

gl::ShaderDefines OccluderSearch::defines() const {
  gl::ShaderDefines defines = bias_.defines();
  occluders_.define(defines);
  if (cells_) defines["SEARCH_CELLS"] = "1";
  defineStructure(structure_, defines);
  // With one level for all pixels, its effect on the shadow is the question: no pixel may avoid it through
  // finer texels.
  if (coarse_.isFixed()) defines["GROW"] = "1";
  return defines;
}

const frame::LightFrustum& OccluderSearch::bind(frame::Frame& frame, const frame::ShadowMapSettings& settings,
                                                size_t map) {
  const auto& pyramid = frame.get<frame::MinMaxPyramid>(settings);
  coarse_.make(frame, settings);
  bias_.make(frame, settings);
  int64_t bytes = pyramid.minimum().bytes() + pyramid.maximum().bytes();
  const frame::MultiScaleMap* layers = nullptr;
  if (layersOf(structure_)) {
    layers = &frame.get<frame::MultiScaleMap>(multiScaleSettings(structure_, settings));
    baseLevel_ = layers->baseLevel();
    bytes += layers->texture().bytes();
  }
  const frame::SampledPyramid* sampled = nullptr;
  if (const auto texel = sampledTexel(occluders_.depths); texel && !cells_) {
    sampled = &frame.get<frame::SampledPyramid>(settings, frame::SampledTexelSetting{*texel});
    bytes += sampled->atlas().bytes();
  }
  structureBytes_.resize(std::max(structureBytes_.size(), map + 1));
  structureBytes_[map] = bytes;
  // Last, since making the inputs binds textures too.
  if (sampled) sampled->atlas().bindTexture(kSampledDepthsUnit);
  if (layers) layers->texture().bindTexture(kMultiScaleMapUnit);
  coarse_.bind();
  bias_.bind();
  maxIterations_ = maxLoopIterations(frame);
  const BoundPyramid bound = bindPyramid(frame, settings);
  pyramidLevels_ = bound.levels;
  return bound.frustum;
}

void OccluderSearch::configure(const gl::Program& program) const {
  coarse_.configure(program);
  bias_.configure(program);
  program.set("levels", pyramidLevels_);
  program.set("maxIterations", maxIterations_);
  program.set("refinements", refinements_);
  program.set("middleWidth", cells_ ? static_cast<float>(cells_->middle) : 1.0F);
  program.set("shareRoot", cells_ ? static_cast<float>(std::sqrt(cells_->share)) : 1.0F);
  program.set("texelsSpread",
              static_cast<uint32_t>(std::lround(cells_ ? cells_->spread * double{1 << 16} : 0.0)));
  program.set("leastWidth", cells_ ? static_cast<float>(cells_->leastWidth) : 0.0F);
  program.set("widestGap", static_cast<float>(occluders_.gapWidth));
  program.set("roughQueries", roughQueries(structure_));
  program.set("baseLevel", baseLevel_);
  program.set("budgetPerAxis",
              budget_ == 0 ? 1 << 14 : std::max(1, static_cast<int>(std::floor(std::sqrt(double(budget_))))));
}

int64_t OccluderSearch::structureBytes() const {
  return std::accumulate(structureBytes_.begin(), structureBytes_.end(), int64_t{0});
}

}  // namespace limen::techniques
