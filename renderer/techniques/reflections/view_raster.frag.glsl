// SPDX-License-Identifier: BSD-3-Clause
// See view_raster.h.
#include "renderer/techniques/reflections/reflection_bindings.h"

flat in uint first;
layout(location = 0) out uint triangle;
layout(std430, binding = kViewGroupsBuffer) readonly buffer Groups { uint groupOf[]; };
uniform uint leftOut;
uniform bool leftHanded;
#ifdef MASKED
layout(binding = kViewImageUnit) uniform usampler2D mask;
uniform uint wanted;
#endif
#ifdef FRONTS_BEHIND_DEPTH
layout(binding = kViewImageUnit) uniform sampler2D before;
#endif

void main() {
  triangle = first + uint(gl_PrimitiveID);
  if (groupOf[triangle] == leftOut) discard;
#ifdef BACK_FACES
  if (gl_FrontFacing != leftHanded) discard;
#endif
#ifdef FRONTS_BEHIND_DEPTH
  if (gl_FrontFacing == leftHanded) discard;
  // More than rounding behind: not the surface itself, drawn again.
  if (gl_FragCoord.z >= texelFetch(before, ivec2(gl_FragCoord.xy), 0).x * (1.0 - 1.0e-5)) discard;
#endif
#ifdef MASKED
  if (texelFetch(mask, ivec2(gl_FragCoord.xy), 0).x != wanted) discard;
#endif
}
