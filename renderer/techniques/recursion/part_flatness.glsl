// SPDX-License-Identifier: BSD-3-Clause
// Whether a part of a cubic patch is seen, and flat on the screen. The including shader defines
// vec4 patchPoint(uint), a control point relative to the anchor.
uniform mat4 anchorToClip;
uniform vec2 halfSize;  // of the picture, px
uniform float nearest, tolerance;

// Of the part: x and y in pixels times the distance along the view, and that distance.
vec3 points[16];
vec2 screen(int i) { return points[i].xy / points[i].z; }

vec3 clipPoint(uint i) {
  const vec4 clip = anchorToClip * patchPoint(i);
  return vec3(clip.xy * halfSize, clip.w);
}

// Of a cubic curve's part [a, b].
void curvePart(inout vec3 p0, inout vec3 p1, inout vec3 p2, inout vec3 p3, float a, float b) {
  const vec3 a0 = mix(p0, p1, a), a1 = mix(p1, p2, a), a2 = mix(p2, p3, a);
  const vec3 b0 = mix(p0, p1, b), b1 = mix(p1, p2, b), b2 = mix(p2, p3, b);
  const vec3 aa0 = mix(a0, a1, a), aa1 = mix(a1, a2, a), ab0 = mix(a0, a1, b), ab1 = mix(a1, a2, b),
             bb0 = mix(b0, b1, b), bb1 = mix(b1, b2, b);
  p0 = mix(aa0, aa1, a);
  p1 = mix(aa0, aa1, b);
  p2 = mix(ab0, ab1, b);
  p3 = mix(bb0, bb1, b);
}

void rectanglePart(uint first, vec2 low, vec2 high) {
  for (int i = 0; i < 16; ++i) points[i] = clipPoint(first + uint(i));
  for (int j = 0; j < 16; j += 4) curvePart(points[j], points[j + 1], points[j + 2], points[j + 3], low.x, high.x);
  for (int i = 0; i < 4; ++i) curvePart(points[i], points[i + 4], points[i + 8], points[i + 12], low.y, high.y);
}

vec3 triangleBlossom(vec3 c[10], vec3 x, vec3 y, vec3 z) {
  const vec3 c200 = x.x * c[0] + x.y * c[1] + x.z * c[2], c110 = x.x * c[1] + x.y * c[3] + x.z * c[4],
             c101 = x.x * c[2] + x.y * c[4] + x.z * c[5], c020 = x.x * c[3] + x.y * c[6] + x.z * c[7],
             c011 = x.x * c[4] + x.y * c[7] + x.z * c[8], c002 = x.x * c[5] + x.y * c[8] + x.z * c[9];
  return z.x * (y.x * c200 + y.y * c110 + y.z * c101) + z.y * (y.x * c110 + y.y * c020 + y.z * c011) +
         z.z * (y.x * c101 + y.y * c011 + y.z * c002);
}

void trianglePart(uint first, vec2 a2, vec2 b2, vec2 c2) {
  vec3 net[10];
  for (int i = 0; i < 10; ++i) net[i] = clipPoint(first + uint(i));
  const vec3 a = vec3(a2, 1.0 - a2.x - a2.y), b = vec3(b2, 1.0 - b2.x - b2.y), c = vec3(c2, 1.0 - c2.x - c2.y);
  points[0] = triangleBlossom(net, a, a, a);
  points[1] = triangleBlossom(net, a, a, b);
  points[2] = triangleBlossom(net, a, a, c);
  points[3] = triangleBlossom(net, a, b, b);
  points[4] = triangleBlossom(net, a, b, c);
  points[5] = triangleBlossom(net, a, c, c);
  points[6] = triangleBlossom(net, b, b, b);
  points[7] = triangleBlossom(net, b, b, c);
  points[8] = triangleBlossom(net, b, c, c);
  points[9] = triangleBlossom(net, c, c, c);
}

#if FLATNESS == FLATNESS_CONTROL_TO_CHORD
float toSegment(vec2 p, vec2 a, vec2 b) {
  const vec2 d = b - a;
  const float squared = dot(d, d);
  return distance(p, a + (squared > 0.0 ? clamp(dot(p - a, d) / squared, 0.0, 1.0) : 0.0) * d);
}
#endif

float curveFlatness(int i0, int i1, int i2, int i3) {
  const vec2 a = screen(i0), d = screen(i3);
#if FLATNESS == FLATNESS_CONTROL_TO_CHORD
  return max(toSegment(screen(i1), a, d), toSegment(screen(i2), a, d));
#elif FLATNESS == FLATNESS_CONTROL_TO_CORRESPONDING
  return max(distance(screen(i1), mix(a, d, 1.0 / 3.0)), distance(screen(i2), mix(a, d, 2.0 / 3.0)));
#else
  vec2 low = min(a, d), high = max(a, d);
  low = min(low, min(screen(i1), screen(i2)));
  high = max(high, max(screen(i1), screen(i2)));
  return distance(low, high);
#endif
}

#if FLATNESS == FLATNESS_CONTROL_TO_CHORD
float doubledArea(vec2 a, vec2 b, vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }
float toTriangle(vec2 p, vec2 a, vec2 b, vec2 c) {
  const float s = doubledArea(a, b, c) < 0.0 ? -1.0 : 1.0;
  if (s * doubledArea(a, b, p) >= 0.0 && s * doubledArea(b, c, p) >= 0.0 && s * doubledArea(c, a, p) >= 0.0) return 0.0;
  return min(toSegment(p, a, b), min(toSegment(p, b, c), toSegment(p, c, a)));
}
#endif

