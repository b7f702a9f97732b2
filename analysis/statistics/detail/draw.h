// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <random>

namespace limen::analysis {

/// Uniform on 0 .. count - 1. std::uniform_int_distribution differs between standard libraries; this does
/// not. The bias is below 2^-32.
inline size_t drawIndex(std::mt19937_64& random, size_t count) {
  return static_cast<size_t>((random() >> 32) * count >> 32);
}

/// Uniform on (0, 1), in steps of 2^-53.
inline double drawUnit(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
}

}  // namespace limen::analysis
