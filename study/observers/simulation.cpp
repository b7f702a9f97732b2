// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/simulation.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "experiments/base/yaml_tree.h"

namespace limen::study {
namespace {

using nlohmann::json;
using Condition = std::map<std::string, std::string>;
using Path = std::vector<std::string>;

const std::vector<std::string> kRuleKeys = {
    "theory", "variable", "sigmoid",           "axis",         "direction", "threshold", "level",
    "width",  "slope",    "detected",          "guess",        "lapse",     "severity",  "confidence",
    "rating", "items",    "between_observers", "reaction_time"};

// Position of a key, if the protocol has a text; the path of keys is named in either case.
std::string placeOf(const Protocol& protocol, const Path& path) {
  const std::string keys = path.empty() ? "simulation" : "simulation." + join(path, ".");
  if (protocol.text.empty()) return protocol.path.empty() ? keys : protocol.path + ": " + keys;
  const YamlNode tree = parseYaml(protocol.text, protocol.path);
  const YamlNode* node = tree.find("simulation");
  Mark mark = node ? node->mark : tree.mark;
  for (const std::string& key : path) {
    const YamlNode* next = nullptr;
    if (node && node->kind == YamlNode::Kind::Map) next = node->find(key);
    if (node && node->kind == YamlNode::Kind::List) {
      const size_t index = static_cast<size_t>(std::stoul(key)) - 1;
      if (index < node->items.size()) next = &node->items[index];
    }
    if (!next) break;
    node = next;
    mark = node->mark;
  }
  return location(protocol.path, mark) + ": " + keys;
}

class Layer {
 public:
  Layer(const Protocol& protocol, const json& block, Path path)
      : protocol_(protocol), block_(block), path_(std::move(path)) {
    if (!block_.is_object()) fail({}, "is not a map");
  }

  [[noreturn]] void fail(const std::string& key, const std::string& what,
                         const std::string& hint = {}) const {
    throw Error(what, placeOf(key), hint);
  }
  std::string placeOf(const std::string& key) const {
    Path path = path_;
    if (!key.empty()) path.push_back(key);
    return study::placeOf(protocol_, path);
  }
  void onlyKeys(std::vector<std::string> known) const {
    for (const auto& [key, value] : block_.items())
      if (std::find(known.begin(), known.end(), key) == known.end())
        fail(key, "no key '" + key + "' here", suggest(key, known));
  }
  bool has(const std::string& key) const { return block_.contains(key); }
  const json& at(const std::string& key) const { return block_.at(key); }

  double number(const std::string& key, double otherwise, double minimum, double maximum) const {
    if (!has(key)) return otherwise;
    const json& value = at(key);
    if (!value.is_number()) fail(key, "is not a number");
    const double number = value.get<double>();
    if (!(number >= minimum && number <= maximum))
      fail(key, shortestNumber(number) + " is not from " + shortestNumber(minimum) + " to " +
                    shortestNumber(maximum));
    return number;
  }
  std::string choice(const std::string& key, const std::string& otherwise,
                     const std::vector<std::string>& choices) const {
    if (!has(key)) return otherwise;
    const json& value = at(key);
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
      fail(key, "'" + text + "' is none of " + join(choices), suggest(text, choices));
    return text;
  }
  Expression expression(const std::string& key, bool nameAlone = false) const {
    Expression out;
    const json& value = at(key);
    if (value.is_number()) {
      out.constant = value;
      return out;
    }
    const std::string text = value.is_string() ? value.get<std::string>() : "";
    if (text.empty() || (text[0] != '=' && !nameAlone))
      fail(key, "is neither a number nor an expression", "write \"= ...\" for an expression");
    out.text = text[0] == '=' ? text.substr(1) : text;
    return out;
  }
  std::vector<double> rising(const std::string& key) const {
    const json& value = at(key);
    std::vector<double> out;
    if (!value.is_array()) fail(key, "is not a list of numbers");
    for (const json& entry : value) {
      if (!entry.is_number()) fail(key, "is not a list of numbers");
      out.push_back(entry.get<double>());
      if (out.size() > 1 && !(out.back() > out[out.size() - 2])) fail(key, "is not ascending");
    }
    return out;
  }

