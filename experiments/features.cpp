// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/features.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <regex>

#include "experiments/base/problems.h"
#include "experiments/base/text.h"
#include "experiments/base/yaml_tree.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kKinds = {"contribution", "comparator", "background"};

std::string featuresPath(const std::string& root) {
  return (fs::path(root) / "experiments/features.yaml").string();
}

using TextFields = std::vector<std::pair<std::string, std::string*>>;

/// Text under each key of `node`; `allowed` lists further permitted keys.
void readTexts(const YamlNode& node, const TextFields& keys, const std::vector<std::string>& allowed,
               const std::string& what, Problems& problems) {
  std::vector<std::string> known = allowed;
  for (const auto& [key, target] : keys) {
    known.push_back(key);
    const YamlNode* value = node.find(key);
    if (value && value->kind == YamlNode::Kind::Scalar)
      *target = value->text;
    else
      problems.add(node.mark, "'" + key + "' of " + what + " is missing", "give it: text");
  }
  for (const auto& [key, value] : node.members)
    if (std::find(known.begin(), known.end(), key.text) == known.end())
      problems.add(key.mark, "unknown key '" + key.text + "' of " + what,
                   problems.crowded() ? "" : suggest(key.text, known));
}

std::vector<NotBuilt> readNotBuilt(const YamlNode& node, Problems& problems) {
  std::vector<NotBuilt> out;
  if (node.kind != YamlNode::Kind::List || node.items.empty())
    problems.add(node.mark, "'not_built' is not a list of methods",
                 "write a list: - {method: ..., section: ..., reason: ...}");
  for (const YamlNode& item : node.items) {
    NotBuilt& one = out.emplace_back();
    readTexts(item, {{"method", &one.method}, {"section", &one.section}, {"reason", &one.reason}}, {},
              "a method that is not built", problems);
  }
  return out;
}

Feature readFeature(const YamlNode& node, Problems& problems) {
  Feature feature;
  readTexts(node,
            {{"id", &feature.id},
             {"name", &feature.name},
             {"source", &feature.source},
             {"section", &feature.section},
             {"kind", &feature.kind}},
            {"not_built"}, "a feature", problems);
  if (const YamlNode* list = node.find("not_built")) feature.notBuilt = readNotBuilt(*list, problems);
  static const std::regex idForm("[A-Z]{1,3}-[0-9]{2}");
  if (!std::regex_match(feature.id, idForm))
    problems.add(node.mark, "'" + feature.id + "' is not a feature id", "ids look like SS-12");
  if (std::find(kKinds.begin(), kKinds.end(), feature.kind) == kKinds.end())
    problems.add(node.mark, "'kind' is '" + feature.kind + "'", suggest(feature.kind, kKinds));
  return feature;
}

std::vector<fs::path> descriptorsBelow(const fs::path& folder) {
  std::vector<fs::path> out;
  if (!fs::is_directory(folder)) return out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() &&
        (entry.path().extension() == ".yaml" || entry.path().extension() == ".yml"))
      out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

std::vector<Feature> readFeatures(const std::string& path) {
  const YamlNode root = parseYaml(readTextFile(path), path);
  Problems problems(path);
  std::vector<Feature> out;
  std::set<std::string> seen;
  if (root.kind != YamlNode::Kind::List)
    problems.add(root.mark, "the file holds " + root.describe(), "a list of features");
  for (const YamlNode& node : root.items) {
    if (node.kind != YamlNode::Kind::Map) {
      problems.add(node.mark, "a feature is " + node.describe(), "write it as a map: {id: ..., name: ...}");
      continue;
    }
    out.push_back(readFeature(node, problems));
    if (!seen.insert(out.back().id).second)
      problems.add(node.mark, "feature '" + out.back().id + "' is given twice");
  }
  problems.throwIfAny();
  return out;
}

std::set<std::string> knownFeatures(const std::string& root) {
  std::set<std::string> out;
  if (!fs::exists(featuresPath(root))) return out;
  for (const Feature& feature : readFeatures(featuresPath(root))) out.insert(feature.id);
  return out;
}

Coverage readCoverage(const std::string& root) {
  Coverage coverage;
  coverage.features = readFeatures(featuresPath(root));
  std::vector<std::string> ids;
  for (const Feature& feature : coverage.features) ids.push_back(feature.id);
  for (const fs::path& path : descriptorsBelow(fs::path(root) / "experiments/descriptors")) {
    const YamlNode node = parseYaml(readTextFile(path.string()), path.string());
    ++coverage.descriptorCount;
    const YamlNode* list = node.find("features");
    if (!list) continue;
    Problems problems(path.string());
    for (const YamlNode& item : list->items) {
      if (std::find(ids.begin(), ids.end(), item.text) == ids.end())
        problems.add(item.mark, "unknown feature " + item.describe(), suggest(item.text, ids));
      else
        coverage.descriptors[item.text].push_back(fs::relative(path, root).string());
    }
    problems.throwIfAny();
  }
  return coverage;
}

