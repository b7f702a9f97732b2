// SPDX-License-Identifier: BSD-3-Clause
// Values of a cubic at equal steps by forward differences (Schwarz 2009, section 7.6.2; SC-72): three additions a step.
// Errors of the additions grow with their number, so that a run is started anew now and then. DIFFERENCE: float to vec4.

struct CubicRun {
  DIFFERENCE value, first, second, third;
};
struct QuadraticRun {
  DIFFERENCE value, first, second;
};

// Bezier control points in powers of t.
struct CubicPowers {
  DIFFERENCE c0, c1, c2, c3;
};
CubicPowers powersOf(DIFFERENCE a, DIFFERENCE b, DIFFERENCE c, DIFFERENCE d) {
  CubicPowers p;
  p.c0 = a;
  p.c1 = 3.0 * (b - a);
  p.c2 = 3.0 * (c - 2.0 * b + a);
  p.c3 = d - a + 3.0 * (b - c);
  return p;
}

// From t on, in steps of `by`.
CubicRun cubicRun(CubicPowers p, float t, float by) {
  const DIFFERENCE slope = p.c1 + t * (2.0 * p.c2 + 3.0 * t * p.c3), bend = p.c2 + 3.0 * t * p.c3;
  CubicRun run;
  run.value = p.c0 + t * (p.c1 + t * (p.c2 + t * p.c3));
  run.first = by * (slope + by * (bend + by * p.c3));
  run.second = by * by * (2.0 * bend + 6.0 * by * p.c3);
  run.third = 6.0 * by * by * by * p.c3;
  return run;
}

// The derivative of the same.
QuadraticRun slopeRun(CubicPowers p, float t, float by) {
  const DIFFERENCE bend = p.c2 + 3.0 * t * p.c3;
  QuadraticRun run;
  run.value = p.c1 + t * (2.0 * p.c2 + 3.0 * t * p.c3);
  run.first = by * (2.0 * bend + 3.0 * by * p.c3);
  run.second = 6.0 * by * by * p.c3;
  return run;
}

void step_(inout CubicRun run) {
  run.value += run.first;
  run.first += run.second;
  run.second += run.third;
}
void step_(inout QuadraticRun run) {
  run.value += run.first;
  run.first += run.second;
}
