// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/occluder_search.h"

#include <algorithm>
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

int64_t OccluderSearch::Structures::bytes() const {
  return pyramid.minimum().bytes() + pyramid.maximum().bytes() + (layers ? layers->texture().bytes() : 0) +
         (sampled ? sampled->atlas().bytes() : 0);
}

OccluderSearch::Structures OccluderSearch::make(frame::Frame& frame, const frame::ShadowMapSettings& map) {
  coarse_.make(frame, map);
  bias_.make(frame, map);
  const auto texel = cells_ ? std::nullopt : sampledTexel(occluders_.depths);
  return {
      frame.get<frame::MinMaxPyramid>(map),
      layersOf(structure_) ? &frame.get<frame::MultiScaleMap>(multiScaleSettings(structure_, map)) : nullptr,
      texel ? &frame.get<frame::SampledPyramid>(map, frame::SampledTexelSetting{*texel}) : nullptr};
}

const frame::LightFrustum& OccluderSearch::bind(frame::Frame& frame,
                                                std::span<const frame::ShadowMapSettings> maps,
                                                size_t index) {
  structureBytes_.resize(std::max(structureBytes_.size(), index + maps.size()));
  frusta_.clear();
  for (size_t i = 0; i < maps.size(); ++i) {
    const Structures made = make(frame, maps[i]);
    structureBytes_[index + i] = made.bytes();
    frusta_.push_back(made.pyramid.frustum());
  }
  // Last, since making the inputs binds textures too.
  const Structures first = make(frame, maps[0]);
  if (first.sampled) first.sampled->shared().bindTexture(kSampledDepthsUnit);
  if (first.layers) {
    baseLevel_ = first.layers->baseLevel();
    structureLayers_ = first.layers->layers();
    first.layers->shared().bindTexture(kMultiScaleMapUnit);
  }
  coarse_.bind();
  bias_.bind();
  // A shader's loops share what the driver allows.
  maxIterations_ = maxLoopIterations(frame) / static_cast<int>(maps.size());
  const BoundPyramid bound = bindPyramid(frame, maps[0]);
  pyramidLevels_ = bound.levels;
  return bound.frustum;
}

void OccluderSearch::configure(const gl::Program& program) const {
  coarse_.configure(program);
  bias_.configure(program);
  program.set("levels", pyramidLevels_);
  program.set("maxIterations", maxIterations_);
  program.set("refinements", refinements_);
  if (cells_) cells_->configure(program);
  program.set("widestGap", static_cast<float>(occluders_.gapWidth));
  program.set("roughQueries", roughQueries(structure_));
  program.set("baseLevel", baseLevel_);
  program.set("structureLayers", structureLayers_);
  for (size_t i = 0; frusta_.size() > 1 && i < frusta_.size(); ++i) {
    const std::string layer = "[" + std::to_string(i) + "]";
    program.set(("layerTangentLow" + layer).c_str(), glm::vec2(frusta_[i].low));
    program.set(("layerTangentSize" + layer).c_str(), glm::vec2(frusta_[i].high - frusta_[i].low));
  }
  program.set("budgetPerAxis", allowedPerAxis(budget_));
}

int64_t OccluderSearch::structureBytes() const {
  return std::accumulate(structureBytes_.begin(), structureBytes_.end(), int64_t{0});
}

}  // namespace limen::techniques
