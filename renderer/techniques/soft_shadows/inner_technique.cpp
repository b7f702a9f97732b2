// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/inner_technique.h"

#include <algorithm>

#include "renderer/techniques/soft_shadows/search_technique.h"

namespace limen::techniques {
namespace {

/// A struct's defaults contain no values of the entry.
ParameterValues completeValues(const ChosenEntry& inner) {
  return {TechniqueRegistry::instance().get(inner.name).parameters, inner.values.all()};
}

}  // namespace

std::vector<std::string> innerEntries(InnerKind kind) {
  if (kind == InnerKind::Coloured)
    return {"soft_shadows/bitmask_coloured", "soft_shadows/ray_traced_colours"};
  std::vector<std::string> out = {"soft_shadows/backprojection", "soft_shadows/bitmask"};
  if (kind >= InnerKind::OrRayTraced) out.emplace_back("soft_shadows/ray_traced");
  if (kind >= InnerKind::OrExact) out.emplace_back("soft_shadows/exact_union");
  if (kind >= InnerKind::OrPcss) out.emplace_back("soft_shadows/pcss");
  return out;
}

std::unique_ptr<Technique> makeInner(const ChosenEntry& inner) {
  return TechniqueRegistry::instance().get(inner.name).make(completeValues(inner));
}

frame::ShadowMapSettings innerMap(const ChosenEntry& inner) {
  const MapSettings map = MapSettings::table().read(completeValues(inner));
  return {map.resolution, map.raster};
}

SlopeBias innerBias(const ChosenEntry& inner) {
  const BiasSettings bias = SearchSettings::table().read(completeValues(inner)).bias;
  const auto* slope = std::get_if<SlopeBias>(&bias);
  return slope ? *slope : SlopeBias{constantOf(bias), 0.0};
}

std::vector<Counter> countInner(Technique& inner, frame::Frame& frame) {
  std::vector<Counter> out;
  const std::vector<Quantity> names = innerCounters();
  for (Counter& counter : inner.count(frame))
    if (std::any_of(names.begin(), names.end(),
                    [&](const Quantity& each) { return each.name == counter.name; }))
      out.push_back(std::move(counter));
  return out;
}

std::vector<Quantity> innerCounters() {
  std::vector<Quantity> all = SearchTechnique::quantities();
  // Named here, since the references may not be registered yet when wrappers are.
  all.insert(all.end(),
             {{"rays_per_receiver", "Rays per receiver", "1/px", Direction::LowerIsBetter},
              {"rays", "Rays", "", Direction::LowerIsBetter},
              {"occluders_per_receiver", "Occluders per receiver", "1/px", Direction::LowerIsBetter}});
  return all;
}

}  // namespace limen::techniques
