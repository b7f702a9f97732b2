// SPDX-License-Identifier: BSD-3-Clause
// limen analyse rates, anova, sdt, validate: what the sessions of a study say.
#include "analysis/commands/commands.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/study/anova.h"
#include "analysis/study/answers.h"
#include "analysis/study/head.h"
#include "analysis/study/rates.h"
#include "analysis/study/sensitivity.h"
#include "analysis/study/validation.h"
#include "base/error.h"

namespace limen::analysis {
namespace {

struct StudyOptions {
  StudyChoice choice;
  bool noExclusions = false, asJson = false;
  std::string csv;
};

struct ValidateOptions : StudyOptions {
  ValidationSetting setting;
  std::string guess = "catch", lapse = "free";
  std::vector<double> coverageEdges, ratingEdges;
};

void addCommon(CLI::App& command, StudyOptions& options) {
  command.add_option("store", options.choice.store, "Result store with sessions")->required();
  command.add_option("--protocol", options.choice.protocol,
                     "Name, or first digits of the SHA-256, if the store has several");
  static const std::map<std::string, Observers> kObservers = {{"people", Observers::People},
                                                              {"simulated", Observers::Simulated}};
  command
      .add_option("--observers", options.choice.observers,
                  "people or simulated, if the store has sessions of both")
      ->transform(CLI::CheckedTransformer(kObservers));
  command.add_flag("--no-exclusions", options.noExclusions,
                   "Do not apply the exclusion rules that the protocol declares");
  command.add_flag("--unfinished", options.choice.unfinished, "Take broken-off sessions too");
  command.add_flag("--json", options.asJson, "One JSON object");
  command.add_option("--csv", options.csv, "Writes a table to this file")->type_name("FILE");
}

StudyAnswers read(const StudyOptions& options) {
  StudyChoice choice = options.choice;
  choice.exclusions = !options.noExclusions;
  return readStudyAnswers(choice);
}

/// Every result opens with what the answers are and what was left out.
template <class Result>
void print(const StudyOptions& options, const StudyAnswers& study, const Result& result,
           const std::string& name) {
  if (!options.csv.empty()) writeFileBytes(options.csv, toCsv(result));
  if (options.asJson) {
    nlohmann::json out = headJson(study);
    out[name] = toJson(result);
    std::printf("%s\n", out.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else {
    std::printf("%s%s", headText(study).c_str(), toText(result).c_str());
  }
}

/// A rate from 0 to below 1.
double rateOf(const std::string& text, const std::string& option, const std::string& words) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= 0.0 && value < 1.0))
    throw Error("'" + text + "' is no rate", option, "give a number from 0 to below 1, or " + words);
  return value;
}

std::array<double, 3> edgesOf(const std::vector<double>& values, const std::array<double, 3>& otherwise,
                              const std::string& option) {
  if (values.empty()) return otherwise;
  if (values.size() != 3) throw Error("four levels have three edges", option, "give three numbers: 1,2,3");
  return {values[0], values[1], values[2]};
}

void validate(const ValidateOptions& options) {
  ValidationSetting setting = options.setting;
  setting.bins.coverage = edgesOf(options.coverageEdges, setting.bins.coverage, "--coverage-edges");
  setting.bins.rating = edgesOf(options.ratingEdges, setting.bins.rating, "--rating-edges");
  setting.fitGuess = options.guess == "free";
  if (options.guess != "free" && options.guess != "catch")
    setting.guess = rateOf(options.guess, "--guess", "'catch' or 'free'");
  if (options.lapse != "free") setting.lapse = rateOf(options.lapse, "--lapse", "'free'");
  if (setting.guess.value_or(0.0) + setting.lapse.value_or(0.0) >= 1.0)
    throw Error("guess and lapse rates sum to 1 or more", "--guess, --lapse");
  const StudyAnswers study = read(options);
  const std::vector<store::StudyPrediction> predictions = store::readPredictions(options.choice.store);
  std::map<std::string, std::string> names;
  const store::SessionReader reader(options.choice.store);
  for (const StudyAnswer& answer : study.answers)
    if (!names.count(answer.displayHash)) names[answer.displayHash] = reader.display(answer.displayHash).name;
  for (const store::StudyPrediction& one : predictions)
    if (!names.count(one.displayHash)) names[one.displayHash] = reader.display(one.displayHash).name;
  print(options, study, validateStudy(study, predictions, names, setting), "validation");
}

/// A command of common options and one result.
template <class Analyse>
void addSimple(CLI::App& app, const std::string& name, const std::string& summary, Analyse analyse) {
  CLI::App* command = app.add_subcommand(name, summary);
  auto options = std::make_shared<StudyOptions>();
  addCommon(*command, *options);
  command->callback([options, analyse, name] {
    const StudyAnswers study = read(*options);
    print(*options, study, analyse(study), name);
  });
}

}  // namespace

void addStudyCommands(CLI::App& app) {
  addSimple(app, "rates", "how often observers of a study reported a change, by condition and observer",
            [](const StudyAnswers& study) { return studyRates(study); });
  addSimple(
      app, "anova",
      "analysis of variance of a study's detection rates, with the published values of experiment_1 and "
      "_2",
      [](const StudyAnswers& study) { return studyAnova(study); });
  addSimple(app, "sdt", "sensitivity and criterion of a study's observers (signal detection theory)",
            [](const StudyAnswers& study) { return studySensitivity(study); });

  CLI::App* command = app.add_subcommand(
      "validate",
      "how well predictors of popping predict a study's answers (limen study predict makes them)");
  auto options = std::make_shared<ValidateOptions>();
  addCommon(*command, *options);
  ValidationSetting& setting = options->setting;
  command->add_option("--display", setting.display,
                      "Display that predictions are for: name, or first digits of the SHA-256 (default: the "
                      "sessions')");
  command->add_option("--settings", setting.settings,
                      "First digits of the SHA-256 of the predictor's settings (default: the newest)");
  command
      ->add_option("--guess", options->guess,
                   "Guess rate of the fitted link: catch (their rate), free, or a number")
      ->capture_default_str();
  command->add_option("--lapse", options->lapse, "Lapse rate of the fitted link: free, or a number")
      ->capture_default_str();
  command
      ->add_option("--coverage-edges", options->coverageEdges,
                   "Shares of the object from which coverage is small, large, huge (default: 0.01,0.05,0.2)")
      ->delimiter(',');
  command
      ->add_option("--rating-edges", options->ratingEdges,
                   "R from which a rating is low, high, very high (default: 1,2,3)")
      ->delimiter(',');
  command->add_option("--top-regions", setting.bins.topRegions, "Regions whose mean R is the rating score")
      ->capture_default_str();
  command->callback([options] { validate(*options); });
}

}  // namespace limen::analysis
