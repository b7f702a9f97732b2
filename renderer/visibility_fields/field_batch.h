// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/gl/context.h"
#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/visibility_fields/visibility_fields.h"

namespace limen::visibility_fields {

/// Distance of a ray that meets nothing.
inline constexpr float kNoDistance = -1.0F;

/// Distances along given rays to one object, looked up in its field on the GPU; kNoDistance: none. Directions
/// are unit vectors; `near` and `far` are not read. `slack`: by how much of the sphere's diameter a blocker
/// must lie before an origin inside the sphere. `aimed`: FIELD_AIMED of field_lookup.glsl. Waits for the GPU.
std::vector<float> lookUp(gl::Context& context, const VisibilityFields& fields, uint32_t object,
                          const std::vector<ray_tracing::BatchRay>& rays, double slack, bool aimed = false);

}  // namespace limen::visibility_fields
