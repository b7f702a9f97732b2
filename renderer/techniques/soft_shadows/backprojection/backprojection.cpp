// SPDX-License-Identifier: BSD-3-Clause
// Soft shadow mapping with occluder backprojection and area accumulation (SS-10, SS-11): areas of all
// micropatches on the light are summed, so overlapping ones count twice. Source: Schwarz 2009, section 4.1
// (after Guennebaud 2006).
#include "renderer/techniques/soft_shadows/occluder_search.h"

namespace limen::techniques {
namespace {

class Backprojection : public OccluderSearch {
 public:
  explicit Backprojection(const ParameterValues& values)
      : OccluderSearch(values, "renderer/techniques/soft_shadows/backprojection/backprojection.comp.glsl",
                       "soft_shadows/backprojection") {}
};

const Registered<TechniqueInfo> kRegistered{
    {.name = "soft_shadows/backprojection",
     .version = 1,
     .summary = "Micropatches backprojected onto the light, their areas summed",
     .source = "Schwarz 2009, section 4.1 (SS-10, SS-11)",
     .product = ProductKind::Visibility,
     .parameters = OccluderSearch::searchParameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Backprojection>(values); },
     .errorBound = {},
     .counters = OccluderSearch::counterNames()}};

}  // namespace
}  // namespace limen::techniques
