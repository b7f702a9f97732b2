// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace limen::visibility_fields {

/// Bytes as runs: a run of 1 to 256 equal bytes takes two, its length less one and the byte. Source:
/// Gaitatzes 2012, section 4.8 (run lengths suggested, not tried).
std::vector<uint8_t> encodeRuns(std::span<const uint8_t> bytes);
std::vector<uint8_t> decodeRuns(std::span<const uint8_t> runs);

/// Makes runs longer: each code becomes the middle of the range that its run spans, as long as no code
/// changes by more than `tolerance`. Codes equal to `kept` (a miss) stay, and none becomes it.
void lengthenRuns(std::span<uint8_t> codes, int tolerance, uint8_t kept);

}  // namespace limen::visibility_fields
