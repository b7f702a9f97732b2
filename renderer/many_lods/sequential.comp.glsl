// SPDX-License-Identifier: BSD-3-Clause
// An invocation a view: walks the tree from the root and draws what is fine enough. See sequential_cuts.h.
#include "renderer/many_lods/node_predicate.glsl"

layout(local_size_x = kSequentialGroup) in;
layout(std430, binding = kCutNodesBuffer) readonly buffer Nodes { vec4 nodes[]; };
layout(std430, binding = kCutViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kSplatDepthsBuffer) buffer Depths { uint depths[]; };
layout(std430, binding = kInPlaceCountsBuffer) buffer Counts { InPlaceCounts counts; };
#include "renderer/many_lods/splat_disc.glsl"

uniform uint leaves, viewCount;

void main() {
  const uint number = gl_GlobalInvocationID.x;
  if (number >= viewCount) return;
  const CutView view = views[number];
  uint node = kRootNode, drawn = 0u;
  while (node != 0u) {
    const vec4 sphere = nodes[node];
    if (!isCulled(sphere.xyz, sphere.w, node, leaves, view)) {
      if (node < leaves && !isFineEnough(sphere, view)) {
        node *= 2u;
        continue;
      }
      ++drawn;
      Disc disc;
      if (discOf(uvec2(node, number), disc)) {
        ivec2 low, high;
        boxOf(disc, low, high);
        for (int y = low.y; y <= high.y; ++y)
          for (int x = low.x; x <= high.x; ++x) {
            uint depth;
            if (!coversPixel(disc, ivec2(x, y), depth)) continue;
            const uint at = (number * uint(tilePx.y) + uint(y)) * uint(tilePx.x) + uint(x);
            if (depth < depths[at]) depths[at] = depth;  // its own tile
          }
      }
    }
    // The next one to the right.
    while ((node & 1u) != 0u) node >>= 1u;
    if (node != 0u) ++node;
  }
  if (node != 0u) atomicAdd(counts.unfinished, 1u);
  atomicAdd(counts.drawn, drawn);
}
