// SPDX-License-Identifier: BSD-3-Clause
// Budgets scaled by what the frame's time allows.
#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"
#include "renderer/techniques/soft_shadows/quality/dither.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kFrameTimeBudgetImage, r32f) uniform writeonly image2D outBudget;
#ifdef BASE_MAP
layout(binding = kFrameTimeBudgetBaseMapUnit) uniform sampler2D baseMap;
#endif

uniform ivec2 sizePx;
uniform float baseRoot;
uniform float rootScale;  // <= 1
uniform float leastRoot;  // budgets below it are left as they are
uniform bool dithers;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  float whole = baseRoot;
#ifdef BASE_MAP
  whole = sqrt(texelFetch(baseMap, pixel, 0).x);
#endif
  float root = max(whole * rootScale, min(leastRoot, whole));
  // The other way round than elsewhere, so that what levels make of the same numbers does not go along with this.
  if (dithers && rootScale < 1.0)
    root = min(floor(root) + (fract(root) > ditherThreshold(pixel.yx) ? 1.0 : 0.0), whole);
  imageStore(outBudget, pixel, vec4(root * root));
}
