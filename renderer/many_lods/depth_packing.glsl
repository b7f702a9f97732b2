// SPDX-License-Identifier: BSD-3-Clause
// Depth and colour in two words for atomicMin() on each. See depth_packing.h.

// `depth` is in [0, 1); `colour`: 24 bits.
uvec2 packedSplat(float depth, uint colour) {
  // Clamped: 1 would have the exponent of the next octave and no mantissa, and be the nearest of all.
  const uint bits = floatBitsToUint(0.5 + 0.5 * clamp(depth, 0.0, 0.99999988));
  const uint upper = min(bits, 0x3f7fffffu) << 9u & 0xfffff000u;
  return uvec2(upper | (colour & 0xfffu), upper | colour >> 12u);
}

uint unpackedColour(uvec2 words) { return (words.x & 0xfffu) | (words.y & 0xfffu) << 12u; }
float unpackedDepth(uint word) { return 2.0 * uintBitsToFloat(0x3f000000u | word >> 9u) - 1.0; }
