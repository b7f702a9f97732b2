// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/multisample/multisample_ids.h"

#include <epoxy/gl.h>

#include <array>
#include <stdexcept>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"

namespace limen::techniques {
namespace {

/// Samples that a surface requested with `samples` actually gets; drivers may give more.
int samplesGiven(int samples) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_INTEGER_SAMPLES, &most);
  if (samples > most) return 0;
  GLuint texture = 0;
  glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &texture);
  glTextureStorage2DMultisample(texture, samples, GL_R32UI, 1, 1, GL_TRUE);
  GLint given = 0;
  glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_SAMPLES, &given);
  glDeleteTextures(1, &texture);
  return given;
}

void requireSamples(int samples) {
  if (samplesGiven(samples) == samples) return;
  std::string offered;
  for (const int count : {2, 4, 8})
    if (samplesGiven(count) == count) offered += (offered.empty() ? "" : ", ") + std::to_string(count);
  throw Error("this driver has no surfaces with " + std::to_string(samples) + " samples per pixel", "samples",
              "of 2, 4 and 8 it supports " + (offered.empty() ? "none" : offered));
}

}  // namespace

MultisampleIds::MultisampleIds(frame::Frame& frame, int samples)
    : program_(frame.context().programs().get(
          {"renderer/frame/triangle_ids.vert.glsl", "renderer/frame/triangle_ids.frag.glsl"})),
      sizePx_(frame.sizePx()) {
  requireSamples(samples);
  const auto make = [&](GLenum format) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &texture);
    glTextureStorage2DMultisample(texture, samples, format, sizePx_.x, sizePx_.y, GL_TRUE);
    return texture;
  };
  ids_ = make(GL_R32UI);
  depth_ = make(GL_DEPTH_COMPONENT32F);
  glCreateFramebuffers(1, &framebuffer_);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, ids_, 0);
  glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
  if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the driver cannot render into multisampled triangle numbers");
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  for (int i = 0; i < samples; ++i) {
    // Rows grow downwards, as window coordinates do with the upper-left origin of the context.
    std::array<GLfloat, 2> place{};
    glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), place.data());
    places_.emplace_back(place[0], place[1]);
  }
}

MultisampleIds::~MultisampleIds() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &ids_);
  glDeleteTextures(1, &depth_);
}

int64_t MultisampleIds::bytes() const {
  constexpr int64_t kBytesPerSample = 4 + 4;
  return kBytesPerSample * static_cast<int64_t>(places_.size()) * sizePx_.x * sizePx_.y;
}

void MultisampleIds::bindTexture(uint32_t unit) const { glBindTextureUnit(unit, ids_); }

void MultisampleIds::draw(frame::Frame& frame) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, sizePx_.x, sizePx_.y);
  constexpr std::array<GLuint, 4> kBackground = {frame::TriangleIds::kNone, 0, 0, 0};
  constexpr GLfloat kFar = 0.0F;  // reversed depth: 0 is infinitely far
  glClearBufferuiv(GL_COLOR, 0, kBackground.data());
  glClearBufferfv(GL_DEPTH, 0, &kFar);
  glEnable(GL_MULTISAMPLE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDisable(GL_CULL_FACE);
  program_.use();
  program_.set("anchorToClip", frame::anchorToClip(frame));
  frame.geometry().draw();
  glDisable(GL_DEPTH_TEST);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace limen::techniques
