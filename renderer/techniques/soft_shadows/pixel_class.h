// SPDX-License-Identifier: BSD-3-Clause
// What became of a pixel: the first count channel. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques::pixel_class {
#endif

const uint kNotReceiver = 0u;  // no surface that receives shadows
const uint kLit = 1u;          // found to be lit without a look at occluders
const uint kUmbra = 2u;        // found to be in umbra likewise
const uint kProcessed = 3u;    // visibility from occluders
const uint kOutside = 4u;      // looks past the map
const uint kCutShort = 5u;     // needs more loop iterations than the driver grants
const uint kClassCount = 6u;

#ifdef __cplusplus
}  // namespace limen::techniques::pixel_class

namespace limen::techniques {

enum PixelClass : uint32_t {
  NotReceiver = pixel_class::kNotReceiver,
  Lit = pixel_class::kLit,
  Umbra = pixel_class::kUmbra,
  Processed = pixel_class::kProcessed,
  Outside = pixel_class::kOutside,
  CutShort = pixel_class::kCutShort,
  ClassCount = pixel_class::kClassCount
};

}  // namespace limen::techniques
#endif
