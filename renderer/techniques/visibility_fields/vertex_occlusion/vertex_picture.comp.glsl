// SPDX-License-Identifier: BSD-3-Clause
// Values of vertices, interpolated over the triangle that a pixel sees.
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kFieldPositionUnit) uniform sampler2D positions;
layout(binding = kFieldIdsUnit) uniform usampler2D triangleIds;
layout(std430, binding = kVertexValuesBuffer) readonly buffer VertexValues { float vertexValues[]; };
layout(binding = kFieldOutImage, rgba32f) uniform writeonly image2D outImage;
uniform ivec2 sizePx;
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/frame/seen_point.glsl"

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  float value = 1.0;
  if (id != 0xffffffffu) {
    const uvec3 v = sceneTriangle(id);
    const vec3 weights = barycentrics(scenePosition(v.x), scenePosition(v.y), scenePosition(v.z),
                                      texelFetch(positions, pixel, 0).xyz);
    value = dot(weights, vec3(vertexValues[v.x], vertexValues[v.y], vertexValues[v.z]));
  }
  imageStore(outImage, pixel, vec4(vec3(value), 1.0));
}
