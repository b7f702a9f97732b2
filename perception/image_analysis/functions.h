// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/base/image.h"

/// What OpenCV's analysis of images does, as a module that is loaded at the first use: programs start without
/// it.
namespace limen::perception::analysis {

/// Labels in no particular order.
void labelComponents(const uint8_t* mask, int width, int height, int connectivity, int32_t* labels);
/// Where each pixel of `now` was in `before`, relative to where it is. 1 channel of 8-bit values.
void traceBack(const uint8_t* before, const uint8_t* now, int width, int height, float* flow);

struct Functions {
  decltype(&labelComponents) label;
  decltype(&traceBack) trace;
};
inline constexpr const char* kEntry = "limenImageAnalysis";
using Entry = const Functions* (*)();

/// Loads the module, which is installed beside the program. Throws Error if it is missing.
const Functions& functions();

}  // namespace limen::perception::analysis
