// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace limen::many_lods {

/// Depth and a colour of 24 bits in two words, each for an atomic minimum of its own (FreePipe): 20 bits of
/// depth at the top, 12 of the colour below. Nearer wins in both words; of two fragments whose depths agree
/// to 2^-20 each word takes the lesser bits, so that the colour may be made of both. Depths from 1 on are
/// taken for the largest below, where the printed form would make them the nearest. The farthest depth with
/// all bits of the colour set is the same as the clear value. Twin: depth_packing.glsl. Source: Holländer
/// 2013, section 3.7.2.
struct PackedSplat {
  uint32_t low = 0xffffffffU, high = 0xffffffffU;
};
PackedSplat packSplat(float depth, uint32_t colour);
/// As printed: without the clamp.
PackedSplat packSplatAsPrinted(float depth, uint32_t colour);
uint32_t colourOf(PackedSplat splat);
float depthOf(uint32_t word);

}  // namespace limen::many_lods
