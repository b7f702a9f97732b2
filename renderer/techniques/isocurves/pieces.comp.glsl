// SPDX-License-Identifier: BSD-3-Clause
// Bicubic patches cut into rectangles of the domain, a group for each sixteenth of a patch. ADAPTIVE_CURVES: curves of constant
// v are inserted between two until these are close, over parts of u where need be (Elber and Cohen 1996). Otherwise rectangles
// are halved until even steps suit them, and filled with evenly spaced curves (Rappoport 1991).
#include "renderer/techniques/isocurves/isocurve_points.glsl"

uniform float flatness;  // px
uniform float evenness;  // largest part of a control polygon over the mean

const int kStackSize = 40;  // two halvings of 4,096 and what waits beside them
shared uvec4 stack[kStackSize];  // low and high u, low and high v, in 1 / kMostIsocurves
shared int stackSize;

#define FOUR_ZEROS vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0)
vec4 whole_[16] = vec4[16](FOUR_ZEROS, FOUR_ZEROS, FOUR_ZEROS, FOUR_ZEROS);  // of the patch
vec4 part[16] = vec4[16](FOUR_ZEROS, FOUR_ZEROS, FOUR_ZEROS, FOUR_ZEROS);  // of the rectangle

vec4 blossom(vec4 a, vec4 b, vec4 c, vec4 d, float r, float s, float t) {
  precise const vec4 ab = mix(a, b, r), bc = mix(b, c, r), cd = mix(c, d, r);
  precise const vec4 out_ = mix(mix(ab, bc, s), mix(bc, cd, s), t);
  return out_;
}

void restrict_(vec2 u, vec2 v) {
  vec4 rows[16];
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      rows[i + 4 * j] = blossom(whole_[4 * j], whole_[4 * j + 1], whole_[4 * j + 2], whole_[4 * j + 3], i > 0 ? u.y : u.x,
                                i > 1 ? u.y : u.x, i > 2 ? u.y : u.x);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      part[i + 4 * j] =
          blossom(rows[i], rows[i + 4], rows[i + 8], rows[i + 12], j > 0 ? v.y : v.x, j > 1 ? v.y : v.x, j > 2 ? v.y : v.x);
}

vec2 pxOf(int i) { return part[i].xy / part[i].w; }

// All of the rectangle's points lie beyond the same side of the picture, or behind the near plane.
bool isOutside() {
  bool near = true, left = true, right = true, above = true, below = true;
  for (int i = 0; i < 16; ++i) {
    const vec4 p = part[i];
    near = near && p.w < nearest;
    left = left && p.x < 0.0;
    right = right && p.x > float(sizePx.x) * p.w;
    above = above && p.y < 0.0;
    below = below && p.y > float(sizePx.y) * p.w;
  }
  return near || left || right || above || below;
}
bool isInFront() {
  for (int i = 0; i < 16; ++i)
    if (part[i].w < nearest) return false;
  return true;
}

// Legs of the control polygons along u (stride 1) or v (stride 4): the longest, and the longest polygon.
struct Legs {
  float most, polygon, shortest, uneven;
};
Legs legsAlong(int stride, int across) {
  Legs out_ = Legs(0.0, 0.0, 1e30, 1.0);
  for (int row = 0; row < 4; ++row) {
    float sum = 0.0, most = 0.0;
    for (int k = 0; k < 3; ++k) {
      const float leg = distance(pxOf(row * across + k * stride), pxOf(row * across + (k + 1) * stride));
      sum += leg;
      most = max(most, leg);
    }
    out_.most = max(out_.most, most);
    out_.polygon = max(out_.polygon, sum);
    out_.shortest = min(out_.shortest, sum);
    if (sum > spacing) out_.uneven = max(out_.uneven, 3.0 * most / sum);
  }
  return out_;
}

