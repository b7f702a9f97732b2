// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/stimulus.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/hash.h"

namespace limen::study {
namespace {

/// Of the canonical form: raised when it changes, so that no hash passes for another's.
constexpr int kForm = 1;

using nlohmann::json;

json toJson(const NamedEntry& entry) {
  return {{"name", entry.name}, {"version", entry.version}, {"values", entry.values.toJson()}};
}

/// Values as they were declared: JSON keeps whole numbers and reals apart.
ParameterValues valuesFromJson(const json& object) {
  std::vector<Parameter> declared;
  std::map<std::string, ParameterValue> given;
  for (const auto& [name, value] : object.items()) {
    Parameter parameter;
    parameter.name = name;
    if (value.is_boolean()) {
      parameter.type = ParameterType::Boolean;
      given[name] = value.get<bool>();
    } else if (value.is_number_float()) {
      parameter.type = ParameterType::Real;
      given[name] = value.get<double>();
    } else if (value.is_number_integer()) {
      parameter.type = ParameterType::Integer;
      given[name] = value.get<int64_t>();
    } else {
      parameter.type = ParameterType::Text;
      given[name] = value.get<std::string>();
    }
    parameter.defaultValue = given[name];
    declared.push_back(std::move(parameter));
  }
  return ParameterValues(declared, given);
}

NamedEntry entryFromJson(const json& object) {
  return {object.at("name").get<std::string>(), object.at("version").get<int>(),
          valuesFromJson(object.at("values"))};
}

std::optional<NamedEntry> optionalEntry(const json& stimulus, const char* key) {
  if (!stimulus.contains(key)) return std::nullopt;
  return entryFromJson(stimulus.at(key));
}

const char* toText(Cue::Kind kind) {
  switch (kind) {
    case Cue::Kind::None:
      return "none";
    case Cue::Kind::Arrow:
      return "arrow";
    case Cue::Kind::Circle:
      return "circle";
  }
  return "";
}

Cue::Kind cueKind(const std::string& text) {
  for (const Cue::Kind kind : {Cue::Kind::None, Cue::Kind::Arrow, Cue::Kind::Circle})
    if (text == toText(kind)) return kind;
  throw Error("no cue '" + text + "'", "stimulus", "known: none, arrow, circle");
}

json toJson(const Cue& cue) {
  return {{"kind", toText(cue.kind)},
          {"x_px", cue.xPx},
          {"y_px", cue.yPx},
          {"radius_px", cue.radiusPx},
          {"duration_s", cue.durationS}};
}

Cue cueFromJson(const json& object) {
  Cue cue;
  cue.kind = cueKind(object.at("kind").get<std::string>());
  cue.xPx = object.at("x_px").get<double>();
  cue.yPx = object.at("y_px").get<double>();
  cue.radiusPx = object.at("radius_px").get<double>();
  cue.durationS = object.at("duration_s").get<double>();
  return cue;
}

}  // namespace

json toJson(const Stimulus& stimulus) {
  json out = {{"form", kForm},
              {"scene", toJson(stimulus.scene)},
              {"shading", stimulus.shading.toJson()},
              {"changes", stimulus.changes},
              {"catch_shows_after", stimulus.catchShowsAfter},
              {"presentation", stimulus.presentation == Presentation::Dynamic ? "dynamic" : "static"},
              {"duration_s", stimulus.durationS},
              {"change_at_s", stimulus.changeAtS},
              {"scene_start_s", stimulus.sceneStartS},
              {"showings", stimulus.showings},
              {"gap_s", stimulus.gapS},
              {"samples", stimulus.samples},
              {"cue", toJson(stimulus.cue)}};
  if (stimulus.levels)
    out["levels"] = {{"object", stimulus.levels->object},
                     {"before", stimulus.levels->before},
                     {"after", stimulus.levels->after},
                     {"others", stimulus.levels->others}};
  if (stimulus.before) out["before"] = toJson(*stimulus.before);
  if (stimulus.after) out["after"] = toJson(*stimulus.after);
  return out;
}

Stimulus stimulusFromJson(const json& object) {
  try {
    if (object.at("form").get<int>() != kForm)
      throw Error("a stimulus of form " + object.at("form").dump(), "stimulus",
                  "this program reads form " + std::to_string(kForm));
    Stimulus out;
    out.scene = entryFromJson(object.at("scene"));
    out.shading = valuesFromJson(object.at("shading"));
    out.changes = object.at("changes").get<bool>();
    out.catchShowsAfter = object.at("catch_shows_after").get<bool>();
    const std::string presentation = object.at("presentation").get<std::string>();
    if (presentation != "dynamic" && presentation != "static")
      throw Error("no presentation '" + presentation + "'", "stimulus", "known: dynamic, static");
    out.presentation = presentation == "dynamic" ? Presentation::Dynamic : Presentation::Static;
    out.durationS = object.at("duration_s").get<double>();
    out.changeAtS = object.at("change_at_s").get<double>();
    out.sceneStartS = object.at("scene_start_s").get<double>();
    out.showings = object.at("showings").get<int>();
    out.gapS = object.at("gap_s").get<double>();
    out.samples = object.at("samples").get<int>();
    out.cue = cueFromJson(object.at("cue"));
    if (object.contains("levels")) {
      const json& levels = object.at("levels");
      out.levels = LevelChange{levels.at("object").get<int>(), levels.at("before").get<int>(),
                               levels.at("after").get<int>(), levels.at("others").get<std::string>()};
    }
    out.before = optionalEntry(object, "before");
    out.after = optionalEntry(object, "after");
    return out;
  } catch (const json::exception& error) {
    throw Error(std::string("not a stimulus: ") + error.what(), "stimulus",
                "it was damaged or written by hand");
  }
}

std::string stimulusHash(const Stimulus& stimulus) { return sha256(toJson(stimulus).dump()); }

}  // namespace limen::study
