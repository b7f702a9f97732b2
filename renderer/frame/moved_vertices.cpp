// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/moved_vertices.h"

#include <epoxy/gl.h>

#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "experiments/base/error.h"
#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

gl::Buffer copyOf(const gl::Buffer& buffer) {
  gl::Buffer out(buffer.bytes(), nullptr);
  glCopyNamedBufferSubData(buffer.id(), out.id(), 0, 0, buffer.bytes());
  return out;
}

}  // namespace

MovedVertices::MovedVertices(gl::Context& context, std::vector<scene::PartMotion> motions, glm::dvec3 anchor,
                             const gl::Buffer& positions, const gl::Buffer* normals,
                             const std::vector<uint32_t>& motionOf)
    : motions_(std::move(motions)),
      anchor_(anchor),
      count_(static_cast<uint32_t>(motionOf.size())),
      restPositions_(positions),
      restNormals_(normals),
      motionOf_(motionOf),
      positions_(copyOf(positions)),
      program_(
          context.programs().compute("renderer/frame/move_vertices.comp.glsl",
                                     normals ? gl::ShaderDefines{{"NORMALS", "1"}} : gl::ShaderDefines{})) {
  if (motions_.size() > kMostMotions)
    throw Error("a scene has " + std::to_string(motions_.size()) + " parts that move; at most " +
                    std::to_string(kMostMotions) + " can",
                {}, "join parts that move alike");
  if (normals) normals_ = copyOf(*normals);
}

void MovedVertices::update(double timeS) const {
  for (size_t i = 0; i < motions_.size(); ++i) {
    const glm::dmat4 motion =
        glm::translate(glm::translate(glm::dmat4(1.0), -anchor_) * motions_[i].at(timeS), anchor_);
    program_.set(("motions[" + std::to_string(i) + "]").c_str(), glm::mat4(motion));
  }
  program_.set("vertexCount", count_);
  restPositions_.bindStorage(kMoveRestPositionsBuffer);
  motionOf_.bindStorage(kMoveMotionOfBuffer);
  positions_.bindStorage(kMovePositionsBuffer);
  if (normals_) {
    restNormals_->bindStorage(kMoveRestNormalsBuffer);
    normals_->bindStorage(kMoveNormalsBuffer);
  }
  const uint32_t groups = (count_ + kMoveGroup - 1) / kMoveGroup, rows = (groups + 65534) / 65535;
  program_.use();
  if (groups > 0) glDispatchCompute((groups + rows - 1) / rows, rows, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

int64_t MovedVertices::bytes() const {
  return motionOf_.bytes() + positions_.bytes() + (normals_ ? normals_->bytes() : 0);
}

}  // namespace limen::frame
