// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/voxelizer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>

#include "renderer/voxels/voxel_bindings.h"

namespace limen::voxels {
namespace {

/// Groups that share large triangles: sixteen for each of an NVIDIA H200's multiprocessors; few where these
/// are threads of a CPU.
constexpr GLuint kQueueGroups = 2112, kSoftwareQueueGroups = 32;
constexpr GLuint kMostGroupsInRow = 65535;

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
      queue_(queueFor(queueCapacity)) {
  const VolumeAttributes& attributes = into.attributes();
  assert(!attributes.any() || into.sums());
  gl::ShaderDefines defines;
  defineEnum(defines, "COVERAGE", coverage);
  if (!attributes.any() || attributes.sumsOccupied()) bits_ = passFor(defines, false);
  if (!attributes.any()) return;
  defines.merge(into.defines());
  defines.merge(into.sumDefines());
  defines.merge(surfaceDefines(frame, attributes, lamps));
  sums_ = passFor(defines, true);
}

Voxelizer::Pass Voxelizer::passFor(const gl::ShaderDefines& defines, bool sums) const {
  gl::ProgramCache& programs = context_.programs();
  return {&programs.compute("renderer/voxels/voxelize.comp.glsl", defines),
          &programs.compute("renderer/voxels/voxelize_queued.comp.glsl", defines), sums};
}

void Voxelizer::run(frame::Frame& frame, const Volume& into, const VoxelizedPart& part) const {
  gather(frame, into, part);
  into.finish(part.base);
}

void Voxelizer::gather(frame::Frame& frame, const Volume& into, const VoxelizedPart& part) const {
  into.clear();
  if (bits_) run(*bits_, frame, into, part);
  if (part.base && bits_) into.unite(*part.base);
  into.numberOccupied();
  if (sums_) run(*sums_, frame, into, part);
  if (part.base && !bits_) into.unite(*part.base);
}

void Voxelizer::configure(const gl::Program& program, const Pass& pass, frame::Frame& frame,
                          const Volume& into, const ray_tracing::RayTree* tree) const {
  into.configure(program);
  program.set("queueCapacity", queueCapacity_);
  program.set("queueTurn", turn_);
  if (!pass.sums) return;
  into.configureSums(program);
  configureSurfaces(program, frame, into.attributes(), lamps_, tree);
}

void Voxelizer::run(const Pass& pass, frame::Frame& frame, const Volume& into,
                    const VoxelizedPart& part) const {
  frame.gpuScene().bindStorage(&frame.positions());
  if (pass.sums) {
    frame.bindSurfaces();
    into.sums()->bindStorage(kVoxelSumsBuffer);
  }
  queue_.bindStorage(kVoxelQueueBuffer);
  into.bits().bindImage(kVoxelBitsImage, gl::Access::ReadWrite);
  for (const TriangleSpan& span : part.spans) {
    const uint32_t end = std::min(frame.gpuScene().triangleCount(), span.end);
    if (span.first >= end) continue;
    configure(*pass.alone, pass, frame, into, part.tree);
    pass.alone->set("firstTriangle", span.first);
    pass.alone->set("triangleCount", end);
    pass.alone->use();
    const GLuint groups = (end - span.first + kVoxelizeGroup - 1) / kVoxelizeGroup;
    const GLuint rows = (groups + kMostGroupsInRow - 1) / kMostGroupsInRow;
    glDispatchCompute((groups + rows - 1) / rows, rows, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    configure(*pass.queued, pass, frame, into, part.tree);
    pass.queued->use();
    glDispatchCompute(context_.device().software ? kSoftwareQueueGroups : kQueueGroups, 1, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT);
    turn_ = 1 - turn_;
  }
}

uint32_t Voxelizer::cutShort() const {
  return queue_.read<uint32_t>(offsetof(VoxelQueueHeader, cutShort), 1)[0];
}

int64_t countOccupied(frame::Frame& frame, const VoxelGrid& grid, Coverage coverage) {
  const Volume volume(frame.context(), grid, frame.gpuScene().anchor());
  Voxelizer(frame, coverage, volume).run(frame, volume);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  int64_t count = 0;
  for (int z = 0; z < grid.resolution.z; ++z)
    for (const uint32_t word : volume.bits().readUintLayer(z)) count += std::popcount(word);
  return count;
}

}  // namespace limen::voxels