namespace {

struct Count {
  size_t covered = 0, all = 0;
};

std::map<std::string, Count> countBy(const Coverage& coverage,
                                     const std::function<std::string(const Feature&)>& group) {
  std::map<std::string, Count> out;
  for (const Feature& feature : coverage.features) {
    Count& count = out[group(feature)];
    ++count.all;
    count.covered += coverage.covers(feature) ? 1 : 0;
  }
  return out;
}

std::string countLine(const std::map<std::string, Count>& counts) {
  std::vector<std::string> parts;
  for (const auto& [name, count] : counts)
    parts.push_back(fmt::format("{} {}/{}", name, count.covered, count.all));
  return join(parts);
}

std::string familyOf(const Feature& feature) { return feature.family(); }
std::string kindOf(const Feature& feature) { return feature.kind; }

}  // namespace

std::string describe(const Coverage& coverage) {
  std::string covered, uncovered, surveyed;
  size_t surveyedCount = 0;
  for (const Feature& feature : coverage.features) {
    const std::string line =
        fmt::format("  {:<7} {:<12}  {} ({})\n", feature.id, feature.kind, feature.name, feature.source);
    if (coverage.isOnlySurveyed(feature)) {
      ++surveyedCount;
      surveyed += line;
      for (const NotBuilt& one : feature.notBuilt)
        surveyed += fmt::format("          {} (section {}): {}\n", one.method, one.section, one.reason);
      continue;
    }
    if (!coverage.covers(feature)) {
      uncovered += line;
      continue;
    }
    covered += line;
    for (const std::string& path : coverage.descriptors.at(feature.id)) covered += "          " + path + "\n";
    for (const NotBuilt& one : feature.notBuilt)
      covered +=
          fmt::format("          not built: {} (section {}): {}\n", one.method, one.section, one.reason);
  }
  return fmt::format(
      "covered:\n{}surveyed only, not built:\n{}not covered:\n{}{} of {} features are covered by {} "
      "descriptors, {} "
      "more are surveyed only\nby kind: {}\nby family: {}\n",
      covered.empty() ? "  none\n" : covered, surveyed.empty() ? "  none\n" : surveyed,
      uncovered.empty() ? "  none\n" : uncovered, coverage.descriptors.size(), coverage.features.size(),
      coverage.descriptorCount, surveyedCount, countLine(countBy(coverage, kindOf)),
      countLine(countBy(coverage, familyOf)));
}

std::vector<nlohmann::json> toJsonLines(const Coverage& coverage) {
  std::vector<nlohmann::json> out;
  nlohmann::json uncovered = nlohmann::json::array(), surveyed = nlohmann::json::array();
  for (const Feature& feature : coverage.features) {
    nlohmann::json paths = nlohmann::json::array();
    if (coverage.covers(feature))
      paths = coverage.descriptors.at(feature.id);
    else if (coverage.isOnlySurveyed(feature))
      surveyed.push_back(feature.id);
    else
      uncovered.push_back(feature.id);
    nlohmann::json notBuilt = nlohmann::json::array();
    for (const NotBuilt& one : feature.notBuilt)
      notBuilt.push_back({{"method", one.method}, {"section", one.section}, {"reason", one.reason}});
    out.push_back({{"id", feature.id},
                   {"name", feature.name},
                   {"source", feature.source},
                   {"section", feature.section},
                   {"kind", feature.kind},
                   {"descriptors", paths},
                   {"not_built", notBuilt}});
  }
  const auto counts = [](const std::map<std::string, Count>& groups) {
    nlohmann::json json = nlohmann::json::object();
    for (const auto& [name, count] : groups) json[name] = {{"covered", count.covered}, {"all", count.all}};
    return json;
  };
  out.push_back({{"features", coverage.features.size()},
                 {"covered", coverage.descriptors.size()},
                 {"descriptors", coverage.descriptorCount},
                 {"by_kind", counts(countBy(coverage, kindOf))},
                 {"by_family", counts(countBy(coverage, familyOf))},
                 {"surveyed_only", surveyed},
                 {"uncovered", uncovered}});
  return out;
}

}  // namespace limen::experiments
