// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/surfaces/domain_point.h"
#include "renderer/surfaces/patch_set.h"
#include "renderer/surfaces/trim_mask.h"

namespace limen::surfaces {

/// Place in the unit square of the region that trims a patch.
inline glm::dvec2 trimPlace(const PatchTrim& trim, const DomainPoint& at) {
  return {trim.low.x * at.restU + trim.high.x * at.u, trim.low.y * at.restV + trim.high.y * at.v};
}

struct TrimMaskSettings {
  TrimTexture texture = TrimTexture::Distance;
  int resolution = 256;  ///< texels a side
};

/// Which places of a set's patches are left: by its curves, or as textures have it.
class TrimTest {
 public:
  explicit TrimTest(const PatchSet& set) : set_(&set) {}
  TrimTest(const PatchSet& set, const TrimMaskSettings& settings);
  bool isLeft(uint32_t patch, const DomainPoint& at) const {
    if (set_->trimOf.empty() || set_->trimOf[patch].region < 0) return true;
    return isLeftOf(set_->trimOf[patch], at);
  }
  const std::vector<TrimMask>& masks() const { return masks_; }  ///< one a region; none: by the curves

 private:
  bool isLeftOf(const PatchTrim& trim, const DomainPoint& at) const;
  const PatchSet* set_;
  std::vector<TrimMask> masks_;
};

}  // namespace limen::surfaces
