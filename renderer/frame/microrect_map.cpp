// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/microrect_map.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cassert>

#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

constexpr const char* kMicrorectShader = "renderer/frame/microrect_map.comp.glsl";

const gl::Program& passOf(gl::Context& context, const char* pass, MergeRule rule) {
  gl::ShaderDefines defines = {{pass, "1"}};
  if (rule.metric == MergeMetric::Relative) defines["RELATIVE"] = "1";
  if (rule.diagonal == DiagonalMerge::Nearest) defines["NEAREST_DIAGONAL"] = "1";
  return context.programs().compute(kMicrorectShader, defines);
}

int levelsAbove(int resolution) {
  assert(std::has_single_bit(static_cast<unsigned>(resolution)));
  return std::bit_width(static_cast<unsigned>(resolution)) - 1;
}

}  // namespace

MicrorectLevels::MicrorectLevels(gl::Context& context, const ShadowMapSettings& map, MergeRule rule,
                                 const MicrorectLevels* first)
    : resolution_(map.resolution),
      levels_(levelsAbove(map.resolution)),
      first_(passOf(context, "FIRST_PASS", rule)),
      second_(passOf(context, "SECOND_PASS", rule)),
      depths_(gl::Format::R32F, glm::ivec2(std::max(resolution_ / 2, 1)), std::max(levels_, 1), 0, map,
              first ? &first->depths_ : nullptr),
      extents_(gl::Format::RGBA16UI, glm::ivec2(std::max(resolution_ / 2, 1)), std::max(levels_, 1), 0, map,
               first ? &first->extents_ : nullptr),
      merged_(gl::Format::RGBA16UI, glm::ivec2(std::max(resolution_ / 2, 1))) {}

void MicrorectLevels::build(const gl::Texture& minimum) const {
  minimum.bindTexture(kMicrorectMinimumMapUnit);
  depths().bindTexture(kMicrorectDepthsUnit);
  extents().bindTexture(kMicrorectExtentsUnit);
  merged_.bindTexture(kMicrorectMergedUnit);
  for (int level = 1; level <= levels_; ++level) {
    const int size = resolution_ >> level;
    for (const gl::Program* program : {&first_, &second_}) {
      program->set("sourceLevel", level - 1);
      program->set("size", size);
      if (program == &first_) {
        merged_.bindImage(kMicrorectMergedImage, gl::Access::Write);
      } else {
        depths().bindImage(kMicrorectDepthsImage, gl::Access::Write, level - 1);
        extents().bindImage(kMicrorectExtentsImage, gl::Access::Write, level - 1);
      }
      program->dispatch(glm::ivec2(size));
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
  }
}

MicrorectMap::MicrorectMap(Frame& frame, MicrorectSettings settings)
    : settings_(settings),
      levels_(frame.context(), settings.map, settings.rule,
              settings.map.first()
                  ? &frame.get<MicrorectMap>(MicrorectSettings{*settings.map.first(), settings.rule}).levels_
                  : nullptr),
      pass_("frame/microrect_map") {
  frame.passes().setBytesHeld(pass_, levels_.bytes());
}

void MicrorectMap::make(Frame& frame) {
  const auto& pyramid = frame.get<MinMaxPyramid>(settings_.map);
  const auto scope = frame.passes().open(pass_);
  levels_.build(pyramid.minimum());
}

}  // namespace limen::frame
