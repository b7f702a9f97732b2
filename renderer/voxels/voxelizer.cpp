// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/voxelizer.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/voxels/voxel_bindings.h"

namespace limen::voxels {
namespace {

/// Groups that share large triangles: some sixty times what an NVIDIA H200 has multiprocessors, as most find
/// nothing to share and end; at most this many layers of them.
constexpr uint32_t kSharingGroups = 8192, kMostLayers = 64;

gl::ShaderDefines voxelizerDefines(Coverage coverage, const Volume& into) {
  gl::ShaderDefines defines = into.defines();
  defineEnum(defines, "COVERAGE", coverage);
  if (into.attributes().any()) defines["SUMS"] = "1";
  return defines;
}

}  // namespace

Voxelizer::Voxelizer(gl::Context& context, Coverage coverage, const Volume& into)
    : program_(context.programs().compute("renderer/voxels/voxelize.comp.glsl",
                                          voxelizerDefines(coverage, into))) {}

void Voxelizer::run(const frame::Frame& frame, const Volume& into) const {
  into.clear();
  add(frame, into);
  into.finish();
}

void Voxelizer::add(const frame::Frame& frame, const Volume& into) const {
  const uint32_t triangles = frame.gpuScene().triangleCount();
  if (triangles == 0) return;
  if (into.sums()) frame.bindSurfaces();
  frame.gpuScene().bindStorage(&frame.positions());
  into.bits().bindImage(kVoxelBitsImage, gl::Access::ReadWrite);
  if (into.sums()) into.sums()->bindStorage(kVoxelSumsBuffer);
  into.configure(program_);
  program_.set("triangleCount", triangles);
  program_.use();
  const uint32_t groups = (triangles + kVoxelizeGroup - 1) / kVoxelizeGroup;
  const uint32_t rows = (groups + 65534) / 65535;
  // No more layers of groups than the largest triangle has columns for.
  const glm::ivec3 size = into.grid().resolution;
  const int side = std::max({size.x, size.y, size.z});
  const uint32_t most = std::clamp(static_cast<uint32_t>(side * side / kVoxelizeGroup), 1U, kMostLayers);
  glDispatchCompute((groups + rows - 1) / rows, rows, std::clamp(kSharingGroups / groups, 1U, most));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace limen::voxels
