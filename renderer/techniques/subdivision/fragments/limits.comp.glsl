// SPDX-License-Identifier: BSD-3-Clause
// Limit points and normals of a level's vertices, an invocation each: of fragments that have reached their level, those
// inside; of sides, those at the side's own level, which both neighbours make from the same points; of corners, those of the
// first level. Vertices of a fragment that its side has no place for go to the nearest place that it has.
#include "renderer/techniques/tessellation/tessellation_bindings.h"
#include "renderer/techniques/subdivision/fragments/fragment.glsl"

layout(local_size_x = kFragmentGroup) in;
layout(std430, binding = kFragmentLevelsBuffer) readonly buffer Levels { uint levels[]; };
layout(std430, binding = kFragmentOffsetsBuffer) readonly buffer Offsets { uvec2 offsets[]; };
layout(std430, binding = kFragmentVerticesBuffer) writeonly buffer Vertices { uvec4 vertices[]; };
uniform uint level;

// Across a sharp edge between the rows `near` and, towards the quad, `far`.
vec3 creaseTangent(vec3 nearA, vec3 near, vec3 nearB, vec3 farA, vec3 far, vec3 farB) {
  return (farA - nearA) + 4.0 * (far - near) + (farB - nearB);
}

// Around (0, 0) between two sharp edges (Biermann, Levin and Zorin 2000).
vec3 sectorNormal() {
  const vec3 v = gridPoint(0, 0);
  const int first = int(fragment_.sectorFirst), faces = int(fragment_.sectorFaces);
  const vec3 a = ringEdge(first), b = ringEdge(first + faces);
  if (has(kFragmentCorner) || faces == 1) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < faces; ++i) sum += cross(ringEdge(first + i) - v, ringEdge(first + i + 1) - v);
    return sum;
  }
  const float turn = 3.14159265358979 / float(faces), c = cos(turn), r = (c + 1.0) / sin(turn);
  vec3 across = 4.0 * r * (c - 1.0) * v - r * (1.0 + 2.0 * c) * (a + b);
  for (int i = 0; i < faces; ++i) {
    across += 4.0 * sin(float(i) * turn) * ringEdge(first + i);
    across += (sin(float(i) * turn) + sin(float(i + 1) * turn)) * ringFace(first + i);
  }
  return cross(a - b, across);
}

vec3 extraordinaryNormal() {
  const int n = int(fragment_.edges);
  const float turn = 6.28318530717959 / float(n), half_ = cos(0.5 * turn);
  const float diagonal = 1.0 / sqrt(4.0 + half_ * half_);
  vec3 along = vec3(0.0), across = vec3(0.0);
  for (int i = 0; i < n; ++i) {
    const float at = turn * float(i), beside = at + 0.5 * turn;
    const vec3 e = (1.0 + half_ * diagonal) * ringEdge(i), f = diagonal * ringFace(i);
    along += cos(at) * e + cos(beside) * f;
    across += sin(at) * e + sin(beside) * f;
  }
  return cross(along, across);
}

vec3 normalAt(int x, int y) {
  if (x == 0 && y == 0 && !has(kFragmentRegular))
    return has(kFragmentCorner) || has(kFragmentCrease) ? sectorNormal() : extraordinaryNormal();
  const vec3 left = gridPoint(x - 1, y), right = gridPoint(x + 1, y), below = gridPoint(x, y - 1), above = gridPoint(x, y + 1),
             v = gridPoint(x, y);
  if (y == 0 && has(kFragmentSharpX))
    return cross(right - left, creaseTangent(left, v, right, gridPoint(x - 1, y + 1), above, gridPoint(x + 1, y + 1)));
  if (x == 0 && has(kFragmentSharpY))
    return cross(creaseTangent(below, v, above, gridPoint(x + 1, y - 1), right, gridPoint(x + 1, y + 1)), above - below);
  const vec3 ur = gridPoint(x + 1, y + 1), ul = gridPoint(x - 1, y + 1), dl = gridPoint(x - 1, y - 1), dr = gridPoint(x + 1, y - 1);
  return cross(4.0 * (right - left) + (ur - ul) + (dr - dl), 4.0 * (above - below) + (ur - dr) + (ul - dl));
}

uint firstVertex = 0u, own = 0u;  // of the fragment: its vertices, its level
uvec4 position_ = uvec4(0u), normal_ = uvec4(0u);

void write(ivec2 place) {
  const uint at = firstVertex + uint(place.x) + ((1u << own) + 1u) * uint(place.y);
  vertices[2u * at] = position_;
  vertices[2u * at + 1u] = normal_;
}

// To all vertices along the side of which place `q` of the side's is the nearest.
void writeSide(int side, uint sideLevel, int q) {
  const int shift = int(own - sideLevel), half_ = (1 << shift) >> 1, last = 1 << own;
  const int from = max((q << shift) - half_, 0), to = shift == 0 ? q : min((q << shift) + half_ - 1, last);
  for (int i = from; i <= to; ++i)
    write((side & 1) == 0 ? ivec2(i, side == 0 ? 0 : last) : ivec2(side == 1 ? last : 0, i));
}

void main() {
  const uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(kFragmentGroup);
  const uint row = uint(segments) + 1u, at = i / (row * row), local = i % (row * row);
  if (at >= fragmentsOfLevel(level)) return;
  const uint number = listedFragment(level, at);
  const uint all_ = levels[number];
  own = all_ & 15u;
  const int x = int(local % row), y = int(local / row), last = segments;
  const bool onX = x == 0 || x == last, onY = y == 0 || y == last;
  const int sideX = x == 0 ? 3 : 1, sideY = y == 0 ? 0 : 2;
  const uint levelX = all_ >> (4 + 4 * sideX) & 15u, levelY = all_ >> (4 + 4 * sideY) & 15u;
  if (onX && onY ? level > 0u : level != (onX ? levelX : (onY ? levelY : own))) return;
  openFragment(number);
  const vec3 n = normalAt(x, y);
  const float reach = max(abs(n.x), max(abs(n.y), abs(n.z)));
  position_ = uvec4(floatBitsToUint(vertexAt(x, y, true)), fragment_.material);
  normal_ = uvec4(floatBitsToUint(reach > 0.0 ? normalize(n / reach) : vec3(0.0, 0.0, 1.0)), kRungField);
  firstVertex = offsets[number].x;
  if (onX && onY) {
    writeSide(sideX, levelX, y == 0 ? 0 : 1 << levelX);
    writeSide(sideY, levelY, x == 0 ? 0 : 1 << levelY);
  } else if (onX) {
    writeSide(sideX, levelX, y);
  } else if (onY) {
    writeSide(sideY, levelY, x);
  } else {
    write(ivec2(x, y));
  }
}
