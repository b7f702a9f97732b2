// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/model_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "experiments/base/build_facts.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/command/commands.h"

namespace limen::perception {
namespace {

constexpr size_t kMostNumbers = 10000;

bool parse(const std::string& text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    if (c == separator)
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

ParameterValue readValue(const Parameter& parameter, const std::string& text) {
  if (parameter.type == ParameterType::Boolean) {
    if (text == "true" || text == "on" || text == "1") return true;
    if (text == "false" || text == "off" || text == "0") return false;
  }
  double number = 0.0;
  if (parse(text, number)) {
    if (parameter.type == ParameterType::Integer && number == std::trunc(number) && std::abs(number) < 9e15)
      return static_cast<int64_t>(number);
    if (parameter.type == ParameterType::Real) return number;
  }
  return text;
}

std::string optionName(std::string constant) {
  std::replace(constant.begin(), constant.end(), '_', '-');
  return "--" + constant;
}

}  // namespace

void addModelCommands(CLI::App& app, int&) {
  addCsfCommand(app);
  addCsfErrorCommand(app);
  addTviCommand(app);
  addMaskingCommand(app);
  addDisplayCommand(app);
}

std::vector<double> readNumbers(const std::string& text, const std::string& option) {
  const std::string hint = "give a number, several as 1,2,4 or a range as low:high:count";
  std::vector<double> out;
  for (const std::string& part : split(text, ',')) {
    const std::vector<std::string> ends = split(part, ':');
    double low = 0.0, high = 0.0, count = 0.0;
    if (ends.size() == 1 && parse(ends[0], low)) {
      out.push_back(low);
      continue;
    }
    if (ends.size() != 3 || !parse(ends[0], low) || !parse(ends[1], high) || !parse(ends[2], count))
      throw Error("'" + part + "' is not a number", option, hint);
    if (!(low > 0.0) || !(high > low) || count != std::trunc(count) || count < 2.0 ||
        count > static_cast<double>(kMostNumbers))
      throw Error("range '" + part + "' is empty", option, "give 0 < low < high and a count from 2 to 10000");
    for (int i = 0; i < static_cast<int>(count); ++i)
      out.push_back(i + 1 == static_cast<int>(count) ? high : low * std::pow(high / low, i / (count - 1.0)));
  }
  if (out.size() > kMostNumbers) throw Error("too many values", option, "give at most 10000");
  return out;
}

double readNumber(const std::string& text, const std::string& option) {
  const std::vector<double> numbers = readNumbers(text, option);
  if (numbers.size() == 1) return numbers[0];
  throw Error("several values", option, "give one");
}

std::string optionOf(const std::string& argument) { return "--" + argument.substr(0, argument.find('_')); }

void PointOptions::add(CLI::App& command) {
  static const std::map<std::string, std::string> kHelp = {
      {"frequency_cpd", "spatial frequency [cpd]"},
      {"velocity_deg_s", "retinal velocity [deg/s]; 0.15: the drift of a fixating eye"},
      {"luminance_cd_m2", "adaptation luminance [cd/m2]"},
      {"area_deg2", "area of the stimulus [deg2]"},
      {"width_deg", "angular width of the display [deg]"},
      {"orientation_deg", "orientation of the grating [deg]; 0: along an axis"},
      {"eccentricity_deg", "distance from the centre of gaze [deg]"},
      {"distance_m", "distance of the viewer [m]"}};
  const CsfPoint defaults;
  for (const std::string& argument : csfArgumentNames())
    command.add_option(optionOf(argument), given[argument], kHelp.at(argument))
        ->type_name("NUMBERS")
        ->default_str(shortestNumber(argumentOf(defaults, argument)));
}

std::vector<double> PointOptions::values(const std::string& argument) const {
  if (!has(argument)) return {argumentOf(CsfPoint(), argument)};
  return readNumbers(text(argument), optionOf(argument));
}

CsfPoint PointOptions::point() const {
  CsfPoint out;
  for (const auto& [argument, numbers] : given)
    if (const std::vector<double> list = values(argument); list.size() == 1)
      argumentOf(out, argument) = list[0];
  return out;
}

void ConstantOptions::add(CLI::App& command, const std::vector<std::vector<Parameter>>& declared) {
  command.add_option("--set", set, "constant of the model, as name=value; --name value does the same")
      ->type_name("NAME=VALUE")
      ->take_all();
  for (const std::vector<Parameter>& list : declared)
    for (const Parameter& parameter : list) {
      if (parameter.type == ParameterType::Group || given.count(parameter.name) != 0) continue;
      const std::string option = optionName(parameter.name);
      if (command.get_option_no_throw(option) != nullptr) continue;  // --set reaches it
      command.add_option(option, given[parameter.name])->group("");
    }
}

bool ConstantOptions::empty() const {
  return set.empty() &&
         std::all_of(given.begin(), given.end(), [](const auto& one) { return one.second.empty(); });
}

std::map<std::string, ParameterValue> ConstantOptions::read(const std::vector<Parameter>& declared,
                                                            const std::string& model) const {
  std::vector<std::string> names;
  const std::vector<DeclaredAt> known = flatten(declared);
  for (const DeclaredAt& at : known) names.push_back(at.path);
  std::map<std::string, ParameterValue> out;
  const auto take = [&](std::string name, const std::string& text, const std::string& place) {
    std::replace(name.begin(), name.end(), '-', '_');
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const DeclaredAt& at) { return at.path == name; });
    if (found == known.end())
      throw Error("'" + name + "' is not a constant of " + model, place,
                  names.empty() ? "it has none" : suggest(name, names));
    if (!out.emplace(name, validate(*found->parameter, readValue(*found->parameter, text), place)).second)
      throw Error("'" + name + "' is given twice", place, "keep one");
  };
  for (const std::string& one : set) {
    const size_t equals = one.find('=');
    if (equals == std::string::npos) throw Error("'" + one + "' has no value", "--set", "write name=value");
    take(one.substr(0, equals), one.substr(equals + 1), "--set");
  }
  for (const auto& [name, text] : given)
    if (!text.empty()) take(name, text, optionName(name));
  return out;
}

void refuseExtras(const CLI::App& command) {
  const std::vector<std::string> extra = command.remaining();
  if (extra.empty()) return;
  const std::string option = extra[0].substr(0, extra[0].find('='));
  std::vector<std::string> known;
  for (const CLI::Option* one : command.get_options())
    if (!one->get_lnames().empty()) known.push_back("--" + one->get_lnames()[0]);
  const std::string nearest = nearestName(option, known);
  throw Error("does not know " + option, command.get_name(),
              nearest.empty() ? "--help shows the options" : "did you mean " + nearest + "?");
}

std::string describeConstants(const std::vector<Parameter>& declared) {
  std::string out;
  for (const Parameter& parameter : declared) {
    const std::string option = optionName(parameter.name);
    out +=
        fmt::format("  {:<28} {}{}; default {}{}\n", option, parameter.description,
                    parameter.unit.empty() ? "" : " [" + parameter.unit + "]", toText(parameter.defaultValue),
                    parameter.source.empty() ? "" : " (" + parameter.source + ")");
  }
  return out;
}

void printJson(nlohmann::json object) {
  object["version"] = projectVersion();
  object["commit"] = buildCommit();
  std::printf("%s\n", object.dump().c_str());
}

std::string readable(double value) {
  if (value != 0.0 && (std::abs(value) >= 1e6 || std::abs(value) < 1e-3)) return fmt::format("{:.4e}", value);
  return fmt::format("{:.6g}", value);
}

}  // namespace limen::perception
