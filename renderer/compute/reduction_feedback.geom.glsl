// SPDX-License-Identifier: BSD-3-Clause
// Passes valid items on to transform feedback.
layout(points) in;
layout(points, max_vertices = 1) out;
flat in uvec2 item[1];
flat in uint valid[1];

#if LANES == 1
layout(xfb_buffer = 0, xfb_stride = 4) out;
layout(xfb_buffer = 0, xfb_offset = 0) flat out uint itemOut;
#else
layout(xfb_buffer = 0, xfb_stride = 8) out;
layout(xfb_buffer = 0, xfb_offset = 0) flat out uvec2 itemOut;
#endif

void main() {
  if (valid[0] == 0u) return;
#if LANES == 1
  itemOut = item[0].x;
#else
  itemOut = item[0];
#endif
  EmitVertex();
  EndPrimitive();
}
