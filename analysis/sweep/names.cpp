// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/names.h"

#include <array>
#include <set>

#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

/// Objects of Run::parameters in which a parameter is looked for when its subject is not said.
constexpr std::array kSubjects = {"technique", "scene", "image"};

std::vector<std::string> partsOf(const std::string& path) {
  std::vector<std::string> parts;
  size_t begin = 0;
  for (size_t dot; (dot = path.find('.', begin)) != std::string::npos; begin = dot + 1)
    parts.push_back(path.substr(begin, dot - begin));
  parts.push_back(path.substr(begin));
  return parts;
}

// "technique.budget.rim" -> "technique", "budget.rim"
std::pair<std::string, std::string> splitSubject(const std::string& path) {
  const size_t dot = path.find('.');
  return dot == std::string::npos ? std::pair(std::string(), path)
                                  : std::pair(path.substr(0, dot), path.substr(dot + 1));
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

std::string Axis::label() const { return titleWithUnit(title, unit); }

Axis Names::axis(const std::string& name, bool software) const {
  if (const store::QuantityRow* row = descriptions_.quantity(name)) {
    Axis axis{row->name, row->title, row->unit, row->pass, row->direction, false};
    if (software && row->pass == "frame") axis.title = "Frame time on the CPU";
    return axis;
  }
  for (const char* subject : kSubjects)
    for (const store::ParameterRow& row : descriptions_.parameters)
      if (row.subject == subject && row.path == name) {
        Axis axis = parameter(row.subject + "." + name);
        axis.name = name;
        return axis;
      }
  Axis axis = parameter("." + name);
  axis.name = name;
  return axis;
}

Axis Names::parameter(const std::string& subjectAndPath) const {
  const auto [subject, path] = splitSubject(subjectAndPath);
  Axis axis{subjectAndPath, "", "", "", Direction::Neither, true};
  std::set<std::string> units;
  for (const store::ParameterRow& row : descriptions_.parameters) {
    if (row.subject != subject || row.path != path) continue;
    if (axis.title.empty()) axis.title = row.title;
    units.insert(row.unit);
  }
  if (units.size() == 1) axis.unit = *units.begin();
  if (!axis.title.empty()) return axis;
  for (const std::string& part : partsOf(path))
    axis.title += (axis.title.empty() ? "" : ": ") + wordsOf(part);
  axis.title = capitalised(axis.title);
  return axis;
}

std::string Names::describe(const std::vector<Setting>& settings) const {
  std::string out;
  std::set<std::string> named;
  for (const Setting& setting : settings) {
    const auto [subject, path] = splitSubject(setting.path);
    const std::string unit = parameter(setting.path).unit;
    std::vector<std::string> parts = partsOf(path);
    const size_t dot = setting.path.rfind('.');
    if (named.count(setting.path.substr(0, dot))) parts = {parts.back()};
    named.insert(setting.path);
    if (!out.empty()) out += ", ";
    for (size_t i = 0; i < parts.size(); ++i)
      out += wordsOf(parts[i], i + 1 == parts.size() ? unit : "") + " ";
    out += setting.value;
    if (!unit.empty()) out += " " + unit;
  }
  return out;
}

std::string Names::heading(const std::string& by) const {
  for (const char* whole : kSubjects)
    if (by == whole) return capitalised(by);
  return axis(by).label();
}

}  // namespace limen::analysis
