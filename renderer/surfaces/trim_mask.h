// SPDX-License-Identifier: BSD-3-Clause
// Trimming by a texture over the parameter domain (Schwarz 2009, section 6.1.4; SC-18).
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/surfaces/trim_region.h"

namespace limen::surfaces {

/// What a texture over the domain holds.
enum class TrimTexture {
  Inside,   ///< 1 where the texel's middle is left
  Distance  ///< signed distance to the nearest curve, positive where the surface is left, up to four texels;
            ///< interpolated
};
constexpr EnumNames<TrimTexture, 2> enumNames(TrimTexture) {
  return {{{{TrimTexture::Distance, "distance"}, {TrimTexture::Inside, "inside"}}}};
}

/// A region sampled by a square texture, as a shader reads it.
class TrimMask {
 public:
  TrimMask(const TrimRegion& region, int resolution, TrimTexture texture);
  bool contains(glm::dvec2 at) const;
  int resolution() const { return resolution_; }
  const std::vector<float>& texels() const { return texels_; }  ///< rows of rising v
  int64_t bytes() const {
    return static_cast<int64_t>(texels_.size()) * (texture_ == TrimTexture::Inside ? 1 : 2);
  }

 private:
  float texel(int x, int y) const;
  int resolution_;
  TrimTexture texture_;
  std::vector<float> texels_;
};

/// Share of the domain where the mask says otherwise than the region, from `samples` x `samples` places.
double trimError(const TrimRegion& region, const TrimMask& mask, int samples);

}  // namespace limen::surfaces
