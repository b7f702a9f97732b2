// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/stimulus_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "study/stimulus/display_coding.h"
#include "study/stimulus/encode_bindings.h"
#include "study/stimulus/state_view.h"

namespace limen::study {
namespace {

bool sameView(const scene::Camera& a, const scene::Camera& b) {
  return a.eye == b.eye && a.target == b.target && a.up == b.up && a.verticalFovDeg == b.verticalFovDeg;
}

/// Without alpha, exactly as codes over 255, which drivers' conversions do not give.
Image codesOf(const Image& image) {
  Image out(image.width, image.height, 3);
  for (size_t i = 0; i < out.pixels(); ++i)
    for (size_t c = 0; c < 3; ++c)
      out.data[3 * i + c] = static_cast<float>(std::round(255.0 * image.data[4 * i + c]) / 255.0);
  return out;
}

}  // namespace

StimulusRenderer::StimulusRenderer(gl::Context& context, const Stimulus& stimulus, glm::ivec2 sizePx,
                                   const perception::DisplayProfile& display, SceneCache* scenes)
    : context_(context),
      stimulus_(stimulus),
      timeline_(timelineOf(stimulus, display.refreshHz)),
      sizePx_(sizePx),
      scene_(scenes ? scenes->get(stimulus.scene) : buildStimulusScene(stimulus.scene)),
      thresholds_(gl::Format::R32F, {255, 1}),
      coded_(gl::Format::RGBA8, sizePx) {
  Image thresholds(255, 1, 1);
  const CodeThresholds values = codeThresholds(display);
  std::copy(values.begin(), values.end(), thresholds.data.begin());
  thresholds_.write(thresholds);

  // A technique's output may depend on more than the camera's position, for example on where it came from.
  const bool byCamera = stimulus_.levels.has_value();
  for (int frame = 0; frame < timeline_.frames; ++frame) {
    const double timeS = timeline_.sceneTimeS(frame),
                 before = frame > 0 ? timeline_.sceneTimeS(frame - 1) : 0.0;
    const bool same = frame > 0 && timeline_.showsAfter(frame) == timeline_.showsAfter(frame - 1) &&
                      (timeS == before || (byCamera && sameView(scene_->scene.camera.at(timeS),
                                                                scene_->scene.camera.at(before))));
    if (!same) firstFrames_.push_back(frame);
    pictureOf_.push_back(static_cast<int>(firstFrames_.size()) - 1);
  }
  for (const bool after : {false, true})
    if (timeline_.showsAfter(0) == after || timeline_.showsAfter(timeline_.frames - 1) == after) {
      views_[after] = std::make_unique<StateView>(context_, scene_, stimulus_, after, sizePx_,
                                                  timeline_.changeSceneTimeS);
      renderState(timeline_.changeSceneTimeS, after);  // compiles
    }
}

StimulusRenderer::~StimulusRenderer() = default;

const gl::Texture& StimulusRenderer::render(int frame) {
  assert(frame >= 0 && frame < timeline_.frames);
  const int first = firstFrameOf(pictureOf(frame));
  return renderState(timeline_.sceneTimeS(first), timeline_.showsAfter(first));
}

const gl::Texture& StimulusRenderer::renderState(double sceneTimeS, bool after) {
  assert(views_[after] && "a state that the sequence does not show");
  const StateView::Picture picture = views_[after]->render(sceneTimeS);
  const gl::ShaderDefines defines =
      picture.visibility ? gl::ShaderDefines{{"VISIBILITY", "1"}} : gl::ShaderDefines{};
  const gl::Program& encode = context_.programs().compute("study/stimulus/encode.comp.glsl", defines);
  encode.set("samples", stimulus_.samples);
  encode.set("sizePx", sizePx_);
  picture.lit->bindTexture(kEncodePictureUnit);
  if (picture.visibility) {
    picture.unlit->bindTexture(kEncodeUnlitUnit);
    picture.visibility->bindTexture(kEncodeVisibilityUnit);
  }
  thresholds_.bindTexture(kEncodeThresholdsUnit);
  coded_.bindImage(kEncodeImage, gl::Access::Write);
  encode.dispatch(sizePx_);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
  return coded_;
}

Image StimulusRenderer::readBack(int frame) { return codesOf(render(frame).read()); }

Image StimulusRenderer::readBackState(double sceneTimeS, bool after) {
  return codesOf(renderState(sceneTimeS, after).read());
}

}  // namespace limen::study
