// SPDX-License-Identifier: BSD-3-Clause
// A triangle cut into the slices that it reaches (Gaitatzes 2012, algorithm 5, cases A to F), as long as CAP vertices last. As
// nothing is culled by its side, the order of vertices is free. The printed test of case A is the wrong way round.
#include "renderer/techniques/voxelization/slice_target.glsl"

layout(triangle_strip, max_vertices = CAP) out;

int emitted = 0;

void send(vec3 v, int layer) {
  gl_Position = onLayer(v);
  gl_Layer = layer;
  carry(v);
  EmitVertex();
}

// Layer -1: what lies before the grid. False: no vertices are left.
bool sendTriangle(vec3 a, vec3 b, vec3 c, int layer) {
  if (layer < 0) return true;
  if (emitted + 3 > CAP) return false;
  emitted += 3;
  send(a, layer);
  send(b, layer);
  send(c, layer);
  EndPrimitive();
  return true;
}
bool sendQuad(vec3 right, vec3 left, vec3 left2, vec3 right2, int layer) {
  if (layer < 0) return true;
  if (emitted + 4 > CAP) return false;
  emitted += 4;
  send(right, layer);
  send(left, layer);
  send(right2, layer);
  send(left2, layer);
  EndPrimitive();
  return true;
}

vec3 cut(vec3 p, vec3 q, float depth) {
  vec3 at = mix(p, q, clamp((depth - p[AXIS]) / (q[AXIS] - p[AXIS]), 0.0, 1.0));
  at[AXIS] = depth;
  return at;
}

void order(inout vec3 p, inout vec3 q) {
  if (p[AXIS] <= q[AXIS]) return;
  const vec3 other = p;
  p = q;
  q = other;
}

void main() {
  if (!isAssigned()) return;
  vec3 v1 = place[0], v2 = place[1], v3 = place[2];
  order(v1, v2);
  order(v2, v3);
  order(v1, v2);
  const int size = gridSize()[AXIS];
  if (!(v3[AXIS] >= -kVoxelSlack && v1[AXIS] <= float(size) + kVoxelSlack)) return;
  // A surface in the grid's low side, but for rounding, is in its first slice.
  int layer = v1[AXIS] >= -kVoxelSlack ? clamp(int(floor(v1[AXIS])), 0, size - 1) : -1;
  float slice = float(layer + 1);
  if (v3[AXIS] < slice || layer == size - 1) {  // A
    sendTriangle(v1, v2, v3, layer);
    return;
  }
  vec3 right = v1, left = v1, right2 = cut(v1, v3, slice), left2;
  bool passed = v2[AXIS] < slice;  // the middle vertex
  if (passed) {
    left2 = cut(v2, v3, slice);
    if (!sendQuad(v1, v2, left2, right2, layer)) return;
  } else {
    left2 = cut(v1, v2, slice);
    if (!sendTriangle(v1, left2, right2, layer)) return;
  }
  while (true) {
    ++layer;
    slice += 1.0;
    right = right2;
    left = left2;
    const bool last = v3[AXIS] < slice || layer == size - 1;
    if (last) {
      if (passed)
        sendTriangle(right, left, v3, layer);  // D
      else
        sendQuad(right, left, v2, v3, layer);  // C
      return;
    }
    right2 = cut(v1, v3, slice);
    if (passed) {  // E
      left2 = cut(v2, v3, slice);
      if (!sendQuad(right, left, left2, right2, layer)) return;
    } else if (v2[AXIS] < slice) {  // F
      const vec3 middle = cut(v1, v3, v2[AXIS]);
      if (!sendQuad(right, left, v2, middle, layer)) return;
      left2 = cut(v2, v3, slice);
      if (!sendQuad(middle, v2, left2, right2, layer)) return;
      passed = true;
    } else {  // B
      left2 = cut(v1, v2, slice);
      if (!sendQuad(right, left, left2, right2, layer)) return;
    }
  }
}