// How far polygons leave their chords.
float bend(int stride, int across) {
  float most = 0.0;
  for (int row = 0; row < 4; ++row) {
    const vec2 a = pxOf(row * across), d = pxOf(row * across + 3 * stride);
    most = max(most, max(distance(pxOf(row * across + stride), mix(a, d, 1.0 / 3.0)),
                         distance(pxOf(row * across + 2 * stride), mix(a, d, 2.0 / 3.0))));
  }
  return most;
}

#ifdef COUNTING
// Loop rounds that each of the group's invocations has taken, rounded up: those of a piece's tests, and one for each point.
uint rounds = 0u;
const uint kRoundsOfVisit = 128u;

// How far a point by differences lies from the patch's, which is evaluated in double precision.
void measureDrift(vec4 found, double u, double v, uint steps) {
  atomicMax(mostSteps, steps);
  const double r = 1.0 - u, s = 1.0 - v;
  const double bu[4] = double[4](r * r * r, 3.0 * r * r * u, 3.0 * r * u * u, u * u * u);
  const double bv[4] = double[4](s * s * s, 3.0 * s * s * v, 3.0 * s * v * v, v * v * v);
  dvec4 exact = dvec4(0.0);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) exact += bu[i] * bv[j] * dvec4(whole_[i + 4 * j]);
  if (!(exact.w >= double(nearest) && found.w > 0.0)) return;
  atomicMax(mostDrift, floatBitsToUint(length(vec2(dvec2(found.xy) / double(found.w) - exact.xy / exact.w))));
}
#endif

// Steps first to last of a curve of constant v, of which the rectangle's share of u has `steps`.
void walkCurve(vec4 c[4], vec2 u, float v, uint first, uint last, uint steps) {
  Walk w;
  uint since = restart;
  for (uint i = first; i <= last; ++i) {
    if (since >= restart) {
      w = walkFrom(c, float(i) / float(steps), 1.0 / float(steps));
      since = 0u;
    }
    const float at = mix(u.x, u.y, float(i) / float(steps));
    plot(w.p, at, v);
#ifdef COUNTING
    measureDrift(w.p, mix(double(u.x), double(u.y), double(i) / double(steps)), double(v), uint(float(steps) / (u.y - u.x)));
#endif
    step_(w);
    ++since;
  }
}

void curveAt(float t, out vec4 c[4]) {
  const float s = 1.0 - t;
  for (int i = 0; i < 4; ++i) {
    precise const vec4 at = s * s * s * part[i] + 3.0 * s * s * t * part[i + 4] + 3.0 * s * t * t * part[i + 8] + t * t * t * part[i + 12];
    c[i] = at;
  }
}

uint stepsFor(float most) { return uint(clamp(ceil(3.0 * most / spacing), 1.0, float(kMostIsocurves))); }

// Groups that share a part of a patch: each draws every so many of its curves.
uint sharers() { return gl_NumWorkGroups.z; }
uint curvesSoFar = 0u;

// All invocations share a curve's points.
void drawCurve(float t, vec2 u, vec2 v) {
  if (curvesSoFar++ % sharers() != gl_WorkGroupID.z) return;
  vec4 c[4];
  curveAt(t, c);
  float most = 0.0;
  for (int i = 0; i < 3; ++i)
    most = c[i].w < nearest || c[i + 1].w < nearest ? 1e30 : max(most, distance(c[i].xy / c[i].w, c[i + 1].xy / c[i + 1].w));
  const uint steps = stepsFor(most), lanes = uint(kIsocurveGroup), share = steps / lanes + 1u;
  const uint first = gl_LocalInvocationIndex * share;
#ifdef COUNTING
  rounds += share + 4u;
#endif
  if (first <= steps) walkCurve(c, u, mix(v.x, v.y, t), first, min(first + share - 1u, steps), steps);
}

// Each invocation has curves of its own.
void fill(uint curves, uint steps, vec2 u, vec2 v) {
  const uint lanes = uint(kIsocurveGroup) * sharers();
#ifdef COUNTING
  rounds += (curves / lanes + 1u) * (steps + 2u);
#endif
  for (uint k = gl_LocalInvocationIndex + uint(kIsocurveGroup) * gl_WorkGroupID.z; k <= curves; k += lanes) {
    const float t = float(k) / float(curves);
    vec4 c[4];
    curveAt(t, c);
    walkCurve(c, u, mix(v.x, v.y, t), 0u, steps, steps);
  }
}

