// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/compute_raster.h"

#include <epoxy/gl.h>

namespace limen::frame {
namespace {

constexpr int kQueueCapacity =
    1 << 18;  // runs of pixels of large triangles; more are rasterised where they are found
constexpr int kLargeGroups = 1024;
constexpr uint32_t kNoTriangle = 0xffffffffU;

const gl::Program& program(gl::Context& context, bool large, bool ids) {
  gl::ShaderDefines defines = {{"QUEUE_CAPACITY", std::to_string(kQueueCapacity) + "u"}};
  if (large) defines["LARGE"] = "1";
  if (ids) defines["IDS"] = "1";
  return context.programs().compute("renderer/frame/compute_raster.comp.glsl", defines);
}

}  // namespace

Raster chosenRaster(Raster raster, const gl::Context& context) {
  if (raster != Raster::Auto) return raster;
  return context.device().software ? Raster::Hardware : Raster::Compute;
}

ComputeRaster::ComputeRaster(gl::Context& context, glm::ivec2 sizePx, bool withIds)
    : smallDepth_(program(context, false, false)),
      largeDepth_(program(context, true, false)),
      depthBits_(gl::Format::R32UI, sizePx),
      depth_(depthBits_.viewAs(gl::Format::R32F)),
      queue_(16 + int64_t{kQueueCapacity} * 8, nullptr) {
  if (!withIds) return;
  smallIds_ = &program(context, false, true);
  largeIds_ = &program(context, true, true);
  ids_.emplace(gl::Format::R32UI, sizePx);
}

int64_t ComputeRaster::bytes() const {
  return depthBits_.bytes() + (ids_ ? ids_->bytes() : 0) + queue_.bytes();
}

void ComputeRaster::pass(const gl::Program& small, const gl::Program& large, const GpuScene& scene) const {
  const uint32_t zero = 0;
  glClearNamedBufferSubData(queue_.id(), GL_R32UI, 0, 16, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  constexpr int kPerRow = 1 << 20;  // a dispatch has at most 65,535 groups a dimension
  const int triangles = static_cast<int>(scene.triangleCount());
  small.use();
  const int columns = std::min(triangles, kPerRow);
  glDispatchCompute(static_cast<GLuint>((columns + 63) / 64),
                    static_cast<GLuint>((triangles + kPerRow - 1) / kPerRow), 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  large.use();
  glDispatchCompute(kLargeGroups, 1, 1);
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void ComputeRaster::draw(const GpuScene& scene, const glm::mat4& clip, double near) const {
  depthBits_.clearUint(glm::uvec4(0));
  if (ids_) ids_->clearUint(glm::uvec4(kNoTriangle));
  scene.bindStorage(0);
  queue_.bindStorage(3);
  for (const gl::Program* each : {&smallDepth_, &largeDepth_, smallIds_, largeIds_}) {
    if (!each) continue;
    each->set("anchorToClip", clip);
    each->set("near", static_cast<float>(near));
    each->set("sizePx", depthBits_.sizePx());
    each->set("triangleCount", scene.triangleCount());
  }
  depthBits_.bindImage(0, gl::Access::ReadWrite);
  pass(smallDepth_, largeDepth_, scene);
  if (!ids_) return;
  ids_->bindImage(1, gl::Access::ReadWrite);
  pass(*smallIds_, *largeIds_, scene);
}

}  // namespace limen::frame
