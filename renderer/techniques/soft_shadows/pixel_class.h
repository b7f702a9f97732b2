// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace limen::techniques {

namespace pixel_class {
using uint = uint32_t;
#include "renderer/techniques/soft_shadows/pixel_class.glsl"
}  // namespace pixel_class

/// Values of the first count channel.
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
