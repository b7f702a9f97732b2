// SPDX-License-Identifier: BSD-3-Clause
// Maps between indices and the rays of a visibility field, for C++ and GLSL alike: positions on the unit
// sphere, directions in the half space of each, and codes of distances. Source: Gaitatzes 2012,
// sections 4.4.3 and 4.4.4; Slater 2002; Shirley and Chiu 1997.
//
// Lattice positions: on each edge of an octahedron inscribed in the sphere lie k + 1 points at equal angles,
// and between them those whose three angles asin(|x|), asin(|y|), asin(|z|) are as i : j : k - i - j. So rows
// and columns are known from a direction without a search.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
#define FIELD_FUNCTION inline
namespace limen::visibility_fields {
using glm::abs;
using glm::asin;
using glm::atan;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::dot;
using glm::floor;
using glm::ivec2;
using glm::max;
using glm::min;
using glm::normalize;
using glm::round;
using glm::sin;
using glm::sqrt;
using glm::vec2;
#else
#define FIELD_FUNCTION
#endif

const int kFieldLattice = 0;  // forms of position maps
const int kFieldGrid = 1;
const int kFieldBox = 2;
const int kFieldPolar = 0;  // forms of direction maps
const int kFieldRejection = 1;
const int kFieldConcentric = 2;

const float kFieldPi = 3.14159265358979F;

// Number of the lattice position in row j, |i| + |j| <= k, of the upper or lower half.
FIELD_FUNCTION int fieldLatticeIndex(int i, int j, bool lower, int k) {
  const int row = j <= 0 ? (j + k) * (j + k) : 2 * k * k + 2 * k + 1 - (k - j + 1) * (k - j + 1);
  return row + i + k - (j < 0 ? -j : j) + (lower ? 2 * k * k + 2 * k + 1 : 0);
}

// Row and column, not rounded, in the octant of positive coordinates.
FIELD_FUNCTION vec2 fieldLatticePlace(vec3 direction, int k) {
  const vec3 angles = asin(clamp(abs(direction), vec3(0.0F), vec3(1.0F)));
  return float(k) / (angles.x + angles.y + angles.z) * vec2(angles.x, angles.y);
}

// Axes x, y across `z`, a unit vector; without a branch on its direction (Duff et al. 2017).
FIELD_FUNCTION vec3 fieldTangent(vec3 z) {
  const float s = z.z >= 0.0F ? 1.0F : -1.0F;
  const float a = -1.0F / (s + z.z);
  return vec3(1.0F + s * z.x * z.x * a, s * z.x * z.y * a, -s * z.x);
}
FIELD_FUNCTION vec3 fieldBitangent(vec3 z) {
  const float s = z.z >= 0.0F ? 1.0F : -1.0F;
  const float a = -1.0F / (s + z.z);
  return vec3(z.x * z.y * a, s + z.y * z.y * a, -z.y);
}

// Point of the unit disc for a place in the unit square.
FIELD_FUNCTION vec2 fieldConcentricDisc(vec2 place) {
  const vec2 p = 2.0F * place - 1.0F;
  if (p.x == 0.0F && p.y == 0.0F) return vec2(0.0F);
  const bool wide = abs(p.x) >= abs(p.y);
  const float radius = wide ? p.x : p.y;
  const float angle =
      wide ? 0.25F * kFieldPi * (p.y / p.x) : 0.5F * kFieldPi - 0.25F * kFieldPi * (p.x / p.y);
  return radius * vec2(cos(angle), sin(angle));
}

// Unit vector with z >= 0 for a place in the unit square. Without meaning in the corners that the rejection
// map leaves empty.
FIELD_FUNCTION vec3 fieldDirection(vec2 place, int form) {
  if (form == kFieldPolar) {
    const float theta = 0.5F * kFieldPi * place.x, phi = 2.0F * kFieldPi * place.y;
    return vec3(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
  }
  const vec2 disc = form == kFieldRejection ? 2.0F * place - 1.0F : fieldConcentricDisc(place);
  return vec3(disc, sqrt(max(0.0F, 1.0F - dot(disc, disc))));
}

// The place in the unit square of a unit vector with z >= 0.
FIELD_FUNCTION vec2 fieldPlace(vec3 direction, int form) {
  const vec2 disc = vec2(direction.x, direction.y);
  const float radius = sqrt(dot(disc, disc));
  if (form == kFieldPolar) {
    const float turns = radius > 0.0F ? atan(disc.y, disc.x) / (2.0F * kFieldPi) : 0.0F;
    return vec2(atan(radius, direction.z) / (0.5F * kFieldPi), turns < 0.0F ? turns + 1.0F : turns);
  }
  if (form == kFieldRejection) return 0.5F * disc + 0.5F;
  if (!(radius > 0.0F)) return vec2(0.5F);
  // Of the square's quarters, the one in which the larger coordinate lies.
  const bool wide = abs(disc.x) >= abs(disc.y);
  const float along = (wide ? disc.x : disc.y) < 0.0F ? -radius : radius;
  const float across = wide ? atan(disc.y / disc.x) : atan(disc.x / disc.y);
  const vec2 p = along * (wide ? vec2(1.0F, across * 4.0F / kFieldPi) : vec2(across * 4.0F / kFieldPi, 1.0F));
  return 0.5F * p + 0.5F;
}

// Whether the middle of a texel stands for a direction.
FIELD_FUNCTION bool fieldTexelUsed(ivec2 texel, int side, int form) {
  if (form != kFieldRejection) return true;
  const vec2 p = 2.0F * (vec2(texel) + 0.5F) / float(side) - 1.0F;
  return dot(p, p) <= 1.0F;
}

// The texel of a unit vector with z >= 0: the one that contains it or, if that is not used, a used neighbour
// nearer to the square's middle.
FIELD_FUNCTION ivec2 fieldTexel(vec3 direction, int side, int form) {
  const vec2 place = float(side) * fieldPlace(direction, form);
  ivec2 texel = clamp(ivec2(floor(place)), ivec2(0), ivec2(side - 1));
  if (fieldTexelUsed(texel, side, form)) return texel;
  // Towards the middle along the longer axis, then along both: at most a texel's diagonal away.
  const ivec2 inwards = ivec2(2 * texel.x < side ? 1 : -1, 2 * texel.y < side ? 1 : -1);
  const vec2 p = abs(place - 0.5F * float(side));
  const ivec2 once = texel + (p.x >= p.y ? ivec2(inwards.x, 0) : ivec2(0, inwards.y));
  return fieldTexelUsed(once, side, form) ? once : texel + inwards;
}

// Codes of distances, as shares of the sphere's diameter; a miss has a code of its own. 1 bit: 1 is a hit.
FIELD_FUNCTION uint fieldMissCode(int bits) { return bits == 1 ? 0u : (1u << uint(bits)) - 1u; }
FIELD_FUNCTION uint fieldHitCode(float share, int bits) {
  if (bits == 1) return 1u;
  const float most = float(fieldMissCode(bits) - 1u);
  return uint(floor(clamp(share, 0.0F, 1.0F) * most + 0.5F));
}
// Step between neighbouring codes, as a share of the diameter.
FIELD_FUNCTION float fieldCodeStep(int bits) {
  return bits >= 32 || bits == 1 ? 0.0F : 1.0F / float(fieldMissCode(bits) - 1u);
}

// A unit vector as two numbers of `bits` bits each, on the square that an octahedron unfolds to (Meyer et al.
// 2010).
FIELD_FUNCTION uint fieldNormalCode(vec3 n, int bits) {
  const float sum = abs(n.x) + abs(n.y) + abs(n.z);
  vec2 place = vec2(n.x, n.y) / sum;
  if (n.z < 0.0F)
    place = vec2((1.0F - abs(n.y) / sum) * (n.x < 0.0F ? -1.0F : 1.0F),
                 (1.0F - abs(n.x) / sum) * (n.y < 0.0F ? -1.0F : 1.0F));
  const float most = float((1u << uint(bits)) - 1u);
  const uint x = uint(floor(clamp(0.5F * place.x + 0.5F, 0.0F, 1.0F) * most + 0.5F));
  const uint y = uint(floor(clamp(0.5F * place.y + 0.5F, 0.0F, 1.0F) * most + 0.5F));
  return x | (y << uint(bits));
}
FIELD_FUNCTION vec3 fieldNormal(uint code, int bits) {
  const uint mask = (1u << uint(bits)) - 1u;
  const vec2 p = 2.0F * vec2(float(code & mask), float((code >> uint(bits)) & mask)) / float(mask) - 1.0F;
  const float z = 1.0F - abs(p.x) - abs(p.y), fold = max(-z, 0.0F);
  return normalize(vec3(p.x + (p.x < 0.0F ? fold : -fold), p.y + (p.y < 0.0F ? fold : -fold), z));
}

#ifdef __cplusplus
}  // namespace limen::visibility_fields
#endif
