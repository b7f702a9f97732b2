// SPDX-License-Identifier: BSD-3-Clause
// The surface point of a pixel, from which rays leave, the same for fields and for tracers. Set up by configureReceivers().
#include "renderer/ray_tracing/random_place.glsl"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/map_functions.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kFieldPositionUnit) uniform sampler2D positions;
layout(binding = kFieldNormalUnit) uniform sampler2D normals;
layout(binding = kFieldIdsUnit) uniform usampler2D triangleIds;
layout(std430, binding = kFieldObjectOfBuffer) readonly buffer ObjectOf { uint objectOf[]; };
uniform ivec2 sizePx;
uniform int selfOcclusion, interleave;
uniform vec3 eyePosition;  // relative to the anchor

struct FieldReceiver {
  vec3 origin, normal;
  uint triangle, object;
};

// False: the pixel shows no surface.
bool fieldReceiver(ivec2 pixel, out FieldReceiver receiver) {
  receiver.triangle = texelFetch(triangleIds, pixel, 0).x;
  if (receiver.triangle == 0xffffffffu) return false;
  receiver.object = objectOf[receiver.triangle];
  receiver.normal = texelFetch(normals, pixel, 0).xyz;
  // Clear of neighbours in the same plane.
  const vec3 seen = texelFetch(positions, pixel, 0).xyz;
  receiver.origin = seen + 1e-5 * distance(seen, eyePosition) * receiver.normal;
  return true;
}

// In [0, 1), from the pixel's number.
vec2 pixelPlace(ivec2 pixel, uint number, uint seed) {
  return randomPlace(uvec3(uint(pixel.y * sizePx.x + pixel.x), number, seed));
}

// In a cell of a pixel's rays: the middle, or the middle of one of interleave x interleave parts of it, another for each pixel of a tile.
vec2 placeInCell(ivec2 pixel) {
  const ivec2 part = ivec2(pixel.x + 2 * pixel.y, pixel.y) % interleave;
  return (vec2(part) + 0.5) / float(interleave);
}
