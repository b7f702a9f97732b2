// SPDX-License-Identifier: BSD-3-Clause
// limen analyse rates, validate: what the sessions of a study say.
#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
#include "analysis/output/text_output.h"
#include "analysis/study/analyses.h"
#include "analysis/study/rates.h"
#include "analysis/study/thresholds.h"
#include "analysis/study/validation.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

struct ValidateOptions : StudyInput {
  ValidationSetting setting;
  std::string guess = "catch", lapse = "free";
  std::vector<double> coverageEdges, ratingEdges;
  std::string scores;
  std::vector<std::string> quality;
};

/// A rate from 0 to below 1.
double rateOf(const std::string& text, const std::string& option, const std::string& words) {
  const std::optional<double> value = finiteNumber(text);
  if (!value || !(*value >= 0.0 && *value < 1.0))
    throw Error("'" + text + "' is no rate", option, "give a number from 0 to below 1, or " + words);
  return *value;
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
  if (options.scores.empty() && !options.quality.empty())
    throw Error("there are no scores", "--quality", "name their table with --scores");
  if (!options.scores.empty()) setting.scores = readClipScores(options.scores, options.quality);
  const StudyAnswers study = readStudy(options);
  const std::vector<store::StudyPrediction> predictions = store::readPredictions(options.choice.store);
  print(options, headOf(study),
        resultOf(validateStudy(study, predictions, displayNames(options.choice.store, study, predictions),
                               setting)));
}

void addRates(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "rates", "how often observers of a study reported a change, by condition and observer");
  auto options = std::make_shared<StudyInput>();
  addStudyInput(*command, *options);
  command->callback([options] {
    const StudyAnswers study = readStudy(*options);
    print(*options, headOf(study), resultOf(studyRates(study)));
  });
}

void addThresholds(CLI::App& app) {
  struct Call : StudyInput {
    std::string part;
    AnovaSettings settings;
  };
  CLI::App* command = app.add_subcommand(
      "thresholds", "thresholds of each observer and condition of a study, compared over observers");
  auto call = std::make_shared<Call>();
  addStudyInput(*command, *call);
  command->add_option(
      "--part", call->part,
      "Part of the protocol (default: those whose stimuli a procedure chose, or else all with a "
      "numeric variable)");
  command->callback([call] {
    const StudyAnswers study = readStudy(*call);
    print(*call, headOf(study), resultOf(studyThresholds(study, call->part, call->settings), study));
  });
}

}  // namespace

void addStudyCommands(CLI::App& app) {
  addRates(app);
  addThresholds(app);

  CLI::App* command = app.add_subcommand(
      "validate",
      "how well predictors of popping predict a study's answers (limen study predict makes them)");
  auto options = std::make_shared<ValidateOptions>();
  addStudyInput(*command, *options);
  ValidationSetting& setting = options->setting;
  command->add_option("--display", setting.display,
                      "Display that predictions are for: name, or first digits of the SHA-256 (default: the "
                      "sessions')");
  command->add_option("--settings", setting.settings,
                      "First digits of the SHA-256 of the predictor's settings (default: the newest)");
  command->add_option(
      "--scores", options->scores,
      "CSV of other scores to test: column clip (limen study export --clips) or stimulus_hash, and a "
      "column for each predictor; larger means more visible");
  command
      ->add_option("--quality", options->quality, "Columns of --scores in which larger means better instead")
      ->type_name("NAME,...")
      ->delimiter(',');
  addDefaulted(*command, "--guess", options->guess,
               "Guess rate of the fitted link: catch (their rate), free, or a number");
  addDefaulted(*command, "--lapse", options->lapse, "Lapse rate of the fitted link: free, or a number");
  command
      ->add_option("--coverage-edges", options->coverageEdges,
                   "Shares of the object from which coverage is small, large, huge (default: 0.01,0.05,0.2)")
      ->delimiter(',');
  command
      ->add_option("--rating-edges", options->ratingEdges,
                   "R from which a rating is low, high, very high (default: 1,2,3)")
      ->delimiter(',');
  addDefaulted(*command, "--samples", setting.samples,
               "Samples of observers for the link's intervals; 0: none")
      ->check(CLI::Range(0, 100000));
  addDefaulted(*command, "--seed", setting.seed, "Of these samples");
  addDefaulted(*command, "--top-regions", setting.bins.topRegions,
               "Regions whose mean R is the rating score");
  command->callback([options] { validate(*options); });
}

}  // namespace limen::analysis