 private:
  const Protocol& protocol_;
  const json& block_;
  Path path_;
};

// One description of F replaces another as a whole: a condition may give `detected` while all others have a
// sigmoid.
void overlay(json& rules, const json& layer) {
  if (layer.contains("detected"))
    for (const char* key : {"variable", "threshold", "width", "slope"}) rules.erase(key);
  if (layer.contains("variable") || layer.contains("threshold")) rules.erase("detected");
  if (layer.contains("width")) rules.erase("slope");
  if (layer.contains("slope")) rules.erase("width");
  for (const auto& [key, value] : layer.items()) {
    if (key == "parts" || key == "conditions" || key == "where") continue;
    const bool joined = (key == "between_observers" || key == "reaction_time" || key == "items") &&
                        rules.contains(key) && rules[key].is_object() && value.is_object();
    if (joined)
      rules[key].update(value);
    else
      rules[key] = value;
  }
}

void checkConditions(const Protocol& protocol, const json& block, Path path, const std::vector<Part>& parts) {
  const Layer outer(protocol, block, path);
  if (!outer.has("conditions")) return;
  const json& conditions = outer.at("conditions");
  if (!conditions.is_array()) outer.fail("conditions", "is not a list");
  path.push_back("conditions");
  for (size_t i = 0; i < conditions.size(); ++i) {
    Path here = path;
    here.push_back(std::to_string(i + 1));
    const Layer layer(protocol, conditions[i], here);
    std::vector<std::string> known = kRuleKeys;
    known.push_back("where");
    layer.onlyKeys(known);
    if (!layer.has("where") || !layer.at("where").is_object() || layer.at("where").empty())
      layer.fail({}, "does not say where it applies", "add where: {FACTOR: LEVEL}");
    for (const auto& [name, level] : layer.at("where").items()) {
      std::vector<std::string> factors, levels;
      for (const Part& part : parts)
        for (const Factor& factor : part.factors) {
          factors.push_back(factor.name);
          if (factor.name != name) continue;
          for (const FactorLevel& one : factor.levels) levels.push_back(one.name);
        }
      if (levels.empty()) layer.fail("where", "no factor '" + name + "'", suggest(name, factors));
      const std::string text = level.is_string() ? level.get<std::string>() : level.dump();
      if (std::find(levels.begin(), levels.end(), text) == levels.end())
        layer.fail("where", "factor '" + name + "' has no level '" + text + "'", suggest(text, levels));
    }
  }
}

bool fits(const json& where, const Condition& condition) {
  for (const auto& [name, level] : where.items()) {
    const auto found = condition.find(name);
    const std::string text = level.is_string() ? level.get<std::string>() : level.dump();
    if (found == condition.end() || found->second != text) return false;
  }
  return true;
}

void overlayConditions(json& rules, const json& block, const Condition& condition) {
  if (!block.contains("conditions")) return;
  for (const json& entry : block["conditions"])
    if (fits(entry["where"], condition)) overlay(rules, entry);
}

std::vector<double> bounds(const Layer& layer, const std::string& key, const Scale* scale, double first) {
  const size_t needed = scale && !scale->labels.empty() ? scale->labels.size() - 1 : 0;
  if (!layer.has(key)) {
    std::vector<double> out;
    for (size_t i = 0; i < needed; ++i) out.push_back(first + static_cast<double>(i));
    return out;
  }
  const std::vector<double> out = layer.rising(key);
  if (scale && out.size() != needed)
    layer.fail(key,
               std::to_string(out.size()) + " bounds for a scale of " + std::to_string(needed + 1) + " steps",
               "give " + std::to_string(needed));
  return out;
}

ObserverSpread spreadOf(const Protocol& protocol, const json& rules, const Path& path) {
  ObserverSpread out;
  if (!rules.contains("between_observers")) return out;
  Path here = path;
  here.push_back("between_observers");
  const Layer layer(protocol, rules["between_observers"], here);
  const std::vector<std::pair<std::string, double*>> entries = {
      {"threshold_sd", &out.thresholdSd},    {"threshold_sd_log", &out.thresholdSdLog},
      {"width_sd_log", &out.widthSdLog},     {"strength_sd", &out.strengthSd},
      {"condition_sd", &out.conditionSd},    {"guess_sd_logit", &out.guessSdLogit},
      {"lapse_sd_logit", &out.lapseSdLogit}, {"items_sd", &out.itemsSd}};
  std::vector<std::string> known;
  for (const auto& [name, target] : entries) known.push_back(name);
  layer.onlyKeys(known);
  for (const auto& [name, target] : entries) *target = layer.number(name, 0.0, 0.0, 1e9);
  return out;
}

void readSigmoid(const Layer& layer, SimulationRules& out) {
  out.source = SimulationRules::Source::Sigmoid;
  out.variable = layer.expression("variable", true);
  if (!layer.has("threshold")) layer.fail({}, "has a variable but no threshold", "add threshold: ...");
  out.threshold = layer.expression("threshold");
  if (layer.has("width") == layer.has("slope"))
    layer.fail({}, layer.has("width") ? "has both width and slope" : "has neither width nor slope",
               "give one of them");
  out.widthIsSlope = layer.has("slope");
  out.width = layer.expression(out.widthIsSlope ? "slope" : "width");
  if (out.widthIsSlope && out.spread.widthSdLog > 0.0)
    layer.fail("between_observers", "spreads the width, but a slope is given", "give the width");
  out.family =
      psychometrics::sigmoidFamily(layer.choice("sigmoid", "logistic", psychometrics::sigmoidNames()));
  out.axis = layer.choice("axis", "linear", {"linear", "log"}) == "linear"
                 ? psychometrics::StimulusAxis::Linear
                 : psychometrics::StimulusAxis::Logarithmic;
  out.falling = layer.choice("direction", "rising", {"rising", "falling"}) == "falling";
  out.level = layer.number("level", 0.5, 1e-6, 1.0 - 1e-6);
}

}  // namespace

struct Simulation::Cache {
  std::mutex guard;
  std::map<std::pair<int, Condition>, SimulationRules> rules;
};

double numberOf(const Expression& expression, const Variables& variables, const std::string& where,
                const std::string& file) {
  json value = expression.constant;
  if (!expression.text.empty()) {
    const auto named = variables.find(expression.text);
    value = named != variables.end() ? named->second : evaluate(expression, variables, file);
  }
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw Error("'" + (expression.text.empty() ? value.dump() : expression.text) + "' does not give a number",
                where);
  return value.get<double>();
}

Simulation::Simulation(const Protocol& protocol) : protocol_(protocol), cache_(std::make_unique<Cache>()) {
  const json& block = protocol_.simulation;
  if (!block.is_null()) {
    const Layer top(protocol_, block, {});
    std::vector<std::string> known = kRuleKeys;
    known.insert(known.end(), {"parts", "conditions"});
    top.onlyKeys(known);
    checkConditions(protocol_, block, {}, protocol_.parts);
    if (top.has("parts")) {
      const Layer parts(protocol_, top.at("parts"), {"parts"});
      std::vector<std::string> names;
      for (const Part& part : protocol_.parts) names.push_back(part.name);
      parts.onlyKeys(names);
      for (const Part& part : protocol_.parts) {
        if (!parts.has(part.name)) continue;
        std::vector<std::string> inner = kRuleKeys;
        inner.push_back("conditions");
        const json& own = parts.at(part.name);
        Layer(protocol_, own, {"parts", part.name}).onlyKeys(inner);
        checkConditions(protocol_, own, {"parts", part.name}, {part});
      }
    }
  }
  // Every condition's rules are read once, so that problems are reported before anything runs.
  const Design design = makeDesign(protocol_, 0, 0);
  for (const PlannedBlock& planned : design.blocks)
    for (const PlannedTrial& trial : planned.trials)
      needsModel_ |= rules(trial.part, trial.condition).source == SimulationRules::Source::Model;
}

Simulation::~Simulation() = default;

const SimulationRules& Simulation::rules(int part, const Condition& condition) const {
  const std::scoped_lock lock(cache_->guard);
  const std::pair<int, Condition> key{part, condition};
  const auto found = cache_->rules.find(key);
  if (found != cache_->rules.end()) return found->second;
  return cache_->rules.emplace(key, read(part, condition)).first->second;
}

SimulationRules Simulation::read(int partIndex, const Condition& condition) const {
  const Part& part = protocol_.parts[static_cast<size_t>(partIndex)];
  json merged = json::object();
  Path path;
  if (protocol_.simulation.is_object()) {
    overlay(merged, protocol_.simulation);
    overlayConditions(merged, protocol_.simulation, condition);
    const auto parts = protocol_.simulation.find("parts");
    if (parts != protocol_.simulation.end() && parts->contains(part.name)) {
      path = {"parts", part.name};
      overlay(merged, (*parts)[part.name]);
      overlayConditions(merged, (*parts)[part.name], condition);
    }
  }
  const Layer layer(protocol_, merged, path);
  SimulationRules out;
  out.where = layer.placeOf({});
  out.spread = spreadOf(protocol_, merged, path);
  const bool pairwise = part.task.type == Task::Pairwise;
  out.theory =
      layer.choice("theory", "high_threshold", {"high_threshold", "signal_detection"}) == "high_threshold"
          ? DetectionTheory::HighThreshold
          : DetectionTheory::SignalDetection;
  Expression zero;
  zero.constant = 0.0;
  out.guess = layer.has("guess") ? layer.expression("guess") : zero;
  out.lapse = layer.has("lapse") ? layer.expression("lapse") : zero;
  if (layer.has("items")) {
    if (!layer.at("items").is_object()) layer.fail("items", "is not a map");
    for (const auto& [name, value] : layer.at("items").items()) {
      if (!value.is_number()) layer.fail("items", "value of '" + name + "' is not a number");
      out.items[name] = value.get<double>();
    }
  }
  if (pairwise) {
    out.source = out.items.empty() ? SimulationRules::Source::Model : SimulationRules::Source::Detected;
    if (!out.items.empty())
      for (const Factor& factor : part.factors)
        if (factor.name == part.items)
          for (const FactorLevel& level : factor.levels)
            if (!out.items.count(level.name)) layer.fail("items", "no value for '" + level.name + "'");
  } else if (layer.has("detected")) {
    out.source = SimulationRules::Source::Detected;
    out.detected = layer.expression("detected");
  } else if (layer.has("variable")) {
    readSigmoid(layer, out);
  } else if (layer.has("threshold")) {
    layer.fail("threshold", "has a threshold but no variable", "add variable: NAME");
  }
  out.severity = bounds(layer, "severity", part.task.severity ? &*part.task.severity : nullptr, 1.0);
  out.confidence = bounds(layer, "confidence", part.task.confidence ? &*part.task.confidence : nullptr, 1.0);
  const Scale ratings{"", part.task.answers};
  out.rating = bounds(layer, "rating", part.task.type == Task::Rating ? &ratings : nullptr, 0.0);
  if (!out.rating.empty() && layer.has("rating") && part.task.type == Task::Rating &&
      out.rating.front() != 0.0)
    layer.fail("rating", "does not start with 0", "the first step above the lowest starts at the criterion");
  if (layer.has("reaction_time")) {
    Path here = path;
    here.push_back("reaction_time");
    const Layer times(protocol_, layer.at("reaction_time"), here);
    times.onlyKeys({"median_s", "sd_log"});
    out.reactionMedianS = times.number("median_s", out.reactionMedianS, 0.05, 60.0);
    out.reactionSdLog = times.number("sd_log", out.reactionSdLog, 0.0, 3.0);
  }
  return out;
}

}  // namespace limen::study
