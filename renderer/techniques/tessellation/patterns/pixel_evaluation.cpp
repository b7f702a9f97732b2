// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/patterns/pixel_evaluation.h"

#include <epoxy/gl.h>

#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

const std::string kPatternFolder = "renderer/techniques/tessellation/patterns/";

glm::ivec2 texelsFor(int64_t vertices) {
  const auto rows = (vertices + kEvaluationTexels - 1) / kEvaluationTexels;
  if (rows > 16384)
    throw Error(std::to_string(vertices) + " vertices do not fit into a texture", "evaluation",
                "use evaluation: vertex, or fewer segments");
  return {kEvaluationTexels, static_cast<int>(std::max<int64_t>(rows, 1))};
}

}  // namespace

PixelEvaluation::PixelEvaluation(frame::Frame& frame, int64_t capacity, gl::ShaderDefines defines)
    : texelProgram_(frame.context().programs().get(
          {kPatternFolder + "texel.vert.glsl", kPatternFolder + "texel.frag.glsl"}, defines)),
      drawProgram_(frame.context().programs().get(
          {kPatternFolder + "evaluated.vert.glsl", "renderer/techniques/tessellation/surface.frag.glsl"})),
      capacity_(capacity),
      positions_(gl::Format::RGBA32UI, texelsFor(capacity)),
      normals_(gl::Format::RGBA32UI, texelsFor(capacity)),
      framebuffer_({&positions_, &normals_}, nullptr),
      positionBuffer_(positions_.bytes(), nullptr),
      normalBuffer_(normals_.bytes(), nullptr) {}

int64_t PixelEvaluation::bytes() const {
  return positions_.bytes() + normals_.bytes() + positionBuffer_.bytes() + normalBuffer_.bytes();
}

void PixelEvaluation::run(frame::Frame& frame, int64_t vertices, const std::function<void()>& draw) const {
  const glm::ivec2 used = texelsFor(vertices);
  {
    const auto scope = frame.passes().open("tessellation/vertices");
    framebuffer_.bind();
    glDisable(GL_DEPTH_TEST);
    texelProgram_.use();
    texelProgram_.set("rows", positions_.sizePx().y);
    draw();
  }
  const auto scope = frame.passes().open("tessellation/copy");
  const auto copy = [&](const gl::Texture& from, const gl::Buffer& to) {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, to.id());
    glGetTextureSubImage(from.id(), 0, 0, 0, 0, used.x, used.y, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                         static_cast<GLsizei>(int64_t{used.x} * used.y * 16), nullptr);
  };
  copy(positions_, positionBuffer_);
  copy(normals_, normalBuffer_);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void PixelEvaluation::bind() const {
  positionBuffer_.bindStorage(kEvaluatedPositionsBuffer);
  normalBuffer_.bindStorage(kEvaluatedNormalsBuffer);
}

}  // namespace limen::techniques
