// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/level_step_search.h"

#include <epoxy/gl.h>

#include <bit>
#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {
namespace {

/// Processed pixels do not all use the same levels.
bool choicesDiffer(const PixelCounts& counted, const LevelOfQuality& quality) {
  std::optional<float> first;
  for (size_t i = 0; i < counted.work.size(); i += 4) {
    if (counted.work[i] != Processed) continue;
    const auto level = std::bit_cast<float>(counted.search[i + 3]);
    if (level != first.value_or(level) || (quality.dithers() && level != std::floor(level))) return true;
    first = level;
  }
  return false;
}

}  // namespace

std::optional<LevelSteps> findLevelSteps(frame::Frame& frame, const VisibilityPass& pass, PassInputs& inputs,
                                         const frame::ShadowMapSettings& map, const LevelOfQuality& quality,
                                         const CountImages& images, const PixelCounts& counted) {
  if (!choicesDiffer(counted, quality)) return {};
  const auto& positions = frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Position});
  const auto& normals = frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Normal});
  const gl::Texture found(gl::Format::RG32F, frame.sizePx());
  const gl::Program& steps = pass.program(frame, false, {{"LEVEL_STEPS", "1"}});
  const auto from = [&](glm::ivec2 offset) {
    pass.bind(frame, steps, inputs, map, nullptr);
    positions.texture().bindTexture(kStepsPositionsUnit);
    normals.texture().bindTexture(kStepsNormalsUnit);
    images.work.bindImage(kStepsCountedWorkImage, gl::Access::Read);
    images.search.bindImage(kStepsCountedSearchImage, gl::Access::Read);
    found.bindImage(kStepsImage, gl::Access::Write);
    steps.set("offset", offset);
    steps.set("surfaceSlope", static_cast<float>(kSurfaceSlope));
    steps.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    return found.read();
  };
  return LevelSteps{from({0, 0}), from({1, 0}), from({0, 1})};
}

}  // namespace limen::techniques
