// SPDX-License-Identifier: BSD-3-Clause
// Views of receivers: hemispheres above what every so many pixels see.
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGatherGroup) in;
layout(std430, binding = kGatherViewsBuffer) writeonly buffer Views { CutView views[]; };
layout(binding = kGatherPositionsUnit) uniform sampler2D positions;
layout(binding = kGatherNormalsUnit) uniform sampler2D normals;

uniform ivec2 sizePx, gridSize;
uniform int spacing;
uniform float lift, sizeFactor, inverseRange;

void main() {
  const int index = int(gl_GlobalInvocationID.x);
  if (index >= gridSize.x * gridSize.y) return;
  const ivec2 pixel = min(ivec2(index % gridSize.x, index / gridSize.x) * spacing + spacing / 2, sizePx - 1);
  const vec4 position = texelFetch(positions, pixel, 0);
  // Where there is no surface, a view from far outside into the distance, whose cut is the root.
  vec3 normal = vec3(0.0, 0.0, 1.0);
  CutView view;
  view.eye = vec4(0.0, 0.0, 1e6 / inverseRange, sizeFactor);
  if (position.w > 0.0) {
    normal = texelFetch(normals, pixel, 0).xyz;
    view.eye.xyz = position.xyz + lift * normal;
  }
  const vec3 side = normalize(cross(normal, abs(normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  view.axisX = vec4(side, 1.0);
  view.axisY = vec4(cross(normal, side), 1.0);
  view.axisZ = vec4(normal, float(kViewHemisphere));
  view.frustum = vec4(1.0, 1.0, inverseRange, 0.0);
  views[index] = view;
}
