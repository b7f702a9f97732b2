// SPDX-License-Identifier: BSD-3-Clause
// Light of a voxel: real spherical harmonics of bands 0 and 1, (constant, y, z, x), of the intensity over the area of a voxel's
// face. See voxel_grid.cpp.

const float kFluxOfConstant = 3.5449077;  // sqrt(4 pi): flux of the constant coefficient
const float kCosineSlope = 1.1547005;     // of linear to constant coefficient of a clamped cosine

// A lobe of flux 1 about a unit vector.
vec4 unitLobe(vec3 axis, float slope) { return vec4(1.0, slope * axis.yzx) / kFluxOfConstant; }