// 0: done; 1, 2: halve along u, v.
int visit(uvec4 piece, vec2 u, vec2 v) {
  const bool divideU = piece.y - piece.x > 1u, divideV = piece.w - piece.z > 1u;
  if (isOutside()) return 0;
  if (!isInFront()) {
    if (piece.w - piece.z > piece.y - piece.x) return 2;
    if (divideU) return 1;
    return 0;
  }
  const Legs alongU = legsAlong(1, 4), alongV = legsAlong(4, 1);
#ifdef ADAPTIVE_CURVES
  if (alongV.polygon <= spacing || !divideV) return 0;
  // Close in places: the next curve is a part of one.
  if (alongV.shortest <= 0.5 * alongV.polygon && divideU && alongU.polygon > 8.0 * spacing) return 1;
  drawCurve(0.5, u, v);
  return 2;
#else
  const float bendU = bend(1, 4), bendV = bend(4, 1);
  const uint stepsU = stepsFor(alongU.most), stepsV = stepsFor(alongV.most);
  const bool failsU = (bendU > flatness || alongU.uneven > evenness || stepsU > restart) && stepsU > 1u && divideU,
             failsV = (bendV > flatness || alongV.uneven > evenness) && stepsV > 1u && divideV;
  if (failsU && (!failsV || alongU.polygon >= alongV.polygon)) return 1;
  if (failsV) return 2;
  fill(stepsV, stepsU, u, v);
#ifdef COUNTING
  if (gl_LocalInvocationIndex == 0u && gl_WorkGroupID.z == 0u) atomicAdd(filledPieces, 1u);
#endif
  return 0;
#endif
}

void main() {
  patch_ = patches[gl_WorkGroupID.y];
  for (int i = 0; i < 16; ++i) whole_[i] = clipPoint(i);
  const uint quarter = uint(kMostIsocurves) / 4u, x = gl_WorkGroupID.x % 4u, y = gl_WorkGroupID.x / 4u;
  const uvec4 first = uvec4(x, x + 1u, y, y + 1u) * quarter;
  if (gl_LocalInvocationIndex == 0u) {
    stack[0] = first;
    stackSize = 1;
  }
  barrier();
#ifdef ADAPTIVE_CURVES
  restrict_(vec2(first.xy) / float(kMostIsocurves), vec2(first.zw) / float(kMostIsocurves));
  if (!isOutside()) {
    drawCurve(0.0, vec2(first.xy) / float(kMostIsocurves), vec2(first.zw) / float(kMostIsocurves));
    drawCurve(1.0, vec2(first.xy) / float(kMostIsocurves), vec2(first.zw) / float(kMostIsocurves));
  }
#endif
  while (true) {
    const int size = stackSize;
    if (size == 0) break;
    const uvec4 piece = stack[size - 1];
    const vec2 u = vec2(piece.xy) / float(kMostIsocurves), v = vec2(piece.zw) / float(kMostIsocurves);
    restrict_(u, v);
    const int halved = visit(piece, u, v);
#ifdef COUNTING
    rounds += kRoundsOfVisit;
#endif
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
      stackSize = size - 1;
      if (halved != 0 && size < kStackSize) {
        const uint middle = halved == 1 ? (piece.x + piece.y) / 2u : (piece.z + piece.w) / 2u;
        stack[size - 1] = halved == 1 ? uvec4(middle, piece.yzw) : uvec4(piece.xy, middle, piece.w);
        stack[size] = halved == 1 ? uvec4(piece.x, middle, piece.zw) : uvec4(piece.xyz, middle);
        stackSize = size + 1;
      }
    }
    barrier();
  }
#ifdef COUNTING
  atomicMax(mostRounds, rounds);
#endif
}
