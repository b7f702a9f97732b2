// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/split_passes.h"

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {
namespace {

const char* const kSmoothShader = "renderer/techniques/soft_shadows/quality/smooth_levels.comp.glsl";
const char* const kOrderShader = "renderer/techniques/soft_shadows/quality/order_work.comp.glsl";

gl::ShaderDefines gatherDefines(const LevelOfQuality& quality) {
  return {{"SPLIT_GATHER", "1"}, {"LANES", std::to_string(quality.lanes())}};
}

gl::ShaderDefines classifyDefines(bool smooths) {
  gl::ShaderDefines defines = {{"SPLIT_CLASSIFY", "1"}};
  if (smooths) defines["SMOOTH"] = "1";
  return defines;
}

const gl::Texture& cameraDepth(frame::Frame& frame) {
  return frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Depth}).texture();
}

}  // namespace

SplitRunner::SplitRunner(frame::Frame& frame, const VisibilityPass& pass, const LevelOfQuality& quality,
                         bool smooths, int layers)
    : quality_(quality),
      smooths_(smooths),
      search_(frame, smooths, quality.orders(), quality.lanes(), layers),
      classify_(pass.program(frame, false, classifyDefines(smooths))),
      gather_(pass.program(frame, false, gatherDefines(quality))) {
  gl::ProgramCache& programs = frame.context().programs();
  if (smooths_) smooth_ = &programs.compute(kSmoothShader);
  if (quality_.orders()) {
    gl::ShaderDefines defines;
    if (layers > 1) defines["MAP_LAYERS"] = std::to_string(layers);
    countBins_ = &programs.compute(kOrderShader, defines);
    defines["SCATTER"] = "1";
    scatter_ = &programs.compute(kOrderShader, defines);
  }
  frame.passes().setBytesHeld(pass.name() + "/classify", pass.visibility().bytes() + search_.bytes());
}

void SplitRunner::makeInputs(frame::Frame& frame) const {
  if (smooths_) cameraDepth(frame);
}

void SplitRunner::bindInputs(frame::Frame& frame) const {
  if (smooths_) cameraDepth(frame).bindTexture(kSplitCameraDepthUnit);
}

void SplitRunner::run(frame::Frame& frame, const VisibilityPass& pass, PassInputs& inputs,
                      const frame::ShadowMapSettings& map, const CountImages* counts, Timing timing) {
  const auto stage = [&](const char* name, const auto& work) {
    if (timing == Timing::Whole) return work();
    const auto scope = frame.passes().open(pass.name() + name);
    work();
  };
  stage("/classify", [&] {
    const gl::Program& classify = counts ? pass.program(frame, true, classifyDefines(smooths_)) : classify_;
    pass.bind(frame, classify, inputs, map, counts);
    search_.bindForClassify();
    classify.dispatch(frame.sizePx());
    SplitSearch::makeVisible();
  });
  if (smooths_)
    stage("/smooth", [&] {
      quality_.configureSmoothing(*smooth_);
      search_.smooth(*smooth_);
    });
  if (quality_.orders()) stage("/order", [&] { search_.order(*countBins_, *scatter_); });
  stage("/gather", [&] {
    const gl::Program& gather = counts ? pass.program(frame, true, gatherDefines(quality_)) : gather_;
    pass.bind(frame, gather, inputs, map, counts);
    search_.bindForGather();
    search_.dispatchOverList(gather);
    SplitSearch::makeVisible();
  });
}

}  // namespace limen::techniques
