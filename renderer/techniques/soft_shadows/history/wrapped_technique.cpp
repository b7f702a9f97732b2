// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/history/wrapped_technique.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"
#include "renderer/techniques/soft_shadows/occluder_search.h"

namespace limen::techniques {
namespace {

constexpr const char *kInner = "inner", *kRays = "rays";
constexpr const char *kTracing = "ray_traced", *kClosedForm = "exact_union";
constexpr std::array<std::string_view, 7> kOfTheSearch = {"resolution", "budget", "structure", "fixed_level",
                                                          "occluders",  "bias",   "slope_bias"};

bool readsMaps(const std::string& inner) { return inner != kTracing && inner != kClosedForm; }

std::vector<Parameter> ofTheSearch() {
  std::vector<Parameter> out;
  for (Parameter& parameter : OccluderSearch::searchParameters({"micropatches", "microquads", "microrects"}))
    if (std::find(kOfTheSearch.begin(), kOfTheSearch.end(), parameter.name) != kOfTheSearch.end())
      out.push_back(std::move(parameter));
  return out;
}

/// Square numbers, as the strata of a ray-traced light need them.
Parameter rayParameter() {
  return choiceParameter(kRays, "256", {"16", "64", "256", "1024", "4096"},
                         "Shadow rays a receiver where the inner technique is ray_traced");
}

const TechniqueInfo& innerInfo(const ParameterValues& values) {
  return TechniqueRegistry::instance().get("soft_shadows/" + values.text(kInner), kInner);
}

ParameterValues innerValues(const ParameterValues& values) {
  std::map<std::string, ParameterValue> given;
  if (readsMaps(values.text(kInner)))
    for (const Parameter& parameter : ofTheSearch()) given[parameter.name] = values.all().at(parameter.name);
  if (values.text(kInner) == kTracing) given["samples"] = int64_t{std::stoi(values.text(kRays))};
  return {innerInfo(values).parameters, given};
}

void refuseStray(const ParameterValues& values, const Parameter& parameter, const char* mend) {
  if (values.all().at(parameter.name) != parameter.defaultValue)
    throw Error("'" + parameter.name + "' means nothing to inner: " + values.text(kInner), parameter.name,
                std::string("leave it out, or give ") + mend);
}

}  // namespace

std::vector<Parameter> WrappedTechnique::parameters() {
  std::vector<Parameter> all = {choiceParameter(kInner, "backprojection",
                                                {"backprojection", "bitmask", kTracing, kClosedForm},
                                                "Technique (soft_shadows/...) that finds the visibility of a "
                                                "single frame; the last two as references")};
  for (Parameter& parameter : ofTheSearch()) all.push_back(std::move(parameter));
  all.push_back(rayParameter());
  return all;
}

void WrappedTechnique::check(const ParameterValues& values) {
  if (!readsMaps(values.text(kInner)))
    for (const Parameter& parameter : ofTheSearch())
      refuseStray(values, parameter, "inner: backprojection or bitmask");
  if (values.text(kInner) != kTracing) refuseStray(values, rayParameter(), "inner: ray_traced");
  const TechniqueInfo& info = innerInfo(values);
  if (info.check) info.check(innerValues(values));
}

std::unique_ptr<Technique> WrappedTechnique::make(const ParameterValues& values) {
  return innerInfo(values).make(innerValues(values));
}

std::vector<Counter> WrappedTechnique::count(Technique& technique, frame::Frame& frame) {
  std::vector<Counter> out;
  const std::vector<std::string> names = counterNames();
  for (Counter& counter : technique.count(frame))
    if (std::find(names.begin(), names.end(), counter.name) != names.end()) out.push_back(std::move(counter));
  return out;
}

std::vector<std::string> WrappedTechnique::counterNames() {
  std::vector<std::string> names = OccluderSearch::counterNames();
  names.emplace_back("rays_per_receiver");
  names.emplace_back("rays");
  names.emplace_back("occluders_per_receiver");
  return names;
}

}  // namespace limen::techniques
