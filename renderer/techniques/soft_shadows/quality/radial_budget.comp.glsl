// SPDX-License-Identifier: BSD-3-Clause
// Budget by the distance from a centre, in half widths of the image.
#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kRadialBudgetImage, r32f) uniform writeonly image2D outBudget;

uniform ivec2 sizePx;
uniform vec2 centre;                // share of the image
uniform float innerRadius, outerRadius;  // inner < outer
uniform float innerRoot, outerRoot;      // roots of the budgets there

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec2 from = vec2(pixel) + 0.5 - centre * vec2(sizePx);
  const float away = length(from) / (0.5 * float(sizePx.x));
  const float along = clamp((away - innerRadius) / (outerRadius - innerRadius), 0.0, 1.0);
  const float root = mix(innerRoot, outerRoot, along);
  imageStore(outBudget, pixel, vec4(root * root));
}
