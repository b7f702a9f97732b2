// SPDX-License-Identifier: BSD-3-Clause
// A curved surface's material, normal and distance. See surface_picture.h.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

in vec3 normal;
in float distance_;
flat in uint material;
layout(location = 0) out uint id;
layout(location = 1) out vec4 normalAndDistance;

#ifdef TEXTURED
in vec2 texturePlace;
#include "renderer/techniques/tessellation/surface_texture.glsl"
#endif

#ifdef TRIMMED
in vec2 trimPlace;
flat in int trimRegion;
layout(binding = kTrimsUnit) uniform sampler2DArray trims;
uniform float leastLeft;  // what is left holds more
#endif

void main() {
#ifdef TRIMMED
  if (trimRegion >= 0 && !(textureLod(trims, vec3(trimPlace, float(trimRegion)), 0.0).x > leastLeft)) discard;
#endif
  id = kSurfaceOfPatch | material;
#ifdef TEXTURED
  if (onDarkCheck(texturePlace)) id |= kSurfaceDarkCheck;
#endif
  // The triangle decides which side is seen.
  normalAndDistance = vec4(gl_FrontFacing ? normal : -normal, distance_);
}
