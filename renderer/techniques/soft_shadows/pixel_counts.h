// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/gl/texture.h"
#include "renderer/techniques/soft_shadows/pixel_class.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// RGBA32UI, as store() in shadow_lookup.glsl writes them.
struct CountImages {
  gl::Texture work, search;
};

/// Four values per pixel each: class, micro-occluders, fetches, level, rounded up if between two; and search
/// area in texels, micro-occluders examined, those that covered any of the light, bits of the real-valued
/// level.
struct PixelCounts {
  glm::ivec2 sizePx{0};
  std::vector<uint32_t> work, search;

  /// Adds what the passes over one map counted.
  void add(const CountImages& images);
};

/// A technique whose count() classifies each pixel.
class CountsPixels {
 public:
  virtual ~CountsPixels() = default;
  /// Empty before count().
  virtual const PixelCounts& counted() const = 0;
};

/// Shares of lit, umbra, processed and outside pixels; micro-occluders, fetches and texels searched per
/// processed pixel; the share of micro-occluders examined in vain. Throws Error if a driver cut
/// loops short.
std::vector<Counter> visibilityCounters(const PixelCounts& counted);
/// What they mean.
std::vector<Quantity> visibilityQuantities();

}  // namespace limen::techniques
