// SPDX-License-Identifier: BSD-3-Clause
// Convex hull of a backprojected quad, by the seven places that its fourth corner can have beside the triangle of the
// others. Schwarz 2009, section 4.4.4. Corners are rounded to a fixed grid first, from where on everything is exact: hulls
// of neighbours meet without gap or overlap, and a microtri lies within the hull of its quad.
//
// Lengths are in steps of 1 / (4096 side) of the light, from its lower corner; `side` is the number of samples along it.
const int kSteps = 4096;  // between two samples
// Corners farther off are moved towards the light's centre. An edge from the light to there turns by 1 / 2000 at most; one
// of which both ends lie there may be displaced, which takes two neighbours within 1 / 2000 of the receiver's depth.
const float kFarthest = 2048.0;  // light's extents; 2^28 steps where 32 samples lie along it

ivec2 toSteps(vec2 place, int side) {
  // In an order that turns a NaN into a bound.
  const vec2 bounded = min(max(place, vec2(-1e30)), vec2(1e30)), fromCentre = bounded - 0.5;
  const float farthest = max(abs(fromCentre.x), abs(fromCentre.y));
  const vec2 pulled = farthest > kFarthest ? fromCentre * (kFarthest / farthest) + 0.5 : bounded;
  return ivec2(roundEven(pulled * float(side * kSteps)));
}

// Sign of a b - c d: the products have up to 60 bits.
int compareProducts(int a, int b, int c, int d) {
  int highLeft, lowLeft, highRight, lowRight;
  imulExtended(a, b, highLeft, lowLeft);
  imulExtended(c, d, highRight, lowRight);
  if (highLeft != highRight) return highLeft > highRight ? 1 : -1;
  return lowLeft == lowRight ? 0 : uint(lowLeft) > uint(lowRight) ? 1 : -1;
}

// 1 if a, b, c turn to the left, 0 if they lie on a line.
int turn(ivec2 a, ivec2 b, ivec2 c) { return compareProducts(b.x - a.x, c.y - a.y, b.y - a.y, c.x - a.x); }

// Corners counter-clockwise, those of a triangle with the last one twice. False if the hull has no area.
bool convexHull(ivec2 a, ivec2 b, ivec2 c, ivec2 d, out ivec2 hull[4]) {
  int orientation = turn(a, b, c);
  if (orientation == 0) {
    // Three on a line: d and two different ones of them make a triangle, if any.
    if (a == b) {
      b = c;
      c = a;
    }
    const ivec2 other = c;
    c = d;
    d = other;
    orientation = turn(a, b, c);
    if (orientation == 0) return false;
  }
  if (orientation < 0) {
    const ivec2 other = b;
    b = c;
    c = other;
  }
  // Negative barycentric coordinates of d.
  const bool beyondA = turn(b, c, d) < 0, beyondB = turn(c, a, d) < 0, beyondC = turn(a, b, d) < 0;
  if (beyondA && beyondB) hull = ivec2[4](a, b, d, d);
  else if (beyondA && beyondC) hull = ivec2[4](a, d, c, c);
  else if (beyondB && beyondC) hull = ivec2[4](d, b, c, c);
  else if (beyondA) hull = ivec2[4](a, b, d, c);
  else if (beyondB) hull = ivec2[4](a, b, c, d);
  else if (beyondC) hull = ivec2[4](a, d, b, c);
  else hull = ivec2[4](a, b, c, c);
  return true;
}
