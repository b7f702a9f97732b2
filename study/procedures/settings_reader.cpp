// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/settings_reader.h"

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::study {
namespace {

using nlohmann::json;

std::string describeRange(double minimum, double maximum, bool open) {
  std::string out = "give a number";
  if (std::isfinite(minimum)) out += (open ? " above " : " of at least ") + shortestNumber(minimum);
  if (std::isfinite(maximum)) {
    out += (std::isfinite(minimum) ? " and " : " ") + std::string(open ? "below " : "at most ") +
           shortestNumber(maximum);
  }
  return out;
}

double checkedNumber(const json& value, const std::string& where, double minimum, double maximum, bool open) {
  const std::string allowed = describeRange(minimum, maximum, open);
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw Error("found " + value.dump(), where, allowed);
  }
  const double number = value.get<double>();
  const bool inside = open ? number > minimum && number < maximum : number >= minimum && number <= maximum;
  if (!inside) throw Error(shortestNumber(number) + " is out of range", where, allowed);
  return number;
}

int checkedInteger(const json& value, const std::string& where, int minimum, int maximum) {
  const bool fits =
      value.is_number_integer() && value.get<double>() >= minimum && value.get<double>() <= maximum;
  if (!fits) {
    throw Error("found " + value.dump(), where,
                "give a whole number from " + std::to_string(minimum) + " to " + std::to_string(maximum));
  }
  return value.get<int>();
}

}  // namespace

SettingsReader::SettingsReader(const json& settings, std::string where)
    : settings_(settings), where_(std::move(where)) {
  if (!settings_.is_object()) throw Error("found " + settings_.dump(), where_, "give keys with values");
}

bool SettingsReader::has(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return settings_.contains(key);
}

const json& SettingsReader::required(const std::string& key, const std::string& allowed) {
  if (!has(key)) throw Error("'" + key + "' is missing", where_, "give " + allowed);
  return settings_.at(key);
}

double SettingsReader::number(const std::string& key, double minimum, double maximum, bool open) {
  return checkedNumber(required(key, "a number"), at(key), minimum, maximum, open);
}

double SettingsReader::numberOr(const std::string& key, double otherwise, double minimum, double maximum,
                                bool open) {
  return has(key) ? number(key, minimum, maximum, open) : otherwise;
}

int SettingsReader::integer(const std::string& key, int minimum, int maximum) {
  return checkedInteger(required(key, "a whole number"), at(key), minimum, maximum);
}

int SettingsReader::integerOr(const std::string& key, int otherwise, int minimum, int maximum) {
  return has(key) ? integer(key, minimum, maximum) : otherwise;
}

std::string SettingsReader::textOr(const std::string& key, const std::string& otherwise) {
  if (!has(key)) return otherwise;
  const json& value = settings_.at(key);
  if (!value.is_string()) throw Error("found " + value.dump(), at(key), "give a text");
  return value.get<std::string>();
}

std::string SettingsReader::choiceOr(const std::string& key, const std::string& otherwise,
                                     const std::vector<std::string>& choices) {
  const std::string value = textOr(key, otherwise);
  if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
    throw Error("'" + value + "' is not one of the choices", at(key), suggest(value, choices));
  }
  return value;
}

void SettingsReader::finish() const {
  for (const auto& [key, value] : settings_.items()) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
      throw Error("unknown key '" + key + "'", where_, suggest(key, known_));
    }
  }
}

std::vector<psychometrics::GridAxis> readStimulusAxes(const json& source, const std::string& where) {
  std::vector<psychometrics::GridAxis> axes;
  const bool list = source.is_array() && !source.empty() && source.front().is_object();
  const size_t count = list ? source.size() : 1;
  for (size_t i = 0; i < count; ++i) {
    json entry = list ? source[i] : source;
    const std::string place = list ? where + "[" + std::to_string(i) + "]" : where;
    std::string name = "stimulus";
    if (entry.is_object() && entry.contains("name")) {
      if (!entry["name"].is_string() || entry["name"].get<std::string>().empty()) {
        throw Error("the name of a stimulus dimension is not a text", place + ".name", "give a text");
      }
      name = entry["name"].get<std::string>();
      entry.erase("name");
    } else if (count > 1) {
      throw Error("'name' is missing", place, "name every dimension of the stimulus");
    }
    for (const psychometrics::GridAxis& other : axes) {
      if (other.name == name) throw Error("two dimensions are named '" + name + "'", place + ".name");
    }
    axes.push_back(psychometrics::readAxis(entry, name, place));
  }
  return axes;
}

json toJson(const std::vector<psychometrics::GridAxis>& axes) {
  json out = json::array();
  for (const psychometrics::GridAxis& axis : axes) {
    json entry = psychometrics::toJson(axis);
    entry["name"] = axis.name;
    out.push_back(entry);
  }
  return out;
}

StopRule readStop(SettingsReader& reader, const std::vector<std::string>& allowed) {
  const json& settings = reader.required("stop", "{" + join(allowed) + "}, at least one of them");
  SettingsReader stop(settings, reader.at("stop"));
  StopRule rule;
  const auto may = [&](const char* key) {
    return std::find(allowed.begin(), allowed.end(), key) != allowed.end() && stop.has(key);
  };
  if (may("trials")) rule.trials = stop.integer("trials", 1, 1'000'000);
  if (may("reversals")) rule.reversals = stop.integer("reversals", 1, 1'000'000);
  if (may("entropy")) rule.entropy = stop.number("entropy", 0.0, SettingsReader::kNoLimit, true);
  if (may("sd")) rule.sd = stop.number("sd", 0.0, SettingsReader::kNoLimit, true);
  stop.finish();
  if (settings.empty())
    throw Error("there is no stopping rule", stop.where(), "give one of " + join(allowed));
  return rule;
}

json toJson(const StopRule& stop) {
  json out = json::object();
  if (stop.trials > 0) out["trials"] = stop.trials;
  if (stop.reversals > 0) out["reversals"] = stop.reversals;
  if (stop.entropy > 0.0) out["entropy"] = stop.entropy;
  if (stop.sd > 0.0) out["sd"] = stop.sd;
  return out;
}

void checkTrial(const std::vector<double>& stimulus, int outcome, size_t dimensions, int outcomes) {
  if (stimulus.size() != dimensions) {
    throw Error("the trial's stimulus has " + std::to_string(stimulus.size()) + " values", {},
                "the procedure has " + std::to_string(dimensions));
  }
  for (double value : stimulus) {
    if (!std::isfinite(value)) throw Error("a value of the trial's stimulus is not finite");
  }
  if (outcome < 0 || outcome >= outcomes) {
    throw Error("no outcome " + std::to_string(outcome), {},
                "outcomes go from 0 to " + std::to_string(outcomes - 1));
  }
}

}  // namespace limen::study
