// SPDX-License-Identifier: BSD-3-Clause
// An entry of a list of cuts as a point. APPEND: captured as it is; else for feedback_cut.geom.glsl.
#include "renderer/many_lods/many_lods_bindings.h"

layout(location = 0) in uvec2 entry;

#ifdef APPEND
layout(xfb_buffer = 0, xfb_offset = 0, xfb_stride = 8) flat out uvec2 finished;
void main() {
  finished = entry;
  gl_Position = vec4(0.0);
}
#else
flat out uvec2 entryIn;
void main() {
  entryIn = entry;
  gl_Position = vec4(0.0);
}
#endif
