// SPDX-License-Identifier: BSD-3-Clause
// A level for each fragment and each of its sides, an invocation a fragment: from how far bicubic patches with limit points at
// the corners leave their chords (Loop and Schaefer 2008; Bunnell 2005 looks at differences of control points as well). A
// side's is found from points that both neighbours have. UNIFORM: the same for all.
#include "renderer/techniques/subdivision/fragments/fragment.glsl"

layout(local_size_x = kFragmentGroup) in;
layout(std430, binding = kFragmentLevelsBuffer) writeonly buffer Levels { uint levels[]; };
layout(std430, binding = kFragmentCountsBuffer) writeonly buffer Counts { uvec2 counts[]; };
uniform uint mostLevel;
uniform vec3 eye;  // relative to the anchor
uniform float pxAtDistance, nearest, tolerancePx;

bool isSmooth(ivec2 corner) {
  if (corner == ivec2(0)) return !has(kFragmentCrease) && !has(kFragmentCorner);
  return !(corner.y == 0 && has(kFragmentSharpX)) && !(corner.x == 0 && has(kFragmentSharpY));
}

// Control point next to `corner` on the side that leaves it in direction `way`.
vec3 besideCorner(ivec2 corner, ivec2 way) {
  const vec3 v = gridPoint(corner.x, corner.y), e = gridPoint(corner.x + way.x, corner.y + way.y);
  precise vec3 out_ = (2.0 * v + e) / 3.0;
  if (!isSmooth(corner)) return out_;
  if (corner == ivec2(0) && !has(kFragmentRegular)) {
    const int i = int(fragment_.own) + way.y;
    const float k = float(fragment_.edges);
    out_ = (k * v + 2.0 * e + (ringEdge(i - 1) + ringEdge(i + 1)) + 0.5 * (ringFace(i - 1) + ringFace(i))) / (k + 5.0);
    return out_;
  }
  const ivec2 left = corner + way.yx, right = corner - way.yx;
  out_ = (4.0 * v + 2.0 * e + (gridPoint(left.x, left.y) + gridPoint(right.x, right.y)) +
          0.5 * (gridPoint(left.x + way.x, left.y + way.y) + gridPoint(right.x + way.x, right.y + way.y))) / 9.0;
  return out_;
}

vec3 insideCorner(ivec2 corner, ivec2 way, ivec2 other) {
  const bool special = corner == ivec2(0) && !has(kFragmentRegular);
  const float k = special ? float(fragment_.edges) : 4.0;
  const ivec2 a = corner + way, b = corner + other, d = a + other;
  if (!isSmooth(corner)) return (4.0 * gridPoint(corner.x, corner.y) + 2.0 * (gridPoint(a.x, a.y) + gridPoint(b.x, b.y)) + gridPoint(d.x, d.y)) / 9.0;
  return (k * gridPoint(corner.x, corner.y) + 2.0 * (gridPoint(a.x, a.y) + gridPoint(b.x, b.y)) + gridPoint(d.x, d.y)) / (k + 5.0);
}

float nearestOf(vec3 a, vec3 b, vec3 c, vec3 d) {
  return max(nearest, min(min(distance(a, eye), distance(d, eye)), min(distance(b, eye), distance(c, eye))));
}

float secondDifference(vec3 a, vec3 b, vec3 c, vec3 d) {
  precise const vec3 first = (a + c) - 2.0 * b, last = (b + d) - 2.0 * c;
  return max(length(first), length(last));
}

// 4^level times less of a distance is left after so many halvings.
uint levelFor(float px) { return uint(clamp(ceil(0.5 * log2(max(px / tolerancePx, 1e-20))), 0.0, float(mostLevel))); }

void main() {
  const uint number = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(kFragmentGroup);
  if (number >= fragmentCount) return;
#ifdef UNIFORM
  uint own = mostLevel, all_ = mostLevel * 0x11111u;
#else
  openFragment(number);
  vec3 net[16];
  const ivec2 corners[4] = ivec2[4](ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 1));
  const ivec2 ways[4] = ivec2[4](ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1));
  for (int c = 0; c < 4; ++c) {
    const ivec2 at = 3 * corners[c], way = ways[c], other = -ways[(c + 3) % 4];
    const ivec2 a = at + way, b = at + other, d = a + other;
    net[at.x + 4 * at.y] = vertexAt(corners[c].x, corners[c].y, true);
    net[a.x + 4 * a.y] = besideCorner(corners[c], way);
    net[b.x + 4 * b.y] = besideCorner(corners[c], other);
    net[d.x + 4 * d.y] = insideCorner(corners[c], way, other);
  }
  // A cubic leaves its chord by an eighth of its second derivative, six times the difference, at most.
  uint all_ = 0u, own = 0u;
  float u = 0.0, v = 0.0, twist = 0.0, closest = 1e30;
  for (int k = 0; k < 4; ++k) {
    const int across = 4 * k;
    u = max(u, secondDifference(net[across], net[across + 1], net[across + 2], net[across + 3]));
    v = max(v, secondDifference(net[k], net[k + 4], net[k + 8], net[k + 12]));
    closest = min(closest, nearestOf(net[across], net[across + 1], net[across + 2], net[across + 3]));
  }
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const int at = i + 4 * j;
      twist = max(twist, length(net[at] - net[at + 1] - net[at + 4] + net[at + 5]));
    }
  own = levelFor((0.75 * (u + v) + 2.25 * twist) * pxAtDistance / closest);
  const int starts[4] = int[4](0, 3, 12, 0), strides[4] = int[4](1, 4, 1, 4);
  for (int s = 0; s < 4; ++s) {
    const vec3 a = net[starts[s]], b = net[starts[s] + strides[s]], c = net[starts[s] + 2 * strides[s]],
               d = net[starts[s] + 3 * strides[s]];
    const uint of = levelFor(0.75 * secondDifference(a, b, c, d) * pxAtDistance / nearestOf(a, b, c, d));
    all_ |= of << (4 + 4 * s);
    own = max(own, of);
  }
  all_ |= own;
#endif
  levels[number] = all_;
  const uint n = 1u << own;
  counts[number] = uvec2((n + 1u) * (n + 1u), 2u * n * n);
}
