// SPDX-License-Identifier: BSD-3-Clause
// How many segments a bound on second derivatives asks for: Schwarz 2009, section 7.4 (SC-55). For C++
// (double) and GLSL (float).
#pragma once

#ifdef __cplusplus
#include <cmath>
#include <glm/glm.hpp>
#define LIMEN_RULES inline
#define LIMEN_REAL double
namespace limen::surfaces {
using glm::dvec2;
using std::sqrt;
#define LIMEN_REAL2 dvec2
#else
#define LIMEN_RULES
#define LIMEN_REAL float
#define LIMEN_REAL2 vec2
#endif

const int kRuleFilip = 0;
const int kRuleAbiEzziShirman = 1;
const int kRuleGuthe = 2;

// Segments along v if there is one along u.
LIMEN_RULES LIMEN_REAL otherSegments(LIMEN_REAL uu, LIMEN_REAL uv, LIMEN_REAL vv, LIMEN_REAL eps8) {
  const LIMEN_REAL left = eps8 - uu;
  return (sqrt(uv * uv + left * vv) + uv) / left;
}

// Numbers of segments (mu, mv) >= 1, not yet rounded up, such that with du = 1 / mu, dv = 1 / mv
//   uu du^2 + 2 uv du dv + vv dv^2 <= 8 eps,
// which bounds the distance, at equal parameters, between the surface and any triangle whose corners lie on
// it and whose parameters span at most du x dv. uu, uv, vv >= 0: bounds on the second derivatives. eps8 = 8
// eps > 0.
//
// Filip's and Abi-Ezzi and Shirman's ratios of du to dv ask for du > 1 where one direction is nearly
// straight, and for far too many segments in the other; there du is 1 and the condition solved again for dv
// (not in the thesis).
LIMEN_RULES LIMEN_REAL2 segmentsFor(LIMEN_REAL uu, LIMEN_REAL uv, LIMEN_REAL vv, LIMEN_REAL eps8, int rule) {
  const LIMEN_REAL one = LIMEN_REAL(1);
  LIMEN_REAL2 m = LIMEN_REAL2(one, one);
  if (uu + LIMEN_REAL(2) * uv + vv <= eps8) return m;
  if (rule == kRuleGuthe) {
    m.x = sqrt(LIMEN_REAL(2) * (uu + uv) / eps8);
    m.y = sqrt(LIMEN_REAL(2) * (vv + uv) / eps8);
  } else {
    // Of the condition as a quadratic in du, with dv = ratio du, divided by the largest coefficient, so that
    // no product leaves the numbers' range.
    const LIMEN_REAL most = uu > vv ? (uu > uv ? uu : uv) : (vv > uv ? vv : uv);
    const LIMEN_REAL a = uu / most, b = uv / most, c = vv / most, e = eps8 / most;
    if (a > LIMEN_REAL(0) && c > LIMEN_REAL(0)) {
      const LIMEN_REAL ratio = rule == kRuleFilip ? a / c : sqrt(a / c);
      m.x = sqrt((a + LIMEN_REAL(2) * b * ratio + c * ratio * ratio) / e);
      m.y = m.x / ratio;
    } else if (a > LIMEN_REAL(0)) {
      m.y = LIMEN_REAL(0);
    } else if (c > LIMEN_REAL(0)) {
      m.x = LIMEN_REAL(0);
    } else {
      m.x = sqrt(LIMEN_REAL(2) * b / e);
      m.y = m.x;
    }
  }
  // Written so that an overflow counts as too few as well.
  if (!(m.x >= one)) {
    m.x = one;
    if (rule != kRuleGuthe) m.y = uu < eps8 ? otherSegments(uu, uv, vv, eps8) : m.y;
  }
  if (!(m.y >= one)) {
    m.y = one;
    if (rule != kRuleGuthe) m.x = vv < eps8 ? otherSegments(vv, uv, uu, eps8) : m.x;
  }
  if (!(m.x >= one)) m.x = one;
  return m;
}

// The same with at most `most` along each direction: where the rule asks for more along one of them, the
// condition is solved again for the other one, which it may hold with some more. Above `most` where no number
// up to it does.
LIMEN_RULES LIMEN_REAL2 segmentsWithin(LIMEN_REAL uu, LIMEN_REAL uv, LIMEN_REAL vv, LIMEN_REAL eps8, int rule,
                                       LIMEN_REAL most) {
  LIMEN_REAL2 m = segmentsFor(uu, uv, vv, eps8, rule);
  if (m.y > most && m.x < most) {
    const LIMEN_REAL left = eps8 - vv / (most * most), half_ = uv / most;
    if (left > LIMEN_REAL(0)) {
      const LIMEN_REAL other = (half_ + sqrt(half_ * half_ + left * uu)) / left;
      m = LIMEN_REAL2(other > m.x ? other : m.x, most);
    } else {
      m.x = most;
    }
  } else if (m.x > most && m.y < most) {
    const LIMEN_REAL left = eps8 - uu / (most * most), half_ = uv / most;
    if (left > LIMEN_REAL(0)) {
      const LIMEN_REAL other = (half_ + sqrt(half_ * half_ + left * vv)) / left;
      m = LIMEN_REAL2(most, other > m.y ? other : m.y);
    } else {
      m.y = most;
    }
  }
  return m;
}

#ifdef __cplusplus
}  // namespace limen::surfaces
#endif
