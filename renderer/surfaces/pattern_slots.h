// SPDX-License-Identifier: BSD-3-Clause
// Tessellation patterns in closed form: how many vertices and indices a tuple of factors takes, which sample
// of the domain a vertex slot holds, and which vertex an index slot refers to. Any slot can be had alone, so
// that a patch may be written by one invocation or by one for each slot. For C++ and GLSL; patterns.h is the
// interface of the former.
//
// A core of equal triangles, and one strip for each side (rectangle: for each direction) whose factor differs
// from the core's: Schwarz 2009, section 7.3 (SC-47, 48, 50 to 52). Sides are numbered as in patch_set.h.
// Vertices: the core row by row, then the outer polylines of the strips, which start at the corner that they
// share. Indices: one triangle strip for each row of the core, then the triangles of the transitions; each
// ends with a restart.
#pragma once

#ifdef __cplusplus
#include <cmath>
#include <glm/glm.hpp>
#define LIMEN_SLOTS inline
namespace limen::surfaces {
using glm::ivec3;
using glm::ivec4;
using std::sqrt;
#else
#define LIMEN_SLOTS
#endif

const int kPatternRestart = -1;

// A strip of triangles between `inner` segments of the core and `outer` ones of a side.
struct PatternTransition {
  int side;          // -1: none
  int reversed;      // 1: runs from corner side + 1 to corner side
  int inner, outer;  // segments
  int corrected;     // 1: starts at a corner that another transition shares, and its shape is corrected there
};

struct PatternPlan {
  int rectangle;
  int mu, mv;  // rectangle: segments of the inner grid; triangle: both the largest factor
  ivec4 low;   // rectangle: first column and row of the core; triangle: least u, v, w of the core, in 1 / mu
  int cols, rows;  // of the core; triangle: both its factor
  int coreVertices, coreIndices;
  PatternTransition first, second;
  int vertices, triangles, indices;
};

LIMEN_SLOTS int patternLess(int a, int b) { return a < b ? a : b; }
LIMEN_SLOTS int patternMore(int a, int b) { return a > b ? a : b; }

LIMEN_SLOTS PatternTransition noPatternTransition() {
  PatternTransition none;
  none.side = -1;
  none.reversed = 0;
  none.inner = 0;
  none.outer = 0;
  none.corrected = 0;
  return none;
}

LIMEN_SLOTS PatternPlan finishedPattern(PatternPlan plan) {
  const int common_ = plan.first.side >= 0 && plan.second.side >= 0 ? 1 : 0;
  int strips = 0;
  plan.vertices = plan.coreVertices - common_;
  if (plan.first.side >= 0) {
    plan.vertices += plan.first.outer + 1;
    strips += plan.first.inner + plan.first.outer;
  }
  if (plan.second.side >= 0) {
    plan.vertices += plan.second.outer + 1;
    strips += plan.second.inner + plan.second.outer;
  }
  plan.triangles = (plan.rectangle == 1 ? 2 * plan.rows * plan.cols : plan.rows * plan.rows) + strips;
  plan.indices = plan.coreIndices + 4 * strips;
  return plan;
}

// Factors of the sides v = 0, u = 1, v = 1, u = 0, all >= 1. `cornerFix`: 1 or 0.
LIMEN_SLOTS PatternPlan rectanglePattern(ivec4 factors, int cornerFix) {
  PatternPlan plan;
  plan.rectangle = 1;
  plan.mu = patternLess(factors.x, factors.z);
  plan.mv = patternLess(factors.y, factors.w);
  const int tu = factors.x != factors.z ? 1 : 0, tv = factors.y != factors.w ? 1 : 0;
  plan.cols = plan.mu - tv;
  plan.rows = plan.mv - tu;
  plan.first = noPatternTransition();
  plan.second = noPatternTransition();
  const int sideU = factors.x > factors.z ? 0 : 2, sideV = factors.y > factors.w ? 1 : 3;
  plan.low = ivec4(tv == 1 && sideV == 3 ? 1 : 0, tu == 1 && sideU == 0 ? 1 : 0, 0, 0);
  // Both run away from the corner that they share. Side 2 itself runs towards -u, side 3 towards -v.
  if (tu == 1) {
    const int towardsMore = tv == 0 || sideV == 3 ? 1 : 0;
    plan.first.side = sideU;
    plan.first.reversed = (sideU == 0 ? 1 : 0) == towardsMore ? 0 : 1;
    plan.first.inner = plan.cols;
    plan.first.outer = patternMore(factors.x, factors.z);
    plan.first.corrected = tv * cornerFix;
  }
  if (tv == 1) {
    const int towardsMore = tu == 0 || sideU == 0 ? 1 : 0;
    plan.second.side = sideV;
    plan.second.reversed = (sideV == 1 ? 1 : 0) == towardsMore ? 0 : 1;
    plan.second.inner = plan.rows;
    plan.second.outer = patternMore(factors.y, factors.w);
    plan.second.corrected = tu * cornerFix;
  }
  plan.coreVertices = (plan.rows + 1) * (plan.cols + 1);
  plan.coreIndices = plan.cols > 0 ? plan.rows * (2 * plan.cols + 3) : 0;
  return finishedPattern(plan);
}

// Factors of the sides w = 0, u = 0, v = 0, all >= 1; the fourth is not used.
LIMEN_SLOTS PatternPlan trianglePattern(ivec4 factors, int cornerFix) {
  PatternPlan plan;
  plan.rectangle = 0;
  const int most = patternMore(factors.x, patternMore(factors.y, factors.z));
  plan.mu = most;
  plan.mv = most;
  const int t0 = factors.x < most ? 1 : 0, t1 = factors.y < most ? 1 : 0, t2 = factors.z < most ? 1 : 0;
  const int core = most - t0 - t1 - t2;
  plan.cols = core;
  plan.rows = core;
  plan.low = ivec4(t1, t2, t0, 0);
  plan.first = noPatternTransition();
  plan.second = noPatternTransition();
  const int both = t0 + t1 + t2 == 2 ? 1 : 0;
  if (t0 + t1 + t2 > 0) {
    // Of two sides that meet in a corner, the one before the corner runs backwards.
    const int side = both == 1 ? (t0 == 0 ? 1 : (t1 == 0 ? 2 : 0)) : (t0 == 1 ? 0 : (t1 == 1 ? 1 : 2));
    plan.first.side = side;
    plan.first.reversed = both;
    plan.first.inner = core;
    plan.first.outer = factors[side];
    plan.first.corrected = both * cornerFix;
    if (both == 1) {
      plan.second = plan.first;
      plan.second.side = side == 2 ? 0 : side + 1;
      plan.second.reversed = 0;
      plan.second.outer = factors[plan.second.side];
    }
  }
  plan.coreVertices = (core + 1) * (core + 2) / 2;
  plan.coreIndices = core * core + 3 * core;
  return finishedPattern(plan);
}

// Sample on a side with n segments, q of them from the side's first corner. As patternSample().
LIMEN_SLOTS ivec4 patternSideSample(int rectangle, int side, int q, int n) {
  if (rectangle == 1) {
    if (side == 0) return ivec4(q, n, 0, 1);
    if (side == 1) return ivec4(1, 1, q, n);
    if (side == 2) return ivec4(n - q, n, 1, 1);
    return ivec4(0, 1, n - q, n);
  }
  if (side == 0) return ivec4(n - q, q, 0, n);
  if (side == 1) return ivec4(0, n - q, q, n);
  return ivec4(q, 0, n - q, n);
}

// Row of a triangular arrangement of 1, 2, 3... that holds `slot`.
LIMEN_SLOTS int triangularRow(int slot) {
  int row = int(sqrt(2.0F * float(slot) + 0.25F) - 0.5F);
  for (int i = 0; i < 2 && row * (row + 1) / 2 > slot; ++i) --row;
  for (int i = 0; i < 2 && (row + 1) * (row + 2) / 2 <= slot; ++i) ++row;
  return row;
}

// Place of a vertex in the domain, as whole numbers: both ends of a side give the same ones.
// Rectangle: (i, n, j, m), u = i / n, v = j / m. Triangle: (i, j, k, n), u = i / n, v = j / n, w = k / n.
LIMEN_SLOTS ivec4 patternSample(PatternPlan plan, int slot) {
  if (slot < plan.coreVertices) {
    if (plan.rectangle == 1) {
      const int row = slot / (plan.cols + 1);
      return ivec4(plan.low.x + slot - row * (plan.cols + 1), plan.mu, plan.low.y + row, plan.mv);
    }
    const int row = triangularRow(slot), k = slot - row * (row + 1) / 2;
    return ivec4(plan.low.x + plan.cols - row, plan.low.y + row - k, plan.low.z + k, plan.mu);
  }
  int k = slot - plan.coreVertices;
  PatternTransition strip = plan.first;
  if (strip.side < 0 || k > strip.outer) {
    // The second one's first vertex is the first one's.
    if (strip.side >= 0) k -= strip.outer;
    strip = plan.second;
  }
  return patternSideSample(plan.rectangle, strip.side, strip.reversed == 1 ? strip.outer - k : k,
                           strip.outer);
}

LIMEN_SLOTS int patternOuterSlot(PatternPlan plan, int second, int k) {
  if (second == 0 || plan.first.side < 0) return plan.coreVertices + k;
  return k == 0 ? plan.coreVertices : plan.coreVertices + plan.first.outer + k;
}

// Vertex slot of the q-th sample of a side with n segments, 0 < q < n.
LIMEN_SLOTS int patternSideSlot(PatternPlan plan, int side, int q, int n) {
  if (plan.first.side == side) return patternOuterSlot(plan, 0, plan.first.reversed == 1 ? n - q : q);
  if (plan.second.side == side) return patternOuterSlot(plan, 1, plan.second.reversed == 1 ? n - q : q);
  const ivec4 s = patternSideSample(plan.rectangle, side, q, n);
  if (plan.rectangle == 1) {
    const int i = side == 1 ? plan.mu : s.x, j = side == 2 ? plan.mv : s.z;
    return (j - plan.low.y) * (plan.cols + 1) + i - plan.low.x;
  }
  const int row = plan.low.x + plan.cols - s.x;
  return row * (row + 1) / 2 + s.z - plan.low.z;
}

LIMEN_SLOTS int patternInnerSlot(PatternPlan plan, PatternTransition strip, int k) {
  const int along = strip.reversed == 1 ? strip.inner - k : k;  // from the side's first corner
  if (plan.rectangle == 1) {
    const int width = plan.cols + 1;
    if (strip.side == 0) return along;
    if (strip.side == 1) return along * width + plan.cols;
    if (strip.side == 2) return plan.rows * width + plan.cols - along;
    return (plan.rows - along) * width;
  }
  const int core = plan.cols, last = core * (core + 1) / 2;
  if (strip.side == 0) return along * (along + 1) / 2;
  if (strip.side == 1) return last + along;
  const int row = core - along;
  return row * (row + 1) / 2 + row;
}

// Segments of the inner polyline among the first `steps` of a strip between `inner` and `outer` ones: the
// next triangle stands on the polyline whose next segment's middle comes first (Moreton's state machine;
// ties: the inner one). Inner segment a comes after a + ceil((outer (2 a + 1) - inner) / (2 inner)) others.
LIMEN_SLOTS int patternInnerSteps(int steps, int inner, int outer) {
  if (inner == 0) return 0;
  int a = patternLess(inner, steps * inner / (inner + outer));
  for (int i = 0; i < 4; ++i)
    if (a < inner && a + (outer * (2 * a + 1) + inner - 1) / (2 * inner) < steps) ++a;
  for (int i = 0; i < 4; ++i)
    if (a > 0 && a - 1 + (outer * (2 * a - 1) + inner - 1) / (2 * inner) >= steps) --a;
  return a;
}

// The same with the corner's shape corrected: the inner polyline starts with a segment that exists only for
// the decision and is then taken out (Schwarz 2009, section 7.3).
LIMEN_SLOTS int patternFixedSteps(int steps, int inner, int outer) {
  const int virtualAt = (outer + inner) / (2 * (inner + 1));
  return steps <= virtualAt ? 0 : patternInnerSteps(steps + 1, inner + 1, outer) - 1;
}

LIMEN_SLOTS int patternStepsInside(PatternTransition strip, int steps) {
  return strip.corrected == 1 ? patternFixedSteps(steps, strip.inner, strip.outer)
                              : patternInnerSteps(steps, strip.inner, strip.outer);
}

// Vertex slot that an index slot refers to, or kPatternRestart.
LIMEN_SLOTS int patternIndex(PatternPlan plan, int slot) {
  if (slot < plan.coreIndices) {
    if (plan.rectangle == 1) {
      const int length = 2 * plan.cols + 3, row = slot / length, at = slot - row * length;
      if (at == length - 1) return kPatternRestart;
      return (row + 1 - at % 2) * (plan.cols + 1) + at / 2;
    }
    // Rows of 2, 3, 4... pairs of indices, the last of each a restart.
    const int row = triangularRow(slot / 2 + 1) - 1, at = slot - row * (row + 3);
    if (at == 2 * row + 3) return kPatternRestart;
    return at % 2 == 0 ? (row + 1) * (row + 2) / 2 + row + 1 - at / 2 : row * (row + 1) / 2 + row - at / 2;
  }
  int at = slot - plan.coreIndices;
  int second = 0;
  PatternTransition strip = plan.first;
  const int ofFirst = strip.side >= 0 ? 4 * (strip.inner + strip.outer) : 0;
  if (at >= ofFirst) {
    at -= ofFirst;
    second = 1;
    strip = plan.second;
  }
  const int step = at / 4, corner = at % 4;
  if (corner == 3) return kPatternRestart;
  const int a = patternStepsInside(strip, step), b = step - a;
  const bool inside = patternStepsInside(strip, step + 1) > a;
  // The interior lies to the left of a side, hence to the right of one that is run through backwards.
  const int turned = strip.reversed == 1 && corner < 2 ? 1 - corner : corner;
  if (inside) {
    if (turned == 1) return patternOuterSlot(plan, second, b);
    return patternInnerSlot(plan, strip, turned == 0 ? a : a + 1);
  }
  if (turned == 2) return patternInnerSlot(plan, strip, a);
  return patternOuterSlot(plan, second, turned == 0 ? b : b + 1);
}

// Vertex slot of a corner (0 to 2) of a triangle, counter-clockwise: the same triangles one by one.
LIMEN_SLOTS int patternCorner(PatternPlan plan, int triangle, int corner) {
  const int ofCore = plan.rectangle == 1 ? 2 * plan.rows * plan.cols : plan.rows * plan.rows;
  if (triangle >= ofCore) return patternIndex(plan, plan.coreIndices + 4 * (triangle - ofCore) + corner);
  int row, at, first;
  if (plan.rectangle == 1) {
    row = triangle / (2 * plan.cols);
    at = triangle - row * 2 * plan.cols;
    first = row * (2 * plan.cols + 3);
  } else {
    row = int(sqrt(float(triangle) + 0.5F));
    if (row * row > triangle) --row;
    if ((row + 1) * (row + 1) <= triangle) ++row;
    at = triangle - row * row;
    first = row * (row + 3);
  }
  // Every other triangle of a strip is turned.
  return patternIndex(plan, first + at + (at % 2 == 1 && corner < 2 ? 1 - corner : corner));
}

// All corners of one, without the strips' arithmetic where there are most of them.
LIMEN_SLOTS ivec3 patternTriangle(PatternPlan plan, int triangle) {
  if (plan.rectangle == 1 && triangle < 2 * plan.rows * plan.cols) {
    // At least 0.5 / 128 away from a whole number: exact in single precision, and faster than a division of
    // whole ones.
    const int row = int((float(triangle) + 0.5F) / float(2 * plan.cols)), at = triangle - row * 2 * plan.cols,
              width = plan.cols + 1;
    const int below = row * width + at / 2, above = below + width;
    if (at % 2 == 0) return ivec3(above, below, above + 1);
    return ivec3(above + 1, below, below + 1);
  }
  return ivec3(patternCorner(plan, triangle, 0), patternCorner(plan, triangle, 1),
               patternCorner(plan, triangle, 2));
}

#ifdef __cplusplus
}  // namespace limen::surfaces
#endif
