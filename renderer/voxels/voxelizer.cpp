// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/voxelizer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "renderer/voxels/voxel_bindings.h"

namespace limen::voxels {
namespace {

/// Groups that share large triangles: sixteen for each of an NVIDIA H200's multiprocessors; few where these
/// are threads of a CPU.
constexpr GLuint kQueueGroups = 2112, kSoftwareQueueGroups = 32;
constexpr GLuint kMostGroupsInRow = 65535;

gl::ShaderDefines voxelizerDefines(const frame::Frame& frame, Coverage coverage, const Volume& into,
                                   const VoxelLamps& lamps) {
  gl::ShaderDefines defines = into.defines();
  defines.merge(into.sumDefines());
  defines.merge(surfaceDefines(frame, into.attributes(), lamps));
  defineEnum(defines, "COVERAGE", coverage);
  return defines;
}

gl::Buffer queueFor(uint32_t capacity) {
  gl::Buffer queue(int64_t{sizeof(VoxelQueueHeader)} + int64_t{capacity} * 8, nullptr);
  queue.clearUint(0);
  return queue;
}

}  // namespace

Voxelizer::Voxelizer(frame::Frame& frame, Coverage coverage, const Volume& into, const VoxelLamps& lamps,
                     uint32_t queueCapacity)
    : context_(frame.context()),
      lamps_(lamps),
      queueCapacity_(queueCapacity),
      alone_(context_.programs().compute("renderer/voxels/voxelize.comp.glsl",
                                         voxelizerDefines(frame, coverage, into, lamps))),
      queued_(context_.programs().compute("renderer/voxels/voxelize_queued.comp.glsl",
                                          voxelizerDefines(frame, coverage, into, lamps))),
      queue_(queueFor(queueCapacity)) {
  assert(!into.attributes().any() || into.sums());
}

void Voxelizer::run(frame::Frame& frame, const Volume& into, const ray_tracing::RayTree* tree) const {
  into.clear();
  add(frame, into, tree);
  into.finish();
}

void Voxelizer::configure(const gl::Program& program, frame::Frame& frame, const Volume& into,
                          const ray_tracing::RayTree* tree) const {
  into.configure(program);
  program.set("queueCapacity", queueCapacity_);
  program.set("queueTurn", turn_);
  if (!into.sums()) return;
  into.configureSums(program);
  configureSurfaces(program, frame, into.attributes(), lamps_, tree);
}

void Voxelizer::add(frame::Frame& frame, const Volume& into, const ray_tracing::RayTree* tree,
                    TriangleSpan span) const {
  const uint32_t end = std::min(frame.gpuScene().triangleCount(), span.end);
  if (span.first >= end) return;
  frame.gpuScene().bindStorage(&frame.positions());
  if (into.sums()) {
    frame.bindSurfaces();
    into.sums()->bindStorage(kVoxelSumsBuffer);
  }
  queue_.bindStorage(kVoxelQueueBuffer);
  into.bits().bindImage(kVoxelBitsImage, gl::Access::ReadWrite);
  configure(alone_, frame, into, tree);
  alone_.set("firstTriangle", span.first);
  alone_.set("triangleCount", end);
  alone_.use();
  const GLuint groups = (end - span.first + kVoxelizeGroup - 1) / kVoxelizeGroup;
  const GLuint rows = (groups + kMostGroupsInRow - 1) / kMostGroupsInRow;
  glDispatchCompute((groups + rows - 1) / rows, rows, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  configure(queued_, frame, into, tree);
  queued_.use();
  glDispatchCompute(context_.device().software ? kSoftwareQueueGroups : kQueueGroups, 1, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
  turn_ = 1 - turn_;
}

uint32_t Voxelizer::cutShort() const {
  return queue_.read<uint32_t>(offsetof(VoxelQueueHeader, cutShort), 1)[0];
}

}  // namespace limen::voxels
