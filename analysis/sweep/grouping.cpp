// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/grouping.h"

#include <set>

#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

void flatten(const nlohmann::json& value, const std::string& path, std::map<std::string, std::string>& out) {
  if (value.is_object()) {
    for (const auto& [key, child] : value.items()) flatten(child, path.empty() ? key : path + "." + key, out);
  } else if (value.is_string()) {
    out[path] = value.get<std::string>();
  } else if (value.is_number_float()) {
    out[path] = shortestNumber(value.get<double>());
  } else {
    out[path] = value.dump();
  }
}

// Paths below `prefix` whose values differ among `runs`; absent in one and present in another differs too.
std::vector<std::string> differing(const std::vector<const store::Run*>& runs, const std::string& prefix) {
  std::map<std::string, std::set<std::string>> values;
  std::map<std::string, size_t> count;
  for (const store::Run* run : runs)
    for (const auto& [path, value] : flatParameters(*run))
      if (path.starts_with(prefix)) {
        values[path].insert(value);
        ++count[path];
      }
  std::vector<std::string> out;
  for (const auto& [path, texts] : values)
    if (texts.size() > 1 || count[path] < runs.size()) out.push_back(path);
  return out;
}

// "technique.budget.rim" -> "budget.rim"
std::string withoutSubject(const std::string& path) { return path.substr(path.find('.') + 1); }

}  // namespace

std::map<std::string, std::string> flatParameters(const store::Run& run) {
  std::map<std::string, std::string> out;
  flatten(run.parameters, "", out);
  return out;
}

std::optional<std::string> findParameter(const store::Run& run, const std::string& path) {
  const std::map<std::string, std::string> all = flatParameters(run);
  for (const char* group : {"technique.", "scene.", "image."})
    if (const auto found = all.find(group + path); found != all.end()) return found->second;
  return std::nullopt;
}

std::optional<double> measurementOf(const store::Run& run, const std::string& name) {
  for (const store::Measurement& measurement : run.measurements)
    if (measurement.name == name) return measurement.value;
  return std::nullopt;
}

Grouping::Grouping(const std::vector<const store::Run*>& runs, const Names& names) : names_(names) {
  std::map<std::string, std::vector<const store::Run*>> techniques, scenes;
  for (const store::Run* run : runs) {
    techniques[run->technique].push_back(run);
    scenes[run->scene].push_back(run);
  }
  for (const auto& [name, group] : techniques) byTechnique_[name] = differing(group, "technique.");
  for (const auto& [name, group] : scenes) byScene_[name] = differing(group, "scene.");
  image_ = differing(runs, "image.");

  std::vector<std::string> paths;
  for (const auto* part : {&byTechnique_, &byScene_})
    for (const auto& [name, varying] : *part) paths.insert(paths.end(), varying.begin(), varying.end());
  paths.insert(paths.end(), image_.begin(), image_.end());
  std::set<std::string> seen;
  std::map<std::string, size_t> count;
  for (const std::string& path : std::set<std::string>(paths.begin(), paths.end()))
    ++count[withoutSubject(path)];
  for (const std::string& path : paths) {
    if (!seen.insert(path).second) continue;
    Axis column = names.parameter(path);
    if (count[withoutSubject(path)] > 1)
      column.title = names.heading(path.substr(0, path.find('.'))) + ": " + column.title;
    else
      column.name = withoutSubject(path);
    columnOfPath_[path] = column.name;
    columns_.push_back(std::move(column));
  }
}

std::map<std::string, std::string> Grouping::varying(const store::Run& run) const {
  const std::map<std::string, std::string> all = flatParameters(run);
  std::map<std::string, std::string> out;
  for (const auto* paths : {&byTechnique_.at(run.technique), &byScene_.at(run.scene), &image_})
    for (const std::string& path : *paths)
      if (const auto found = all.find(path); found != all.end()) out[columnOfPath_.at(path)] = found->second;
  return out;
}

std::string Grouping::describe(const store::Run& run, const std::vector<std::string>& paths) const {
  const std::map<std::string, std::string> all = flatParameters(run);
  std::vector<Setting> settings;
  for (const std::string& path : paths)
    if (const auto found = all.find(path); found != all.end()) settings.push_back({path, found->second});
  return names_.describe(settings);
}

std::string Grouping::settings(const store::Run& run) const {
  return describe(run, byTechnique_.at(run.technique));
}

std::string Grouping::group(const store::Run& run, const std::string& by) const {
  const std::map<std::string, std::string> all = flatParameters(run);
  const auto side = [&](const char* path) {
    const auto found = all.find(path);
    return found == all.end() ? std::string("–") : found->second;
  };
  const auto size = [&] { return side("image.width") + "×" + side("image.height"); };
  if (by == "technique") return run.technique;
  if (by == "image") return size();
  if (by == "scene") {
    std::vector<std::string> parts = {run.scene};
    if (const std::string settings = describe(run, byScene_.at(run.scene)); !settings.empty())
      parts.push_back(settings);
    if (!image_.empty()) parts.push_back(size());
    return join(parts);
  }
  for (const char* subject : {"technique.", "scene.", "image."})
    if (const auto found = all.find(subject + by); found != all.end())
      return names_.describe({{found->first, found->second}});
  std::string missing = "no";
  for (const char c : " " + by) missing += c == '.' || c == '_' ? ' ' : c;
  return missing;
}

}  // namespace limen::analysis
