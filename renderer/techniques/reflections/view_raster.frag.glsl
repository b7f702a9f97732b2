// SPDX-License-Identifier: BSD-3-Clause
// See view_raster.h.
#include "renderer/techniques/reflections/reflection_bindings.h"

flat in uint first;
layout(location = 0) out uint triangle;
layout(std430, binding = kViewGroupsBuffer) readonly buffer Groups { uint groupOf[]; };
uniform uint leftOut;
#ifdef MASKED
layout(binding = kViewMaskUnit) uniform usampler2D mask;
uniform uint wanted;
#endif

void main() {
  triangle = first + uint(gl_PrimitiveID);
  if (groupOf[triangle] == leftOut) discard;
#ifdef MASKED
  if (texelFetch(mask, ivec2(gl_FragCoord.xy), 0).x != wanted) discard;
#endif
}
