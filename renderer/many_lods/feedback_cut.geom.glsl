// SPDX-License-Identifier: BSD-3-Clause
// What becomes of an entry, by one edge of the tree: stream 0 has what the next pass looks at, stream 1 what is finished. Source:
// Holländer 2013, listing 3.1, to the end in each frame.
#include "renderer/many_lods/node_predicate.glsl"

layout(points) in;
layout(points, max_vertices = 2) out;
flat in uvec2 entryIn[1];

layout(stream = 0, xfb_buffer = 0, xfb_offset = 0, xfb_stride = 8) flat out uvec2 open;
layout(stream = 1, xfb_buffer = 1, xfb_offset = 0, xfb_stride = 8) flat out uvec2 finished;

// Storage blocks are not granted to geometry shaders.
layout(binding = kFeedbackNodesUnit) uniform samplerBuffer nodes;
layout(binding = kFeedbackViewsUnit) uniform samplerBuffer views;
uniform uint leaves;

bool valid(uint node, CutView view) { return isValid(texelFetch(nodes, int(node)), node, leaves, view); }

void goOn(uint node) {
  open = uvec2(node, entryIn[0].y);
  EmitStreamVertex(0);
  EndStreamPrimitive(0);
}

void main() {
  const uint node = entryIn[0].x;
  const int at = 5 * int(entryIn[0].y);
  const CutView view = CutView(texelFetch(views, at), texelFetch(views, at + 1), texelFetch(views, at + 2), texelFetch(views, at + 3),
                               texelFetch(views, at + 4));
  if (!valid(node, view)) {
    goOn(2u * node);
    goOn(2u * node + 1u);
    return;
  }
  if (node != kRootNode && valid(node >> 1u, view)) {
    if ((node & 1u) == 0u) goOn(node >> 1u);
    return;
  }
  finished = entryIn[0];
  EmitStreamVertex(1);
  EndStreamPrimitive(1);
}
