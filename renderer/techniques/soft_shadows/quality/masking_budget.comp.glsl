// SPDX-License-Identifier: BSD-3-Clause
// Budget by the RMS contrast around a pixel. ROWS: number, mean and sum of squared differences from it of each pixel's row of
// the window; otherwise the columns of these, and the budget. Sums of squares less squared sums would leave only rounding
// where the picture is plain.
#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"
#include "renderer/techniques/soft_shadows/quality/luminance.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
uniform ivec2 sizePx;
uniform int radius;

#ifdef ROWS
layout(binding = kMaskingBudgetPictureUnit) uniform sampler2D picture;    // linear, 0..1
layout(binding = kMaskingBudgetReceiversUnit) uniform sampler2D receivers;  // w < 0: none
layout(binding = kMaskingBudgetRowsImage, rgba32f) uniform writeonly image2D outRows;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const int low = max(pixel.x - radius, 0), high = min(pixel.x + radius, sizePx.x - 1);
  float count = 0.0, sum = 0.0;
  for (int x = low; x <= high; ++x) {
    if (texelFetch(receivers, ivec2(x, pixel.y), 0).w < 0.0) continue;
    count += 1.0;
    sum += relativeLuminance(texelFetch(picture, ivec2(x, pixel.y), 0).rgb);
  }
  const float mean = count > 0.0 ? sum / count : 0.0;
  float squares = 0.0;
  for (int x = low; x <= high; ++x) {
    if (texelFetch(receivers, ivec2(x, pixel.y), 0).w < 0.0) continue;
    const float away = relativeLuminance(texelFetch(picture, ivec2(x, pixel.y), 0).rgb) - mean;
    squares += away * away;
  }
  imageStore(outRows, pixel, vec4(count, mean, squares, 0.0));
}
#else
layout(binding = kMaskingBudgetRowsUnit) uniform sampler2D rows;
layout(binding = kMaskingBudgetImage, r32f) uniform writeonly image2D outBudget;
uniform float lowContrast, highContrast;  // low < high
uniform float leastRoot, mostRoot;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const int low = max(pixel.y - radius, 0), high = min(pixel.y + radius, sizePx.y - 1);
  float count = 0.0, sum = 0.0;
  for (int y = low; y <= high; ++y) {
    const vec2 row = texelFetch(rows, ivec2(pixel.x, y), 0).xy;
    count += row.x;
    sum += row.x * row.y;
  }
  const float mean = count > 0.0 ? sum / count : 0.0;
  float squares = 0.0;
  for (int y = low; y <= high; ++y) {
    const vec3 row = texelFetch(rows, ivec2(pixel.x, y), 0).xyz;
    squares += row.z + row.x * (row.y - mean) * (row.y - mean);
  }
  const float contrast = mean > 0.0 ? sqrt(squares / count) / mean : 0.0;
  const float masked = clamp((contrast - lowContrast) / (highContrast - lowContrast), 0.0, 1.0);
  // Not mix(), which may miss a root that both ends share.
  const float root = mostRoot + (leastRoot - mostRoot) * masked;
  imageStore(outBudget, pixel, vec4(root * root));
}
#endif
