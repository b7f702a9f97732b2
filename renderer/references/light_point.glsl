// SPDX-License-Identifier: BSD-3-Clause
// The points of LightSamples, in double precision.
#include "renderer/references/reference_bindings.h"

layout(std430, binding = kShadowRayLightBuffer) readonly buffer Light { ShadowLight light; };
layout(std430, binding = kShadowRayOutlineBuffer) readonly buffer Outline { OutlineTriangle outlineTriangles[]; };

// 64-bit numbers: low word, high word.
uvec2 product64(uvec2 a, uvec2 b) {
  uint high, low;
  umulExtended(a.x, b.x, high, low);
  return uvec2(low, high + a.x * b.y + a.y * b.x);
}

uvec2 shifted64(uvec2 a, int by) { return uvec2((a.x >> by) | (a.y << (32 - by)), a.y >> by); }

// mixBits() of counter_random.h.
uvec2 mixBits(uvec2 x) {
  uint carry;
  x.x = uaddCarry(x.x, 0x7f4a7c15u, carry);
  x.y += 0x9e3779b9u + carry;
  x = product64(x ^ shifted64(x, 30), uvec2(0x1ce4e5b9u, 0xbf58476du));
  x = product64(x ^ shifted64(x, 27), uvec2(0x133111ebu, 0x94d049bbu));
  return x ^ shifted64(x, 31);
}

// Sine and cosine for |x| <= pi / 4 to 1e-16, by their series.
dvec2 sineAndCosine(double x) {
  const double s = x * x;
  double odd = -1.0LF / 1307674368000.0LF, even = 1.0LF / 20922789888000.0LF;
  odd = odd * s + 1.0LF / 6227020800.0LF;
  odd = odd * s - 1.0LF / 39916800.0LF;
  odd = odd * s + 1.0LF / 362880.0LF;
  odd = odd * s - 1.0LF / 5040.0LF;
  odd = odd * s + 1.0LF / 120.0LF;
  odd = odd * s - 1.0LF / 6.0LF;
  even = even * s - 1.0LF / 87178291200.0LF;
  even = even * s + 1.0LF / 479001600.0LF;
  even = even * s - 1.0LF / 3628800.0LF;
  even = even * s + 1.0LF / 40320.0LF;
  even = even * s - 1.0LF / 720.0LF;
  even = even * s + 1.0LF / 24.0LF;
  even = even * s - 0.5LF;
  return dvec2(x + x * s * odd, 1.0LF + s * even);
}

dvec2 onDisc(dvec2 square) {
  const dvec2 p = 2.0LF * square - 1.0LF;
  if (p.x == 0.0LF && p.y == 0.0LF) return dvec2(0.5LF);
  const double kQuarter = 0.78539816339744830962LF;
  const bool wide = abs(p.x) > abs(p.y);
  const dvec2 at = sineAndCosine(kQuarter * (wide ? p.y / p.x : p.x / p.y));
  // From the other axis the angle is pi / 2 less this one.
  return 0.5LF + 0.5LF * (wide ? p.x * at.yx : p.y * at);
}

dvec2 onPolygon(dvec2 square) {
  uint which = 0u;
  // All of them: llvmpipe (Mesa 22.3.6) leaves a loop that ends at the first one at the wrong place.
  for (uint i = 1u; i < light.outlineCount; ++i)
    if (square.x >= outlineTriangles[i - 1u].share) which = i;
  const OutlineTriangle t = outlineTriangles[which];
  const double low = which > 0u ? outlineTriangles[which - 1u].share : 0.0LF, share = t.share - low;
  const double u = share > 0.0LF ? clamp((square.x - low) / share, 0.0LF, 1.0LF) : 0.5LF;
  const double root = sqrt(u);
  return dvec2(t.ax, t.ay) * (1.0LF - root) +
         (dvec2(t.bx, t.by) * (1.0LF - square.y) + dvec2(t.cx, t.cy) * square.y) * root;
}

// What all samples of a pixel share.
uvec2 pixelBits(uint pixel) { return mixBits(uvec2(light.seedLow, light.seedHigh) ^ uvec2(pixel, 0u)); }

// Relative to the anchor.
dvec3 lightPoint(uvec2 pixelBits, uint index) {
  const uvec2 bits = mixBits(pixelBits ^ uvec2(index, light.part));
  dvec2 square = dvec2(double(bits.y), double(bits.x)) * 2.3283064365386962890625e-10LF;  // 2^-32
  if (light.side > 0u) square = (dvec2(uvec2(index % light.side, index / light.side)) + square) * light.cell;
  dvec2 unit = square;
  if (light.shape == kShadowLightDisc) unit = onDisc(square);
  if (light.shape == kShadowLightPolygon) unit = onPolygon(square);
  unit -= 0.5LF;
  return dvec3(light.centreX, light.centreY, light.centreZ) + dvec3(light.rightX, light.rightY, light.rightZ) * unit.x +
         dvec3(light.upX, light.upY, light.upZ) * unit.y;
}
