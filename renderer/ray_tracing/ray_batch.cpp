// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/ray_tracing/ray_batch.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace limen::ray_tracing {

RayBatch::RayBatch(gl::Context& context, const RayTree& tree, const std::vector<BatchRay>& rays,
                   Wanted wanted)
    : tree_(tree),
      program_(context.programs().compute(
          "renderer/ray_tracing/trace_batch.comp.glsl",
          wanted == Wanted::AnyHit ? gl::ShaderDefines{{"ANY", "1"}} : gl::ShaderDefines{})),
      count_(static_cast<uint32_t>(rays.size())),
      rays_(rays),
      hits_(static_cast<int64_t>(rays.size() * sizeof(BatchHit)), nullptr) {}

void RayBatch::trace() const {
  constexpr uint32_t kMostGroups = 65535;
  tree_.bind(program_);
  rays_.bindStorage(kRayBatchRaysBuffer);
  hits_.bindStorage(kRayBatchHitsBuffer);
  program_.set("rayCount", count_);
  for (uint32_t first = 0; first < count_; first += kMostGroups * kRayBatchGroup) {
    program_.set("firstRay", first);
    const uint32_t rays = std::min(count_ - first, kMostGroups * kRayBatchGroup);
    program_.dispatch({static_cast<int>(rays), 1}, {kRayBatchGroup, 1});
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

std::vector<BatchHit> RayBatch::hits() const { return hits_.read<BatchHit>(0, count_); }

}  // namespace limen::ray_tracing
