// SPDX-License-Identifier: BSD-3-Clause
// Solid textures in [-1, 1] over a lattice of pitch 1. Integers decide all random values, so every GPU has the same.

float checker(vec3 at) {
  const ivec3 cell = ivec3(floor(at));
  return ((cell.x + cell.y + cell.z) & 1) == 0 ? 1.0 : -1.0;
}

// Of the wave that is 1 in even cells and -1 in odd ones, the integral from 0, and the mean over a width.
float checkerIntegral(float at) { return 1.0 - abs(at - 2.0 * floor(0.5 * at) - 1.0); }
float checkerMean(float at, float width) {
  if (!(width > 1e-3)) return (int(floor(at)) & 1) == 0 ? 1.0 : -1.0;
  if (width > 1e3) return 0.0;
  return (checkerIntegral(at + 0.5 * width) - checkerIntegral(at - 0.5 * width)) / width;
}

// Mean of the checker over a box.
float checkerOver(vec3 at, vec3 width) { return checkerMean(at.x, width.x) * checkerMean(at.y, width.y) * checkerMean(at.z, width.z); }

// The checker over a parallelogram with these sides: boxes along the longer one, each as wide as its share of that side and the
// shorter one are along each axis. As an anisotropic filter of a texture, with up to 16 places.
float checkerWithin(vec3 at, vec3 sideA, vec3 sideB) {
  const bool first = dot(sideA, sideA) > dot(sideB, sideB);
  const vec3 along = first ? sideA : sideB, across = first ? sideB : sideA;
  const float ratio = length(along) / max(length(across), 1e-6);
  const int places = int(clamp(ceil(ratio), 1.0, 16.0));
  const vec3 width = abs(along) / float(places) + abs(across);
  float sum = 0.0;
  for (int i = 0; i < places; ++i) sum += checkerOver(at + along * ((float(i) + 0.5) / float(places) - 0.5), width);
  return sum / float(places);
}

// Random value of a lattice point: the first word of the hash "pcg3d" (Jarzynski and Olano 2020).
float latticeValue(ivec3 point) {
  uvec3 v = uvec3(point) * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  return float(v.x >> 8u) * (2.0 / 16777215.0) - 1.0;
}

float valueNoise(vec3 at) {
  const vec3 low = floor(at), f = at - low;
  const vec3 w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  const ivec3 p = ivec3(low);
  float corners[4];
  for (int k = 0; k < 4; ++k) {
    const ivec3 q = p + ivec3(0, k & 1, k >> 1);
    corners[k] = mix(latticeValue(q), latticeValue(q + ivec3(1, 0, 0)), w.x);
  }
  return mix(mix(corners[0], corners[1], w.y), mix(corners[2], corners[3], w.y), w.z);
}

// Octaves of half the size and half the amplitude each; amplitudes sum to 1.
float fractalNoise(vec3 at, int octaves) {
  float sum = 0.0, amplitude = 1.0, total = 0.0;
  for (int i = 0; i < octaves; ++i) {
    // Shifted by more than a cell, so that octaves have no lattice point in common.
    sum += amplitude * valueNoise(at + vec3(17.31, 7.67, 31.13) * float(i));
    total += amplitude;
    amplitude *= 0.5;
    at *= 2.0;
  }
  return total > 0.0 ? sum / total : 0.0;
}

// Noise without the octaves that a width blurs: those whose lattice is finer fade out.
float fractalNoiseOver(vec3 at, int octaves, float wide) {
  float sum = 0.0, amplitude = 1.0, total = 0.0;
  for (int i = 0; i < octaves; ++i) {
    const float left = 1.0 - smoothstep(0.5, 1.5, wide);
    if (left > 0.0) sum += left * amplitude * valueNoise(at + vec3(17.31, 7.67, 31.13) * float(i));
    total += amplitude;
    amplitude *= 0.5;
    at *= 2.0;
    wide *= 2.0;
  }
  return total > 0.0 ? sum / total : 0.0;
}
