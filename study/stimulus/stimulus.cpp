// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/stimulus.h"

#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"

namespace limen::study {
namespace {

using nlohmann::json;

json entryToJson(const NamedEntry& entry) {
  json out = {{"name", entry.name}, {"version", entry.version}, {"values", entry.values.toJson()}};
  if (!entry.fileHashes.empty()) out["file_hashes"] = entry.fileHashes;
  return out;
}

/// Values as in JSON: their types are those of the declarations against which they were once checked.
ParameterValues valuesFromJson(const json& values) {
  std::vector<Parameter> declared;
  for (const auto& [name, value] : values.items()) {
    Parameter parameter;
    parameter.name = name;
    if (value.is_boolean()) {
      parameter.type = ParameterType::Boolean;
      parameter.defaultValue = value.get<bool>();
    } else if (value.is_number_integer()) {
      parameter.type = ParameterType::Integer;
      parameter.defaultValue = value.get<int64_t>();
    } else if (value.is_number()) {
      parameter.type = ParameterType::Real;
      parameter.defaultValue = value.get<double>();
    } else {
      parameter.type = ParameterType::Text;
      parameter.defaultValue = value.get<std::string>();
    }
    declared.push_back(std::move(parameter));
  }
  return {declared, {}};
}

NamedEntry entryFromJson(const json& entry) {
  NamedEntry out{entry.at("name").get<std::string>(),
                 entry.at("version").get<int>(),
                 valuesFromJson(entry.at("values")),
                 {}};
  if (entry.contains("file_hashes"))
    out.fileHashes = entry["file_hashes"].get<std::map<std::string, std::string>>();
  return out;
}

const char* toText(Presentation presentation) {
  return presentation == Presentation::Dynamic ? "dynamic" : "static";
}

const char* toText(Cue::Kind kind) {
  switch (kind) {
    case Cue::Kind::Arrow:
      return "arrow";
    case Cue::Kind::Circle:
      return "circle";
    case Cue::Kind::None:
      break;
  }
  return "none";
}

/// The value whose text is `text`.
template <class Value>
Value parse(const std::string& text, std::initializer_list<Value> values) {
  for (const Value value : values)
    if (text == toText(value)) return value;
  throw Error("a stimulus has '" + text + "' where a kind is expected", "stimulus");
}

Stimulus read(const json& in) {
  Stimulus out;
  out.scene = entryFromJson(in.at("scene"));
  if (in.contains("levels")) {
    const json& levels = in["levels"];
    out.levels = LevelChange{levels.at("object").get<int>(), levels.at("before").get<int>(),
                             levels.at("after").get<int>(), levels.at("others").get<std::string>()};
  }
  out.shading = valuesFromJson(in.at("shading"));
  if (in.contains("before")) out.before = entryFromJson(in["before"]);
  if (in.contains("after")) out.after = entryFromJson(in["after"]);
  out.changes = in.at("changes").get<bool>();
  out.catchShowsAfter = in.at("catch_shows_after").get<bool>();
  out.presentation =
      parse(in.at("presentation").get<std::string>(), {Presentation::Dynamic, Presentation::Static});
  out.durationS = in.at("duration_s").get<double>();
  out.changeAtS = in.at("change_at_s").get<double>();
  out.sceneStartS = in.at("scene_start_s").get<double>();
  out.showings = in.at("showings").get<int>();
  out.gapS = in.at("gap_s").get<double>();
  out.samples = in.at("samples").get<int>();
  const json& cue = in.at("cue");
  out.cue.kind =
      parse(cue.at("kind").get<std::string>(), {Cue::Kind::None, Cue::Kind::Arrow, Cue::Kind::Circle});
  out.cue.xPx = cue.at("x_px").get<double>();
  out.cue.yPx = cue.at("y_px").get<double>();
  out.cue.radiusPx = cue.at("radius_px").get<double>();
  out.cue.durationS = cue.at("duration_s").get<double>();
  return out;
}

/// A file is identified by its content, not its location.
void nameFilesByContent(json& entry) {
  if (!entry.contains("file_hashes")) return;
  for (const auto& [parameter, hash] : entry["file_hashes"].items()) entry["values"][parameter] = hash;
}

}  // namespace

json toJson(const Stimulus& stimulus) {
  json out = {{"scene", entryToJson(stimulus.scene)},
              {"shading", stimulus.shading.toJson()},
              {"changes", stimulus.changes},
              {"catch_shows_after", stimulus.catchShowsAfter},
              {"presentation", toText(stimulus.presentation)},
              {"duration_s", stimulus.durationS},
              {"change_at_s", stimulus.changeAtS},
              {"scene_start_s", stimulus.sceneStartS},
              {"showings", stimulus.showings},
              {"gap_s", stimulus.gapS},
              {"samples", stimulus.samples},
              {"cue",
               {{"kind", toText(stimulus.cue.kind)},
                {"x_px", stimulus.cue.xPx},
                {"y_px", stimulus.cue.yPx},
                {"radius_px", stimulus.cue.radiusPx},
                {"duration_s", stimulus.cue.durationS}}}};
  if (stimulus.levels)
    out["levels"] = {{"object", stimulus.levels->object},
                     {"before", stimulus.levels->before},
                     {"after", stimulus.levels->after},
                     {"others", stimulus.levels->others}};
  if (stimulus.before) out["before"] = entryToJson(*stimulus.before);
  if (stimulus.after) out["after"] = entryToJson(*stimulus.after);
  return out;
}

Stimulus stimulusFromJson(const json& in) {
  try {
    return read(in);
  } catch (const json::exception& error) {
    throw Error(std::string("not a stimulus: ") + error.what(), "stimulus");
  }
}

std::string stimulusHash(const Stimulus& stimulus) {
  json canonical = toJson(stimulus);
  for (const char* key : {"scene", "before", "after"})
    if (canonical.contains(key)) nameFilesByContent(canonical[key]);
  return sha256(canonical.dump());
}

}  // namespace limen::study
