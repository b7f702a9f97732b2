// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/catalogue_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::experiments {
namespace {

struct NamedKind {
  const char* plural;
  const char* singular;
  const CatalogueKind* entries;
};

std::array<NamedKind, 3> kinds(const Catalogue& catalogue) {
  return {{{"scenes", "scene", &catalogue.scenes},
           {"techniques", "technique", &catalogue.techniques},
           {"metrics", "metric", &catalogue.metrics}}};
}

std::string summaryLine(const std::string& name, const CatalogueEntry& entry, size_t width) {
  return fmt::format("  {:<{}}  {}{}\n", name, width, entry.summary, entry.reference ? " (reference)" : "");
}

std::string describeKind(const NamedKind& kind) {
  std::string out = std::string(kind.plural) + ":\n";
  size_t width = 0;
  for (const auto& [name, entry] : *kind.entries) width = std::max(width, name.size());
  for (const auto& [name, entry] : *kind.entries) out += summaryLine(name, entry, width);
  if (kind.entries->empty()) out += "  none\n";
  return out;
}

std::string describeParameters(const std::vector<Parameter>& parameters, size_t indent);

std::string describeAlternatives(const Parameter& parameter, size_t indent) {
  if (parameter.type == ParameterType::Group)
    return describeParameters(parameter.alternatives.at(0).parameters, indent + 2);
  std::string out;
  for (const Alternative& alternative : parameter.alternatives) {
    out += fmt::format("{:{}}{}", "", indent + 2, "kind: " + alternative.name);
    if (!alternative.description.empty()) out += ", " + alternative.description;
    out += "\n" + describeParameters(alternative.parameters, indent + 4);
  }
  return out;
}

std::string describeParameters(const std::vector<Parameter>& parameters, size_t indent) {
  std::string out;
  for (const Parameter& parameter : parameters) {
    const std::string start(indent, ' ');
    out += start + parameter.name;
    if (parameter.type != ParameterType::Group)
      out += fmt::format(": {}; {}", describeRange(parameter),
                         parameter.required ? "must be given" : "default " + toText(parameter.defaultValue));
    out += fmt::format("\n{}  {}\n", start, parameter.description);
    if (!parameter.source.empty()) out += fmt::format("{}  source: {}\n", start, parameter.source);
    if (!parameter.shorthand.empty())
      out += fmt::format("{0}  a number in its place sets: {1}\n", start, parameter.shorthand);
    out += describeAlternatives(parameter, indent);
  }
  return out;
}

std::string describeEntry(const NamedKind& kind, const std::string& name, const CatalogueEntry& entry) {
  std::string out =
      fmt::format("{} {}, version {}\n  {}\n", kind.singular, name, entry.version, entry.summary);
  if (!entry.source.empty()) out += fmt::format("  source: {}\n", entry.source);
  if (!entry.product.empty()) out += fmt::format("  product: {}\n", entry.product);
  if (!entry.needs.empty()) out += fmt::format("  needs a scene with: {}\n", join(entry.needs));
  if (!entry.quantity.unit.empty()) out += fmt::format("  unit: {}\n", entry.quantity.unit);
  if (entry.reference) out += "  a reference for comparison\n";
  if (entry.onCpu) out += "  works on the CPU at least in part: its times are wall times\n";
  if (!entry.counters.empty()) out += "  counts:\n";
  for (const Quantity& counter : entry.counters)
    out += fmt::format("    {}: {}\n", counter.name, titleWithUnit(titleOf(counter), counter.unit));
  if (entry.parameters.empty()) return out + "  no parameters\n";
  out += "  parameters:\n";
  return out + describeParameters(entry.parameters, 4);
}

nlohmann::json entryAsJson(const NamedKind& kind, const std::string& name, const CatalogueEntry& entry) {
  nlohmann::json out = {{"kind", kind.singular},    {"name", name},
                        {"version", entry.version}, {"summary", entry.summary},
                        {"source", entry.source},   {"parameters", nlohmann::json::array()}};
  for (const Parameter& parameter : entry.parameters) out["parameters"].push_back(toJson(parameter));
  if (!entry.product.empty()) {
    out["product"] = entry.product;
    out["needs"] = entry.needs;
    out["reference"] = entry.reference;
    out["on_cpu"] = entry.onCpu;
    out["counters"] = nlohmann::json::array();
    for (const Quantity& counter : entry.counters)
      out["counters"].push_back({{"name", counter.name},
                                 {"title", titleOf(counter)},
                                 {"unit", counter.unit},
                                 {"direction", toText(counter.direction)}});
  }
  if (!entry.quantity.unit.empty()) out["unit"] = entry.quantity.unit;
  return out;
}

Error unknownWord(const Catalogue& catalogue, const std::string& what) {
  std::vector<std::string> known;
  for (const NamedKind& kind : kinds(catalogue)) {
    known.emplace_back(kind.plural);
    for (const auto& [name, entry] : *kind.entries) known.push_back(name);
  }
  return Error("nothing is called '" + what + "'", "--list", suggest(what, known));
}

}  // namespace

std::string describe(const Catalogue& catalogue, const std::string& what) {
  std::string out;
  for (const NamedKind& kind : kinds(catalogue)) {
    if (what.empty() || what == kind.plural) out += describeKind(kind);
    const auto entry = kind.entries->find(what);
    if (entry != kind.entries->end()) out += describeEntry(kind, what, entry->second);
  }
  if (out.empty()) throw unknownWord(catalogue, what);
  return out;
}

nlohmann::json describeAsJson(const Catalogue& catalogue, const std::string& what) {
  nlohmann::json out = nlohmann::json::array();
  bool found = what.empty();
  for (const NamedKind& kind : kinds(catalogue)) {
    found = found || what == kind.plural;
    for (const auto& [name, entry] : *kind.entries)
      if (what.empty() || what == kind.plural || what == name) out.push_back(entryAsJson(kind, name, entry));
  }
  if (out.empty() && !found) throw unknownWord(catalogue, what);
  return out;
}

}  // namespace limen::experiments
