// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/g_buffer.h"

#include <epoxy/gl.h>

#include <array>

#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

constexpr const char* kResolve = "renderer/frame/g_buffer.comp.glsl";

gl::Format formatOf(Channel channel) {
  switch (channel) {
    case Channel::Position:
    case Channel::Normal:
      return gl::Format::RGBA32F;
    case Channel::Albedo:
      return gl::Format::RGBA8;
    case Channel::Depth:
      return gl::Format::R32F;
  }
  return gl::Format::R32F;
}

gl::ShaderDefines channelDefines(Channel channel) {
  switch (channel) {
    case Channel::Position:
      return {{"CHANNEL_POSITION", "1"}, {"OUT_FORMAT", "rgba32f"}};
    case Channel::Normal:
      return {{"CHANNEL_NORMAL", "1"}, {"OUT_FORMAT", "rgba32f"}};
    case Channel::Albedo:
      return {{"CHANNEL_ALBEDO", "1"}, {"OUT_FORMAT", "rgba8"}};
    case Channel::Depth:
      return {{"CHANNEL_DEPTH", "1"}, {"OUT_FORMAT", "r32f"}};
  }
  return {};
}

/// Defines of a channel, depending on whether the frame was given what it sees.
gl::ShaderDefines definesOf(const Frame& frame, gl::ShaderDefines defines) {
  if (frame.seen()) defines["GIVEN_PLACES"] = "1";
  return defines;
}

/// Computes a channel from the triangle ids; `out`, and `planes` if there are any, get every pixel.
void resolve(Frame& frame, const gl::Program& program, const gl::Texture& out, const std::string& pass,
             const gl::Texture* planes = nullptr) {
  const gl::Texture& ids = frame.get<TriangleIds>().texture();
  const auto scope = frame.passes().open(pass);
  const glm::dmat4& toCamera = frame.anchorToCamera();
  program.set("anchorToCamera", glm::mat4(toCamera));
  program.set("cameraToAnchor", glm::mat4(glm::inverse(toCamera)));
  const Seen* seen = frame.seen();
  const glm::ivec2 pictureSizePx = seen ? seen->pictureSizePx : frame.sizePx();
  const double aspect = double(pictureSizePx.x) / pictureSizePx.y;
  program.set("rayScale", glm::vec2(frame.tanHalfFov() * aspect, frame.tanHalfFov()));
  program.set("pictureSizePx", pictureSizePx);
  program.set("sizePx", frame.sizePx());
  ids.bindTexture(kGBufferIdsUnit);
  if (seen) seen->places->bindTexture(kGBufferPlacesUnit);
  out.bindImage(kGBufferOutImage, gl::Access::Write);
  if (planes) planes->bindImage(kGBufferPlanesImage, gl::Access::Write);
  frame.geometry().bindStorage();
  program.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace

TriangleIds::TriangleIds(Frame& frame) : given_(frame.seen() ? frame.seen()->ids : nullptr) {
  if (given_) return;
  int64_t bytes = 0;
  if (chosenRaster(frame.raster(), frame.context()) == Raster::Compute) {
    compute_ =
        std::make_unique<ComputeRaster>(frame.context(), frame.sizePx(), ComputeRasterSettings{.ids = true});
    bytes = compute_->bytes();
  } else {
    gl::Texture ids(gl::Format::R32UI, frame.sizePx()), depth(gl::Format::Depth32F, frame.sizePx());
    gl::Framebuffer framebuffer({&ids}, &depth);
    bytes = ids.bytes() + depth.bytes();
    const gl::Program& program = frame.context().programs().get(
        {"renderer/frame/triangle_ids.vert.glsl", "renderer/frame/triangle_ids.frag.glsl"});
    hardware_.reset(new HardwareTarget{program, std::move(ids), std::move(depth), std::move(framebuffer)});
  }
  frame.passes().setBytesHeld("frame/triangle_ids", bytes);
}

double nearPlane(const Frame& frame) {
  const double reach = glm::length(glm::dvec3(frame.anchorToCamera() * glm::dvec4(0.0, 0.0, 0.0, 1.0))) +
                       frame.gpuScene().diagonal();
  return 1e-4 * (reach > 0.0 ? reach : 1.0);
}

glm::mat4 anchorToClip(const Frame& frame) {
  glm::dmat4 projection(0.0);
  projection[0][0] = 1.0 / (frame.tanHalfFov() * frame.aspect());
  projection[1][1] = 1.0 / frame.tanHalfFov();
  projection[2][3] = -1.0;
  projection[3][2] = nearPlane(frame);
  return glm::mat4(projection * frame.anchorToCamera());
}

void TriangleIds::make(Frame& frame) {
  if (given_) return;
  const auto scope = frame.passes().open("frame/triangle_ids");
  const glm::mat4 clip = anchorToClip(frame);
  if (compute_) {
    compute_->draw(frame.geometry(), clip, nearPlane(frame));
    return;
  }
  hardware_->framebuffer.bind();
  constexpr std::array<GLuint, 4> kBackground = {kNone, 0, 0, 0};
  constexpr GLfloat kFar = 0.0F;  // reversed depth: 0 is infinitely far
  glClearBufferuiv(GL_COLOR, 0, kBackground.data());
  glClearBufferfv(GL_DEPTH, 0, &kFar);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDisable(GL_CULL_FACE);
  hardware_->program.use();
  hardware_->program.set("anchorToClip", clip);
  frame.geometry().draw();
  glDisable(GL_DEPTH_TEST);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

std::string ChannelSetting::key() const {
  constexpr std::array<const char*, 4> kNames = {"position", "normal", "albedo", "depth"};
  return kNames[static_cast<size_t>(channel)];
}

GBufferChannel::GBufferChannel(Frame& frame, ChannelSetting setting)
    : setting_(std::move(setting)),
      program_(
          frame.context().programs().compute(kResolve, definesOf(frame, channelDefines(setting_.channel)))),
      texture_(formatOf(setting_.channel), frame.sizePx()) {
  frame.passes().setBytesHeld("frame/" + setting_.key(), texture_.bytes());
}

void GBufferChannel::make(Frame& frame) {
  if (setting_.channel == Channel::Albedo) frame.bindSurfaces();
  resolve(frame, program_, texture_, "frame/" + setting_.key());
}

Receivers::Receivers(Frame& frame)
    : program_(frame.context().programs().compute(
          kResolve, definesOf(frame, {{"CHANNEL_RECEIVER", "1"}, {"OUT_FORMAT", "rgba32f"}}))),
      texture_(gl::Format::RGBA32F, frame.sizePx()),
      planes_(gl::Format::RG32F, frame.sizePx()) {
  frame.passes().setBytesHeld("frame/receivers", texture_.bytes() + planes_.bytes());
}

void Receivers::make(Frame& frame) {
  if (frame.scene().lights.empty()) {
    const auto scope = frame.passes().open("frame/receivers");
    texture_.clear(glm::vec4(0.0F, 0.0F, 0.0F, -1.0F));
    planes_.clear(glm::vec4(0.0F));
    return;
  }
  const glm::dmat4 toLight = frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor());
  program_.set("cameraToLight", glm::mat4(toLight * glm::inverse(frame.anchorToCamera())));
  resolve(frame, program_, texture_, "frame/receivers", &planes_);
}

}  // namespace limen::frame
