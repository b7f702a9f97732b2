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
constexpr std::array<std::string_view, 8> kForwarded = {"resolution", "budget", "structure",  "fixed_level",
                                                        "occluders",  "bias",   "slope_bias", "max_slope"};

bool readsMap(const std::string& inner) { return inner != kRayTraced && inner != kExact; }

std::vector<Parameter> searchDeclarations() {
  std::vector<Parameter> out;
  for (Parameter& parameter : OccluderSearch::searchParameters({"micropatches", "microquads", "microrects"}))
    if (std::find(kForwarded.begin(), kForwarded.end(), parameter.name) != kForwarded.end())
      out.push_back(std::move(parameter));
  return out;
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
  if (readsMap(values.text(kInner)))
    for (const Parameter& parameter : searchDeclarations())
      given[parameter.name] = values.all().at(parameter.name);
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
  const ParameterValues values = completeValues(inner);
  return {std::stoi(limen::toText(values.all().at("resolution"))),
          fromText<frame::Raster>(values.text("raster"))};
}

SlopeBias innerBias(const ChosenEntry& inner) {
  const ParameterValues values = completeValues(inner);
  const bool bySlope = values.text("bias_form") == "receiver_slope";
  return {values.real("bias"), bySlope ? values.real("slope_bias") : 0.0, values.real("max_slope")};
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
  return {std::stoi(values.text("resolution")), frame::Raster::Auto};
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
  std::vector<Quantity> names = OccluderSearch::counterNames();
  names.insert(names.end(), {"rays_per_receiver", "rays", "occluders_per_receiver"});
  return names;
}

}  // namespace limen::techniques
