// SPDX-License-Identifier: BSD-3-Clause
// Budget at which the error of coarse micro-occluders stays at the threshold of visibility. See perceptual_budget.h.
#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"
#include "renderer/techniques/soft_shadows/quality/luminance.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kPerceptualBudgetThresholdsUnit) uniform sampler2D thresholds;   // cd/m2
layout(binding = kPerceptualBudgetDirectLightUnit) uniform sampler2D directLight;  // linear, relative to white
layout(binding = kPerceptualBudgetImage, r32f) uniform writeonly image2D outBudget;

uniform ivec2 sizePx;
uniform float whiteCdM2;  // above black
uniform float errorOfOne;         // of the visibility, by one micro-occluder an axis
uniform float allowedThresholds;  // > 0
uniform float leastRoot, mostRoot;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const float wrong = errorOfOne * whiteCdM2 * relativeLuminance(texelFetch(directLight, pixel, 0).rgb);
  const float allowed = allowedThresholds * texelFetch(thresholds, pixel, 0).x;
  // Written so that no error needs the least, and an error where none is allowed the most.
  float root = leastRoot;
  if (wrong > leastRoot * allowed) root = wrong < mostRoot * allowed ? wrong / allowed : mostRoot;
  imageStore(outBudget, pixel, vec4(root * root));
}
