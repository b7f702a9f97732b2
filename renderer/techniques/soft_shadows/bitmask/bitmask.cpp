// SPDX-License-Identifier: BSD-3-Clause
// Soft shadow mapping with occlusion bitmasks (SS-12 to SS-16, SS-19, SS-20, SS-27 to SS-30).
#include "renderer/techniques/soft_shadows/bitmask/bitmask_parts.h"
#include "renderer/techniques/soft_shadows/bitmask/mask_gathering.h"

namespace limen::techniques {
namespace {

std::unique_ptr<ProductStage> makeFilter(const FilterSettings& settings) {
  const auto* mean = std::get_if<SurfaceMean>(&settings);
  return mean ? std::make_unique<VisibilityFilter>(*mean) : nullptr;
}

class Bitmask : public SearchTechnique {
 public:
  using Settings = BitmaskSettings;
  explicit Bitmask(const BitmaskSettings& settings) : SearchTechnique(bitmaskParts(settings)) {}
};

std::vector<Quantity> bitmaskQuantities() {
  std::vector<Quantity> all = SearchTechnique::quantities();
  for (Quantity& quantity : MaskGathering::quantities()) all.push_back(std::move(quantity));
  return all;
}

const RegisteredTechnique<Bitmask> kBitmaskRegistered{
    {.name = "soft_shadows/bitmask",
     .version = 6,
     .summary = "Micro-occluders backprojected onto a bit field of light samples",
     .source = "Schwarz 2009, sections 4.2 and 4.4 (SS-12 to SS-16, SS-19, SS-20, SS-27 to SS-30)",
     .product = ProductKind::Visibility,
     .needs = {"area_light"},
     .counters = bitmaskQuantities()}};

}  // namespace

SearchParts bitmaskParts(const BitmaskSettings& settings) {
  return {.shader = "renderer/techniques/soft_shadows/bitmask/bitmask.comp.glsl",
          .pass = "soft_shadows/bitmask",
          .search = settings.search,
          .levels = settings.levels,
          .passes = settings.passes,
          .occluders = occluderChoice(settings.occluders),
          .maps = settings.maps,
          .gathering = std::make_unique<MaskGathering>(settings.occluders, sampleChoice(settings.pattern),
                                                       MaskGathering::Masks::Joined),
          .last = makeFilter(settings.filter)};
}

}  // namespace limen::techniques
