// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/field_batch.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/visibility_fields/field_bindings.h"

namespace limen::visibility_fields {

std::vector<float> lookUp(gl::Context& context, const VisibilityFields& fields, uint32_t object,
                          const std::vector<ray_tracing::BatchRay>& rays, double slack, bool aimed) {
  constexpr size_t kMostRays = size_t{65535} * kFieldBatchGroup;
  gl::ShaderDefines defines = fields.defines();
  if (aimed) defines["FIELD_AIMED"] = "1";
  const gl::Program& program =
      context.programs().compute("renderer/visibility_fields/field_batch.comp.glsl", defines);
  const gl::Buffer given(rays), distances(static_cast<int64_t>(rays.size() * sizeof(float)), nullptr);
  fields.bind(program);
  given.bindStorage(kFieldBatchRaysBuffer);
  distances.bindStorage(kFieldBatchDistancesBuffer);
  program.set("object", object);
  program.set("slack", static_cast<float>(slack));
  program.set("rayCount", static_cast<uint32_t>(rays.size()));
  for (size_t first = 0; first < rays.size(); first += kMostRays) {
    program.set("firstRay", static_cast<uint32_t>(first));
    program.dispatch({static_cast<int>(std::min(rays.size() - first, kMostRays)), 1}, {kFieldBatchGroup, 1});
  }
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return distances.read<float>(0, static_cast<int64_t>(rays.size()));
}

}  // namespace limen::visibility_fields
