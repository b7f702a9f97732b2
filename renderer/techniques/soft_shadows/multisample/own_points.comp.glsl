// SPDX-License-Identifier: BSD-3-Clause
// Each pixel's own point, behind its centre, and no further points yet.
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"
#include "renderer/techniques/soft_shadows/multisample/point_tiles.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSurfaceCentreIdsUnit) uniform usampler2D centreIds;
layout(binding = kSurfacePointIdsImage, r32ui) uniform writeonly uimage2D outIds;
layout(binding = kSurfacePlacesImage, rg32f) uniform writeonly image2D outPlaces;
layout(std430, binding = kSurfaceCountsBuffer) writeonly buffer Counts { SurfaceCounts counts; };

void main() {
  const ivec2 point = ivec2(gl_GlobalInvocationID.xy);
  if (point == ivec2(0)) counts = SurfaceCounts(0u, 0u, 0u, 0u);
  if (any(greaterThanEqual(point, pointsPx))) return;
  const bool own = all(lessThan(point, sizePx));
  imageStore(outIds, point, uvec4(own ? texelFetch(centreIds, point, 0).x : 0xffffffffu));
  if (own) imageStore(outPlaces, point, vec4(vec2(point) + 0.5, 0.0, 0.0));
}
