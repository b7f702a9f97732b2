// SPDX-License-Identifier: BSD-3-Clause
// Light of a voxel: its flux and the sum of the directions of its light, (flux, vector), over the area of a voxel's face. These
// are harmonics of two bands: c00 = flux / sqrt(4 pi), (c11, c1-1, c10) = sqrt(3 / 4 pi) vector.

const float kCosineDirection = 2.0 / 3.0;  // length of the vector of a clamped cosine of flux 1

vec4 cosineLobe(vec3 normal) { return vec4(1.0, kCosineDirection * normal); }
