// SPDX-License-Identifier: BSD-3-Clause
// A triangle to all voxels that it meets, as long as CAP vertices last: in each slice it is drawn with its edges moved outwards by
// half a pixel along both axes and clipped to its bounds, which grow as much (Hasselgren 2005). CUT: only what of it lies in the
// slice, whose pixels then are just those; otherwise all of it, for fragments to be tested.
#include "renderer/techniques/voxelization/slice_target.glsl"
#include "renderer/techniques/voxelization/voxelization_bindings.h"

layout(triangle_strip, max_vertices = CAP) out;

const int kMostCorners = 16;
vec2 outline[kMostCorners];
int corners = 0;

// Keeps dot(n, x) <= most.
void clipOutline(vec2 n, float most) {
  vec2 kept[kMostCorners];
  int count = 0;
  for (int i = 0; i < corners; ++i) {
    const vec2 p = outline[i], q = outline[(i + 1) % corners];
    const float a = dot(n, p) - most, b = dot(n, q) - most;
    if (a <= 0.0 && count < kMostCorners) kept[count++] = p;
    if (min(a, b) < 0.0 && max(a, b) > 0.0 && count < kMostCorners) kept[count++] = mix(p, q, a / (a - b));
  }
  corners = count;
  outline = kept;
}

struct Piece {
  vec3 at[5];
  int count;
};

// Keeps what lies on the side of a plane across AXIS.
Piece cut(Piece piece, float depth, float side) {
  Piece kept;
  kept.count = 0;
  for (int i = 0; i < piece.count; ++i) {
    const vec3 p = piece.at[i], q = piece.at[(i + 1) % piece.count];
    const float a = side * (p[AXIS] - depth), b = side * (q[AXIS] - depth);
    if (a >= 0.0 && kept.count < 5) kept.at[kept.count++] = p;
    if (min(a, b) < 0.0 && max(a, b) > 0.0 && kept.count < 5) kept.at[kept.count++] = mix(p, q, a / (a - b));
  }
  return kept;
}

void outlineOf(Piece piece) {
  const float reach = 0.5 + kRasterSlack;
  vec2 low = across(piece.at[0]), high = low;
  for (int i = 1; i < piece.count; ++i) {
    low = min(low, across(piece.at[i]));
    high = max(high, across(piece.at[i]));
  }
  low -= reach;
  high += reach;
  corners = 4;
  outline[0] = low;
  outline[1] = vec2(high.x, low.y);
  outline[2] = high;
  outline[3] = vec2(low.x, high.y);
  for (int i = 0; i < piece.count; ++i) {
    const vec2 from = across(piece.at[i]), edge = across(piece.at[(i + 1) % piece.count]) - from;
    const float size = length(edge);
    if (!(size > 0.0)) continue;
    const vec2 n = vec2(edge.y, -edge.x) / size;
    float least = 0.0, most = 0.0;
    for (int k = 0; k < piece.count; ++k) {
      const float beside = dot(n, across(piece.at[k]) - from);
      least = min(least, beside);
      most = max(most, beside);
    }
    // Of a sliver no side is known to be the outer one.
    const float grown = reach * (abs(n.x) + abs(n.y)), at = dot(n, from);
    if (most < kRasterSlack) clipOutline(n, at + most + grown);
    if (least > -kRasterSlack) clipOutline(-n, -(at + least) + grown);
  }
}

void main() {
  const ivec2 slices = slicesReached(kVoxelSlack);
  Piece whole;
  whole.count = 3;
  for (int i = 0; i < 3; ++i) whole.at[i] = place[i];
  int emitted = 0;
  for (int slice = slices.x; slice <= slices.y; ++slice) {
    Piece piece = whole;
#ifdef CUT
    piece = cut(cut(whole, float(slice) - kVoxelSlack, 1.0), float(slice + 1) + kVoxelSlack, -1.0);
    if (piece.count == 0) continue;
#endif
    outlineOf(piece);
    emitted += corners;
    if (emitted > CAP) return;
    for (int i = 0; i < corners; ++i) {
      const vec2 at = outline[(i & 1) == 1 ? (i + 1) / 2 : (corners - i / 2) % corners];
      gl_Position = onLayerAcross(at);
      gl_Layer = slice;
      triangle = firstTriangle[0] + uint(gl_PrimitiveIDIn);
      EmitVertex();
    }
    EndPrimitive();
  }
}
