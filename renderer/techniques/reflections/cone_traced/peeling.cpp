// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/cone_traced/peeling.h"

#include <epoxy/gl.h>

#include <cmath>

#include "renderer/techniques/reflections/cone_traced/cone_traced_bindings.h"

namespace limen::techniques {
namespace {

const std::string kPeelFolder = "renderer/techniques/reflections/cone_traced/";
constexpr const char* kPeelPass = "reflections/peel";

glm::ivec2 itemsSize(int room) {
  return {kPeelItemsAcross, (room + kPeelItemsAcross - 1) / kPeelItemsAcross};
}

}  // namespace

ConePeeling::ConePeeling(frame::Frame& frame, int room)
    : room_(room),
      // A power of two changes no digit: order and equality of distances stay.
      depthScale_(static_cast<float>(std::exp2(-std::ceil(std::log2(8.0 * frame.gpuScene().reach()))))),
      draw_(frame.context().programs().get({kPeelFolder + "peel.vert.glsl", kPeelFolder + "peel.frag.glsl"})),
      blend_(frame.context().programs().compute(kPeelFolder + "peel_blend.comp.glsl")),
      keys_(gl::Format::RGBA32UI, itemsSize(room)),
      colours_(gl::Format::RGBA32F, itemsSize(room)),
      layer_(gl::Format::RGBA32F, frame.sizePx()),
      result_(gl::Format::RGBA32F, frame.sizePx()),
      depths_{gl::Texture(gl::Format::Depth32F, frame.sizePx()),
              gl::Texture(gl::Format::Depth32F, frame.sizePx())},
      layerTargets_{gl::Framebuffer({&layer_}, &depths_[0]), gl::Framebuffer({&layer_}, &depths_[1])},
      resultTarget_({&result_}, &depths_[0]),
      command_(16, nullptr) {
  glCreateVertexArrays(1, &vertexArray_);
  frame.passes().setBytesHeld(kPeelPass, bytes());
}

ConePeeling::~ConePeeling() {
  if (vertexArray_) glDeleteVertexArrays(1, &vertexArray_);
}

int64_t ConePeeling::bytes() const {
  return keys_.bytes() + colours_.bytes() + layer_.bytes() + result_.bytes() + depths_[0].bytes() +
         depths_[1].bytes();
}

uint32_t ConePeeling::items() const { return command_.read<uint32_t>(0, 1)[0]; }

void ConePeeling::begin() const {
  // Points, instances, first point, first instance of a draw.
  constexpr std::array<uint32_t, 4> kNoPoints{0, 1, 0, 0};
  command_.write(0, 16, kNoPoints.data());
  glBindBufferBase(GL_ATOMIC_COUNTER_BUFFER, kPeelCounter, command_.id());
  keys_.bindImage(kPeelKeysImage, gl::Access::Write);
  colours_.bindImage(kPeelColoursImage, gl::Access::Write);
}

void ConePeeling::configure(const gl::Program& program) const {
  program.set("itemRoom", static_cast<uint32_t>(room_));
}

void ConePeeling::draw(bool first, const gl::Texture* previous) const {
  const glm::vec4 nothing(0.0F);
  constexpr GLfloat kFarthest = 1.0F;
  glClearBufferfv(GL_COLOR, 0, &nothing.x);
  glClearBufferfv(GL_DEPTH, 0, &kFarthest);
  draw_.set("first", first ? 1 : 0);
  if (previous) previous->bindTexture(kPeelPreviousUnit);
  draw_.use();
  glDrawArraysIndirect(GL_POINTS, nullptr);
}

void ConePeeling::peel(frame::Frame& frame, int layers) const {
  const auto scope = frame.passes().open(kPeelPass);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_ATOMIC_COUNTER_BARRIER_BIT |
                  GL_UNIFORM_BARRIER_BIT);
  const glm::ivec2 size = frame.sizePx();
  draw_.set("sizePx", size);
  draw_.set("itemRoom", static_cast<uint32_t>(room_));
  draw_.set("depthScale", depthScale_);
  blend_.set("sizePx", size);
  glBindVertexArray(vertexArray_);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command_.id());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  const auto bindItems = [&] {
    keys_.bindTexture(kPeelKeysUnit);
    colours_.bindTexture(kPeelColoursUnit);
  };
  bindItems();
  resultTarget_.bind();
  draw(true, nullptr);
  for (int i = 1; i < layers; ++i) {
    const auto into = static_cast<size_t>(i % 2);
    layerTargets_[into].bind();
    bindItems();
    draw(false, &depths_[1 - into]);
    layer_.bindTexture(kPeelLayerUnit);
    result_.bindImage(kPeelResultImage, gl::Access::ReadWrite);
    blend_.dispatch(size);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
  }
  glDepthFunc(GL_GREATER);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(0);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace limen::techniques
