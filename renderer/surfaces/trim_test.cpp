// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/trim_test.h"

namespace limen::surfaces {

TrimTest::TrimTest(const PatchSet& set, const TrimMaskSettings& settings) : set_(&set) {
  for (const TrimRegion& region : set.trims)
    masks_.emplace_back(region, settings.resolution, settings.texture);
}

bool TrimTest::isLeftOf(const PatchTrim& trim, const DomainPoint& at) const {
  const auto number = static_cast<size_t>(trim.region);
  const glm::dvec2 place = trimPlace(trim, at);
  return masks_.empty() ? set_->trims[number].contains(place) : masks_[number].contains(place);
}

}  // namespace limen::surfaces
