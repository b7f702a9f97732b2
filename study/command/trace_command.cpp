// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/text.h"
#include "experiments/base/yaml_tree.h"
#include "study/command/commands.h"
#include "study/procedures/trace.h"
#include "study/protocol/expression.h"

namespace limen::study {
namespace {

using nlohmann::json;

struct TraceOptions {
  std::string procedure, answers, answersFile;
  uint64_t seed = 0;
  bool asJson = false, list = false;
};

json readSettings(const std::string& path) {
  protectInput(path);
  const std::string text = readTextFile(path);
  json settings;
  const size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '{') {
    try {
      settings = json::parse(text);
    } catch (const json::exception& error) {
      throw Error(std::string("is not JSON: ") + error.what(), path);
    }
  } else {
    settings = toJson(parseYaml(text, path));
  }
  // A protocol has the settings below this key; a file may too.
  if (settings.is_object() && settings.size() == 1 && settings.contains("procedure"))
    settings = settings["procedure"];
  return settings;
}

// Lines "stimulus,stimulus:outcome" in the form that readAnswers() takes.
std::string withSlashes(const std::string& text) {
  std::string out, line;
  for (const char c : text + "\n") {
    line += c;
    if (c != '\n') continue;
    const size_t colon = line.find(':');
    if (colon != std::string::npos && line.find(':', colon + 1) == std::string::npos)
      for (size_t i = 0; i < colon; ++i)
        if (line[i] == ',') line[i] = '/';
    out += line;
    line.clear();
  }
  return out;
}

std::string shortNumber(const json& value) {
  return value.is_null() ? "-" : fmt::format("{:.5g}", value.get<double>());
}

std::string shortList(const json& values) {
  std::vector<std::string> out;
  for (const json& value : values) out.push_back(shortNumber(value));
  return join(out, ", ");
}

std::string estimateText(const json& estimate) {
  std::vector<std::string> out;
  for (const json& parameter : estimate["parameters"])
    out.push_back(fmt::format("{} {} ({} to {})", parameter["name"].get<std::string>(),
                              shortNumber(parameter["mean"]), shortNumber(parameter["low"]),
                              shortNumber(parameter["high"])));
  return out.empty() ? "-" : join(out, "; ");
}

void printTrace(const json& result) {
  const json& procedure = result["procedure"];
  std::cout << "procedure: " << procedure["type"].get<std::string>() << ", seed "
            << result["seed"].get<std::string>() << '\n';
  if (!result["trials"].empty()) {
    const json& last = result["trials"].back()["estimate"];
    std::cout << fmt::format("estimates: mean, and {} at {:g} %\n", last["kind"].get<std::string>(),
                             100.0 * last["level"].get<double>());
  }
  std::cout << fmt::format("{:>5}  {:>14}  {:>7}  {}\n", "trial", "stimulus", "outcome", "estimates");
  for (const json& trial : result["trials"]) {
    const bool other = trial["proposed"] != trial["stimulus"];
    std::cout << fmt::format(
        "{:>5}  {:>14}  {:>7}  {}{}\n", trial["trial"].get<int>(), shortList(trial["stimulus"]),
        trial["outcome"].get<int>(), estimateText(trial["estimate"]),
        !other                        ? ""
        : trial["proposed"].is_null() ? "  [after the end]"
                                      : "  [asked for " + shortList(trial["proposed"]) + "]");
  }
  std::cout << "next: "
            << (result["next"].is_null() ? "none, the procedure has ended" : shortList(result["next"]))
            << '\n';
}

void runTrace(const TraceOptions& options) {
  if (options.list) {
    std::cout << describeProcedures();
    return;
  }
  if (options.procedure.empty())
    throw Error("no procedure given", "trace", "give a YAML or JSON file, or --list");
  if (options.answers.empty() == options.answersFile.empty())
    throw Error("answers are missing", "trace", "give either --answers or --answers-file");
  const std::vector<TraceAnswer> answers =
      options.answersFile.empty()
          ? readAnswers(options.answers, "--answers")
          : readAnswers(withSlashes(readTextFile(options.answersFile)), options.answersFile);
  const json result = trace(readSettings(options.procedure), options.seed, answers, options.procedure);
  if (options.asJson)
    std::cout << result.dump(2) << '\n';
  else
    printTrace(result);
}

}  // namespace

void addTraceCommand(CLI::App& app, Run& /*run*/) {
  CLI::App* command =
      app.add_subcommand("trace", "Runs a procedure on given answers and prints it trial by trial.");
  auto options = std::make_shared<TraceOptions>();
  command->add_option("procedure", options->procedure,
                      "YAML or JSON file with the settings that a protocol has under `procedure:`");
  command->add_option("--answers", options->answers,
                      "outcomes in order: 1,0,1; or with stimuli: -18:1 -22:0");
  command->add_option(
      "--answers-file", options->answersFile,
      "file with one answer per line: OUTCOME or STIMULUS[,STIMULUS2...]:OUTCOME; # starts a comment");
  command->add_option("--seed", options->seed, "seed of the procedure")->capture_default_str();
  command->add_flag("--json", options->asJson, "everything, with the procedure's state after each trial");
  command->add_flag("--list", options->list, "types of procedure and their settings");
  command->callback([options] { runTrace(*options); });
}

}  // namespace limen::study
