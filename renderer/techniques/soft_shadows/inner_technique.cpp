// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/inner_technique.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/occluder_search.h"

namespace limen::techniques {
namespace {

constexpr const char *kInner = "inner", *kRays = "rays", *kRayTraced = "ray_traced", *kExact = "exact_union";

bool readsMap(const std::string& inner) { return inner != kRayTraced && inner != kExact; }

// Formerly wrappers repeated some parameters of what they wrap.
std::vector<Parameter> searchDeclarations() {
  return {integerParameter("resolution", 1024, 1, 4096, "texel", ""),
          integerParameter("budget", 256, 0, 1 << 24, "", ""),
          choiceParameter("structure", "hsm", {"none", "hsm", "mssm", "n_buffer", "ysm"}, ""),
          integerParameter("fixed_level", -1, -1, 12, "", ""),
          choiceParameter("occluders", "micropatches", {"micropatches", "microquads", "microrects"}, ""),
          realParameter("bias", 1e-4, 0.0, 0.1, "", ""),
          realParameter("slope_bias", 2.0, 0.0, 16.0, "texel", ""),
          realParameter("max_slope", 10.0, 0.1, 1e6, "", "")};
}

/// Square numbers, as the strata of a ray-traced light need them.
Parameter rayParameter() {
  return choiceParameter(kRays, "256", {"16", "64", "256", "1024", "4096"},
                         "Shadow rays a point where the inner technique is ray_traced");
}

const TechniqueInfo& infoOf(const ParameterValues& values) {
  return TechniqueRegistry::instance().get("soft_shadows/" + values.text(kInner), kInner);
}

ParameterValues valuesOf(const ParameterValues& values) {
  std::map<std::string, ParameterValue> given;
  if (readsMap(values.text(kInner))) {
    const std::map<std::string, std::string> paths = {{"budget", "budget.limit"},
                                                      {"bias", "bias.constant"},
                                                      {"slope_bias", "bias.slope"},
                                                      {"max_slope", "bias.max_slope"}};
    for (const Parameter& parameter : searchDeclarations()) {
      const auto path = paths.find(parameter.name);
      if (parameter.name != "fixed_level")
        given[path == paths.end() ? parameter.name : path->second] = values.all().at(parameter.name);
    }
    if (values.integer("fixed_level") >= 0) {
      given["levels"] = std::string("fixed");
      given["levels.level"] = values.integer("fixed_level");
    }
  }
  if (values.text(kInner) == kRayTraced) given["samples"] = int64_t{std::stoi(values.text(kRays))};
  return {infoOf(values).parameters, given};
}

void refuseStray(const ParameterValues& values, const Parameter& parameter, const char* mend) {
  if (values.has(parameter.name) && values.all().at(parameter.name) != parameter.defaultValue)
    throw Error("'" + parameter.name + "' means nothing to inner: " + values.text(kInner), parameter.name,
                std::string("leave it out, or give ") + mend);
}

/// Defaults of a struct hold no values of the entry.
ParameterValues completeValues(const ChosenEntry& inner) {
  return {TechniqueRegistry::instance().get(inner.name).parameters, inner.values.all()};
}

}  // namespace

std::vector<std::string> innerEntries(InnerKind kind) {
  std::vector<std::string> out = {"soft_shadows/backprojection", "soft_shadows/bitmask"};
  if (kind >= InnerKind::OrRayTraced) out.emplace_back("soft_shadows/ray_traced");
  if (kind >= InnerKind::OrExact) out.emplace_back("soft_shadows/exact_union");
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

std::vector<Parameter> innerParameters(InnerKind kind) {
  std::vector<std::string> choices = {"backprojection", "bitmask"};
  if (kind >= InnerKind::OrRayTraced) choices.emplace_back(kRayTraced);
  if (kind >= InnerKind::OrExact) choices.emplace_back(kExact);
  std::vector<Parameter> out = {
      choiceParameter(kInner, "backprojection", choices,
                      "Technique, soft_shadows/..., that finds the visibility; what is "
                      "not given here has its default")};
  for (Parameter& parameter : searchDeclarations()) out.push_back(std::move(parameter));
  if (kind >= InnerKind::OrRayTraced) out.push_back(rayParameter());
  return out;
}

void checkInner(const ParameterValues& values) {
  if (!readsMap(values.text(kInner)))
    for (const Parameter& parameter : searchDeclarations())
      refuseStray(values, parameter, "inner: backprojection or bitmask");
  if (values.text(kInner) != kRayTraced) refuseStray(values, rayParameter(), "inner: ray_traced");
  const TechniqueInfo& info = infoOf(values);
  if (info.check) info.check(valuesOf(values));
}

std::unique_ptr<Technique> makeInner(const ParameterValues& values) {
  return infoOf(values).make(valuesOf(values));
}

frame::ShadowMapSettings innerMap(const ParameterValues& values) {
  return {static_cast<int>(values.integer("resolution")), frame::Raster::Auto};
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
  std::vector<Quantity> all = OccluderSearch::counterNames();
  // Named here, since the references may not be registered yet when wrappers are.
  all.insert(all.end(),
             {{"rays_per_receiver", "Rays per receiver", "1/px", Direction::LowerIsBetter},
              {"rays", "Rays", "", Direction::LowerIsBetter},
              {"occluders_per_receiver", "Occluders per receiver", "1/px", Direction::LowerIsBetter}});
  return all;
}

}  // namespace limen::techniques
