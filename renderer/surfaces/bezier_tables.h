// SPDX-License-Identifier: BSD-3-Clause
// Tables of the evaluation of Bézier patches. For C++ and GLSL.
#pragma once

// Binomial coefficients n over i, n = 0 to 9; row n begins at n (n + 1) / 2.
#define LIMEN_BINOMIALS                                                                                      \
  1, 1, 1, 1, 2, 1, 1, 3, 3, 1, 1, 4, 6, 4, 1, 1, 5, 10, 10, 5, 1, 1, 6, 15, 20, 15, 6, 1, 1, 7, 21, 35, 35, \
      21, 7, 1, 1, 8, 28, 56, 70, 56, 28, 8, 1, 1, 9, 36, 84, 126, 126, 84, 36, 9, 1

// Where the normal of a surface came from: NormalRung of normal.h.
#define LIMEN_NORMAL_FIELD 0
#define LIMEN_NORMAL_TANGENTS 1
#define LIMEN_NORMAL_LIMIT 2
#define LIMEN_NORMAL_INWARD 3
#define LIMEN_NORMAL_CORNER_PLANE 4
#define LIMEN_NORMAL_NONE 5
