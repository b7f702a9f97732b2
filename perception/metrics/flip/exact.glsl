// SPDX-License-Identifier: BSD-3-Clause
// Equal images have to come out equal to the last bit, yet a compiler may contract a * b + c in one of two
// copies of an expression and not in the other. Whatever is made of test and reference is therefore `precise`,
// their difference too, and says by fma() where it means one rounding: that costs no more than a contraction.

vec3 transform(mat3 matrix, vec3 v) {
  precise vec3 result = fma(matrix[2], v.zzz, fma(matrix[1], v.yyy, matrix[0] * v.x));
  return result;
}
