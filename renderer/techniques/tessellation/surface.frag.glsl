// SPDX-License-Identifier: BSD-3-Clause
// A curved surface's material, normal and distance. See surface_picture.h.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

in vec3 normal;
in float distance_;
flat in uint material;
layout(location = 0) out uint id;
layout(location = 1) out vec4 normalAndDistance;

void main() {
  id = kSurfaceOfPatch | material;
  // The triangle decides which side is seen.
  normalAndDistance = vec4(gl_FrontFacing ? normal : -normal, distance_);
}