float interiorFlatness(bool rectangle) {
  const int count = rectangle ? 16 : 10;
#if FLATNESS == FLATNESS_EXTENT
  vec2 low = screen(0), high = low;
  for (int i = 1; i < count; ++i) {
    low = min(low, screen(i));
    high = max(high, screen(i));
  }
  return distance(low, high);
#else
  const vec2 a = screen(0), b = screen(rectangle ? 3 : 6), c = screen(rectangle ? 15 : 9), d = screen(rectangle ? 12 : 0);
  float most = 0.0;
  for (int i = 0; i < count; ++i) {
    const vec2 p = screen(i);
#if FLATNESS == FLATNESS_CONTROL_TO_CHORD
    float away = toTriangle(p, a, b, c);
    if (rectangle) away = min(away, toTriangle(p, a, c, d));
#else
    vec2 flat_;
    if (rectangle) {
      flat_ = mix(mix(a, b, float(i % 4) / 3.0), mix(d, c, float(i % 4) / 3.0), float(i / 4) / 3.0);
    } else {
      const int row = i == 0 ? 0 : i < 3 ? 1 : i < 6 ? 2 : 3, k = i - row * (row + 1) / 2;
      flat_ = (float(3 - row) * a + float(row - k) * b + float(k) * c) / 3.0;
    }
    const float away = distance(p, flat_);
#endif
    most = max(most, away);
  }
  return most;
#endif
}

bool isOutside(int count) {
  bvec2 right = bvec2(true), left = bvec2(true);
  bool before = true;
  for (int i = 0; i < count; ++i) {
    right = bvec2(uvec2(right) & uvec2(greaterThan(points[i].xy, halfSize * points[i].z)));
    left = bvec2(uvec2(left) & uvec2(lessThan(points[i].xy, -halfSize * points[i].z)));
    before = before && points[i].z < nearest;
  }
  return any(right) || any(left) || before;
}

struct PartTest {
  bool outside;
  bvec4 bent;  // sides that are not flat
  bool any_;   // a side or the interior is not flat
};

PartTest testOf(RecursionPart part, uint firstPoint, bool rectangle) {
  const vec2 a = part.corners.xy, b = part.corners.zw;
  if (rectangle) {
    rectanglePart(firstPoint, a, b);
  } else {
    trianglePart(firstPoint, a, b, vec2(part.lastU, part.lastV));
  }
  const int count = rectangle ? 16 : 10;
  PartTest test = PartTest(isOutside(count), bvec4(true), true);
  for (int i = 0; i < count; ++i)
    if (points[i].z < nearest) return test;
  test.bent = rectangle ? bvec4(curveFlatness(0, 1, 2, 3) > tolerance, curveFlatness(3, 7, 11, 15) > tolerance,
                                curveFlatness(15, 14, 13, 12) > tolerance, curveFlatness(12, 8, 4, 0) > tolerance)
                        : bvec4(curveFlatness(0, 1, 3, 6) > tolerance, curveFlatness(6, 7, 8, 9) > tolerance,
                                curveFlatness(9, 5, 2, 0) > tolerance, false);
  test.any_ = any(test.bent) || interiorFlatness(rectangle) > tolerance;
  return test;
}

RecursionPart childOf(RecursionPart parent, vec4 corners, vec2 last) {
  return RecursionPart(corners, last.x, last.y, parent.patchNumber, parent.steps + 1u);
}

// Quarters, numbered from 0; of a triangle the last one is the inner one.
RecursionPart quarterOf(RecursionPart part, bool rectangle, uint number) {
  const vec2 a = part.corners.xy, b = part.corners.zw, c = vec2(part.lastU, part.lastV);
  if (rectangle) {
    const vec2 m = 0.5 * (a + b);
    const vec2 low = vec2((number & 1u) != 0u ? m.x : a.x, (number & 2u) != 0u ? m.y : a.y);
    return childOf(part, vec4(low, (number & 1u) != 0u ? b.x : m.x, (number & 2u) != 0u ? b.y : m.y), vec2(0.0));
  }
  const vec2 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  return number == 0u   ? childOf(part, vec4(a, ab), ca)
         : number == 1u ? childOf(part, vec4(ab, b), bc)
         : number == 2u ? childOf(part, vec4(ca, bc), c)
                        : childOf(part, vec4(bc, ca), ab);
}

// Halves of a rectangle by the sides that are not flat, or across the longer ones.
RecursionPart halfOf(RecursionPart part, PartTest test, uint number) {
  const vec2 a = part.corners.xy, b = part.corners.zw, m = 0.5 * (a + b);
  const bool alongU = test.bent.x || test.bent.z, alongV = test.bent.y || test.bent.w;
  bool splitU = alongU;
  if (!alongU && !alongV)
    splitU = distance(screen(0), screen(3)) + distance(screen(12), screen(15)) >=
             distance(screen(0), screen(12)) + distance(screen(3), screen(15));
  return number == 0u ? childOf(part, vec4(a, splitU ? vec2(m.x, b.y) : vec2(b.x, m.y)), vec2(0.0))
                      : childOf(part, vec4(splitU ? vec2(m.x, a.y) : vec2(a.x, m.y), b), vec2(0.0));
}
