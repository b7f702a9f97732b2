// SPDX-License-Identifier: BSD-3-Clause
// Algebraic surfaces f = 0 for any kind of number (Schwarz 2009, section 6.4). For C++ and GLSL: LIMEN_ALGEBRAIC(TYPE)
// defines them for TYPE, which has add(), sub(), mul(), sqr(), scale() and shift(); LIMEN_REAL is the type of constants.
#pragma once

#define LIMEN_SPHERE 0
#define LIMEN_HYPERBOLOID 1
#define LIMEN_TORUS 2
#define LIMEN_GOURSAT 3
#define LIMEN_HEART 4
#define LIMEN_BARTH_DECIC 5

// x^2 + y^2 + z^2 - 1;  x^2 + z^2 - y^2 - 1/4;
// torus of radii 2 and 1 around z: (x^2 + y^2 + z^2 + 3)^2 - 16 (x^2 + y^2);
// Goursat's surface with a = 0, b = -2, c = -1: x^4 + y^4 + z^4 - 2 (x^2 + y^2 + z^2) - 1;
// heart: (x^2 + 9/4 y^2 + z^2 - 1)^3 - x^2 z^3 - 9/80 y^2 z^3;
// Barth's decic with w = 1 and t the golden ratio: 8 (x^2 - t^4 y^2) (y^2 - t^4 z^2) (z^2 - t^4 x^2)
//   (x^4 + y^4 + z^4 - 2 x^2 y^2 - 2 x^2 z^2 - 2 y^2 z^2) + (3 + 5 t) (r^2 - 1)^2 (r^2 - 2 + t)^2.
#define LIMEN_ALGEBRAIC(TYPE)                                                                              \
  TYPE sphereValue(TYPE x, TYPE y, TYPE z) {                                                               \
    return shift(add(add(sqr(x), sqr(y)), sqr(z)), LIMEN_REAL(-1.0));                                      \
  }                                                                                                        \
  TYPE hyperboloidValue(TYPE x, TYPE y, TYPE z) {                                                          \
    return shift(sub(add(sqr(x), sqr(z)), sqr(y)), LIMEN_REAL(-0.25));                                     \
  }                                                                                                        \
  TYPE torusValue(TYPE x, TYPE y, TYPE z) {                                                                \
    TYPE across = add(sqr(x), sqr(y));                                                                     \
    return sub(sqr(shift(add(across, sqr(z)), LIMEN_REAL(3.0))), scale(LIMEN_REAL(16.0), across));         \
  }                                                                                                        \
  TYPE goursatValue(TYPE x, TYPE y, TYPE z) {                                                              \
    TYPE xx = sqr(x);                                                                                      \
    TYPE yy = sqr(y);                                                                                      \
    TYPE zz = sqr(z);                                                                                      \
    return shift(sub(add(add(sqr(xx), sqr(yy)), sqr(zz)), scale(LIMEN_REAL(2.0), add(add(xx, yy), zz))),   \
                 LIMEN_REAL(-1.0));                                                                        \
  }                                                                                                        \
  TYPE heartValue(TYPE x, TYPE y, TYPE z) {                                                                \
    TYPE xx = sqr(x);                                                                                      \
    TYPE yy = sqr(y);                                                                                      \
    TYPE zz = sqr(z);                                                                                      \
    TYPE a = shift(add(add(xx, scale(LIMEN_REAL(2.25), yy)), zz), LIMEN_REAL(-1.0));                       \
    TYPE b = add(xx, scale(LIMEN_REAL(9.0) / LIMEN_REAL(80.0), yy));                                       \
    return sub(mul(a, sqr(a)), mul(b, mul(z, zz)));                                                        \
  }                                                                                                        \
  TYPE barthDecicValue(TYPE x, TYPE y, TYPE z) {                                                           \
    LIMEN_REAL t = (LIMEN_REAL(1.0) + sqrt(LIMEN_REAL(5.0))) / LIMEN_REAL(2.0);                            \
    LIMEN_REAL t4 = t * t * t * t;                                                                         \
    TYPE xx = sqr(x);                                                                                      \
    TYPE yy = sqr(y);                                                                                      \
    TYPE zz = sqr(z);                                                                                      \
    TYPE planes = mul(mul(sub(xx, scale(t4, yy)), sub(yy, scale(t4, zz))), sub(zz, scale(t4, xx)));        \
    TYPE squares = add(add(sqr(xx), sqr(yy)), sqr(zz));                                                    \
    TYPE products = add(add(mul(xx, yy), mul(xx, zz)), mul(yy, zz));                                       \
    TYPE cones = sub(squares, scale(LIMEN_REAL(2.0), products));                                           \
    TYPE rr = add(add(xx, yy), zz);                                                                        \
    TYPE spheres = mul(sqr(shift(rr, LIMEN_REAL(-1.0))), sqr(shift(rr, t - LIMEN_REAL(2.0))));             \
    return add(scale(LIMEN_REAL(8.0), mul(planes, cones)),                                                 \
               scale(LIMEN_REAL(3.0) + LIMEN_REAL(5.0) * t, spheres));                                     \
  }
