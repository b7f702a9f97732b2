// SPDX-License-Identifier: BSD-3-Clause
// How a side is divided whose factor is a real number (Schwarz 2009, section 7.3.3; SC-53). For C++ (double)
// and GLSL (float).
#pragma once

#include "renderer/surfaces/pattern_slots.h"

#ifdef __cplusplus
#define LIMEN_SPACING inline
#define LIMEN_SPACING_REAL double
#define LIMEN_SPACING_EXACT double
namespace limen::surfaces {
#else
#define LIMEN_SPACING
#define LIMEN_SPACING_REAL float
#define LIMEN_SPACING_EXACT precise float  // the same bits wherever it is compiled
#endif

const int kSpacingInteger = 0;         // rounded up, equal segments
const int kSpacingDyadic = 1;          // rounded up to a power of two, equal segments
const int kSpacingFractionalEven = 2;  // an even number, two of them growing (Direct3D 11)
const int kSpacingFractionalOdd = 3;   // an odd number, two of them growing
const int kSpacingMoreton = 4;         // segments of 1 / factor from both ends, two short ones in the middle
const int kSpacingGeomorph = 5;        // dyadic, its new vertices moving in from the coarser level

// Factors are stored in this part of a segment, rounded up, so that both patches of a side see the same
// number.
const int kSegmentUnit = 512;

// Segments of a side whose factor is `units` / kSegmentUnit >= 1. Never falls where the factor rises.
LIMEN_SPACING int spacedSegments(int spacing, int units) {
  const int whole = (units + kSegmentUnit - 1) / kSegmentUnit;
  if (spacing == kSpacingInteger) return whole;
  if (spacing == kSpacingFractionalEven || spacing == kSpacingMoreton)
    return 2 * ((units + 2 * kSegmentUnit - 1) / (2 * kSegmentUnit));
  if (spacing == kSpacingFractionalOdd) return 2 * ((units + kSegmentUnit - 1) / (2 * kSegmentUnit)) + 1;
  int power = 1;
  for (int i = 0; i < 8 && power < whole; ++i) power *= 2;
  return power;
}

// Where vertex i of a side with n = spacedSegments() segments lies, from 0 to 1. What is left to 1 is that of
// n - i.
LIMEN_SPACING LIMEN_SPACING_REAL spacedPlace(int spacing, int units, int i, int n) {
  // Division may be off by some units in the last place on a GPU.
  if (i == n) return LIMEN_SPACING_REAL(1);
  if (i == 0) return LIMEN_SPACING_REAL(0);
  const bool fractional =
      spacing == kSpacingFractionalEven || spacing == kSpacingFractionalOdd || spacing == kSpacingMoreton;
  if (!fractional || n <= 2) return LIMEN_SPACING_REAL(i) / LIMEN_SPACING_REAL(n);
  if (2 * i == n) return LIMEN_SPACING_REAL(0.5);
  const int at = 2 * i < n ? i : n - i;  // in the lower half
  LIMEN_SPACING_EXACT factor = LIMEN_SPACING_REAL(units) / LIMEN_SPACING_REAL(kSegmentUnit);
  LIMEN_SPACING_EXACT place;
  if (spacing == kSpacingMoreton) {
    place = LIMEN_SPACING_REAL(at) / factor;
  } else {
    // Between the divisions into n - 2 and n equal parts, in the middle of which two are new.
    LIMEN_SPACING_EXACT share = (factor - LIMEN_SPACING_REAL(n - 2)) / LIMEN_SPACING_REAL(2);
    LIMEN_SPACING_EXACT added = share / LIMEN_SPACING_REAL(n);
    LIMEN_SPACING_EXACT old = (LIMEN_SPACING_REAL(1) - share) / LIMEN_SPACING_REAL(n - 2) + added;
    const int olds = patternLess(at, (n - 1) / 2 - (n % 2 == 1 ? 1 : 0));
    place = LIMEN_SPACING_REAL(olds) * old + LIMEN_SPACING_REAL(at - olds) * added;
  }
  LIMEN_SPACING_EXACT mirrored = LIMEN_SPACING_REAL(1) - place;
  return 2 * i < n ? place : mirrored;
}

// How far vertices that the coarser level lacks have moved to their own place: 0 where half as many segments
// do, 1 at the full number. A surface between the levels deviates by at most the mean of their deviations so
// weighted, which fall with the square of the number: this weight keeps them within what the factor promises
// (not in the thesis).
LIMEN_SPACING LIMEN_SPACING_REAL morphShare(int units, int n) {
  const LIMEN_SPACING_REAL one = LIMEN_SPACING_REAL(1);
  if (n <= 1) return one;
  const LIMEN_SPACING_REAL coarse =
      LIMEN_SPACING_REAL(n / 2) * LIMEN_SPACING_REAL(kSegmentUnit) / LIMEN_SPACING_REAL(units);
  const LIMEN_SPACING_REAL share = (one - coarse * coarse) * LIMEN_SPACING_REAL(4) / LIMEN_SPACING_REAL(3);
  return share < one ? (share > LIMEN_SPACING_REAL(0) ? share : LIMEN_SPACING_REAL(0)) : one;
}

// Side of the domain that a sample (patternSample()) lies on, -1 inside.
LIMEN_SPACING int sideOfSample(int rectangle, ivec4 s) {
  if (rectangle == 1) {
    if (s.z == 0) return 0;
    if (s.x == s.y) return 1;
    if (s.z == s.w) return 2;
    return s.x == 0 ? 3 : -1;
  }
  if (s.z == 0) return 0;
  if (s.x == 0) return 1;
  return s.y == 0 ? 2 : -1;
}

// A uniform pattern's sample, on a side moved to the nearest of that side's own (Schwarz 2009, section 7.5.4;
// SC-65, SC-66): the nearest end on either half, so that it does not matter which way the side runs.
// `segments`: of the sides, none more than the pattern's.
LIMEN_SPACING ivec4 adaptedSample(int rectangle, ivec4 s, ivec4 segments) {
  const int side = sideOfSample(rectangle, s);
  if (side < 0) return s;
  int q, n = s.w;
  if (rectangle == 1) {
    n = side % 2 == 0 ? s.y : s.w;
    q = side == 0 ? s.x : (side == 1 ? s.z : (side == 2 ? n - s.x : n - s.z));
  } else {
    q = side == 0 ? s.y : (side == 1 ? s.z : s.x);
  }
  const int m = segments[side];
  const int nearest = 2 * q < n ? (2 * m * q + n - 1) / (2 * n) : (2 * m * q + n) / (2 * n);
  return patternSideSample(rectangle, side, nearest, m);
}

// Of the four sides' factors, those that a rectangle's sample is placed by along u and v: the side's own on a
// side, the smaller of the two inside.
LIMEN_SPACING int unitsAlong(ivec4 units, int side, int direction) {
  const int first = direction == 0 ? 0 : 1;
  if (side == first || side == first + 2) return units[side];
  return patternLess(units[first], units[first + 2]);
}

#ifdef __cplusplus
}  // namespace limen::surfaces
#endif
