// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/inner_technique.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"
#include "renderer/techniques/soft_shadows/occluder_search.h"

namespace limen::techniques {
namespace {

constexpr const char* kRayTraced = "ray_traced";
constexpr int64_t kDefaultRays = 256;
constexpr std::array<std::string_view, 6> kForwarded = {"resolution", "budget",     "structure",
                                                        "bias",       "slope_bias", "max_slope"};

bool forwarded(const std::string& name) {
  return std::find(kForwarded.begin(), kForwarded.end(), name) != kForwarded.end();
}

std::vector<Parameter> searchDeclarations() {
  std::vector<Parameter> out;
  for (Parameter& parameter : OccluderSearch::searchParameters({"micropatches"}))
    if (forwarded(parameter.name)) out.push_back(std::move(parameter));
  return out;
}

const TechniqueInfo& infoOf(const ParameterValues& values) {
  return TechniqueRegistry::instance().get("soft_shadows/" + values.text("inner"));
}

ParameterValues valuesOf(const ParameterValues& values) {
  const TechniqueInfo& info = infoOf(values);
  std::map<std::string, ParameterValue> given;
  for (const Parameter& parameter : info.parameters)
    if (forwarded(parameter.name)) given[parameter.name] = values.all().at(parameter.name);
  if (values.text("inner") == kRayTraced) given["samples"] = values.integer("rays");
  return {info.parameters, given};
}

}  // namespace

std::vector<Parameter> innerParameters(InnerKind kind) {
  std::vector<std::string> choices = {"backprojection", "bitmask"};
  if (kind == InnerKind::AnyVisibility) choices.emplace_back(kRayTraced);
  std::vector<Parameter> out = {choiceParameter("inner", "backprojection", choices,
                                                "Technique that finds the visibility of the chosen points, "
                                                "soft_shadows/...; what is not given here has its default")};
  for (Parameter& parameter : searchDeclarations()) out.push_back(std::move(parameter));
  if (kind == InnerKind::AnyVisibility)
    out.push_back(integerParameter("rays", kDefaultRays, 16, 65536, "rays",
                                   "Shadow rays a point where the inner technique is ray_traced"));
  return out;
}

void checkInner(const ParameterValues& values) {
  const bool rays = values.text("inner") == kRayTraced;
  for (const Parameter& parameter : searchDeclarations())
    if (rays && values.all().at(parameter.name) != parameter.defaultValue)
      throw Error("'" + parameter.name + "' is about shadow maps, and 'inner: ray_traced' has none",
                  parameter.name, "leave it out, or give another inner technique");
  if (!rays && values.has("rays") && values.integer("rays") != kDefaultRays)
    throw Error("'rays' is about ray tracing, and the inner technique casts none", "rays",
                "leave it out, or give inner: ray_traced");
  const TechniqueInfo& info = infoOf(values);
  if (info.check) info.check(valuesOf(values));
}

std::unique_ptr<Technique> makeInner(const ParameterValues& values) {
  return infoOf(values).make(valuesOf(values));
}

frame::ShadowMapSettings innerMap(const ParameterValues& values) {
  return {std::stoi(values.text("resolution")), frame::Raster::Auto};
}

}  // namespace limen::techniques
