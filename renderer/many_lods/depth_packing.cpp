// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/depth_packing.h"

#include <algorithm>
#include <bit>

namespace limen::many_lods {
namespace {

PackedSplat packedFrom(uint32_t bits, uint32_t colour) {
  const uint32_t upper = (bits << 9) & 0xfffff000U;
  return {upper | (colour & 0xfffU), upper | (colour >> 12)};
}

}  // namespace

PackedSplat packSplat(float depth, uint32_t colour) {
  const auto bits = std::bit_cast<uint32_t>(0.5F + 0.5F * std::clamp(depth, 0.0F, 0.99999988F));
  return packedFrom(std::min(bits, 0x3f7fffffU), colour);
}

PackedSplat packSplatAsPrinted(float depth, uint32_t colour) {
  return packedFrom(std::bit_cast<uint32_t>(0.5F + 0.5F * depth), colour);
}

uint32_t colourOf(PackedSplat splat) { return (splat.low & 0xfffU) | (splat.high & 0xfffU) << 12; }

float depthOf(uint32_t word) { return 2.0F * std::bit_cast<float>(0x3f000000U | (word >> 9)) - 1.0F; }

}  // namespace limen::many_lods
