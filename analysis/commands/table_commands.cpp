// SPDX-License-Identifier: BSD-3-Clause
// limen analyse correlate: how columns of a table, or measures of a study, go together.
// limen analyse scale: values of items from "which of the two?" answers.
#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/answer_tables/table_input.h"
#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
#include "analysis/correlations/areas.h"
#include "analysis/correlations/correlations.h"
#include "analysis/pair_scales/scale.h"
#include "analysis/study/analyses.h"
#include "analysis/study/measures.h"
#include "experiments/base/error.h"

namespace limen::analysis {

namespace {

struct CorrelateOptions : StudyInput {
  RelationColumns columns;
  BootstrapSetting bootstrap;
  size_t bins = 10;
  bool clamp = false, probability = false;
  std::string plot;
};

void correlateStore(const CorrelateOptions& options) {
  const StudyAnswers study = readStudy(options);
  const std::vector<store::StudyPrediction> predictions = store::readPredictions(options.choice.store);
  const Correlations found = correlateMeasures(
      study, predictions, displayNames(options.choice.store, study, {}), {options.clamp, options.bootstrap});
  if (!options.plot.empty()) drawCorrelations(found, options.plot);
  print(options, headOf(study), resultOf(found));
}

void correlateTable(const CorrelateOptions& options) {
  const TableInput input = readTableInput(options.choice.store);
  RelationColumns columns = options.columns;
  columns.rates = options.clamp;
  columns.probabilities = options.probability;
  const std::vector<RelationRows> rows = readRelations(input.table, columns, input.file);
  if (!columns.outcome.empty()) {
    const Areas found = compareAreas(rows, columns, {options.probability, options.bins, options.bootstrap});
    if (!options.plot.empty()) drawAreas(found, options.plot);
    print(options, headOf(input), resultOf(found));
    return;
  }
  const Correlations found = correlateColumns(rows, columns, {options.clamp, options.bootstrap});
  if (!options.plot.empty()) drawCorrelations(found, options.plot);
  print(options, headOf(input), resultOf(found));
}

/// Options that mean nothing without another one.
void checkTogether(const CLI::App& command) {
  const auto needs = [&](const char* option, const char* other) {
    if (command.count(option) > 0 && command.count(other) == 0)
      throw Error(std::string("means nothing without ") + other, option);
  };
  needs("--probability", "--outcome");
  needs("--bins", "--probability");
  needs("--samples", "--cluster");
  needs("--seed", "--cluster");
  if (command.count("--clamp") > 0 && command.count("--outcome") > 0)
    throw Error("takes rates, and --outcome names 0 and 1", "--clamp", "leave one of both out");
}

struct ScaleOptions : StudyInput {
  PairColumns columns;
  ScaleSetting setting;
  std::string plot;
};

void scaleStore(const ScaleOptions& options) {
  const StudyAnswers study = readStudy(options);
  const Scales found = scaleItems(readStudyPairs(study, options.columns.by), options.setting);
  if (!options.plot.empty()) drawScales(found, options.plot);
  print(options, headOf(study), resultOf(found));
}

void scaleTable(const ScaleOptions& options) {
  const TableInput input = readTableInput(options.choice.store);
  const Scales found = scaleItems(readPairs(input.table, options.columns), options.setting);
  if (!options.plot.empty()) drawScales(found, options.plot);
  print(options, headOf(input), resultOf(found));
}

}  // namespace

void addCorrelateCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "correlate", "how columns of a table, or measures and predictors of a study, go together");
  auto options = std::make_shared<CorrelateOptions>();
  addStudyInput(*command, *options, "DATA",
                "CSV or TSV, columns named in the first line; or a result store with sessions");
  RelationColumns& columns = options->columns;
  command->add_option("--x", columns.x, "columns, each set against --y or --outcome")->delimiter(',');
  command->add_option("--y", columns.y, "column with numbers: Kendall, Spearman, Pearson");
  command->add_option("--outcome", columns.outcome, "column with 0 or 1: areas under ROC curves");
  command->add_option("--by", columns.by, "columns whose values make groups, each looked at alone")
      ->delimiter(',');
  command->add_option("--cluster", columns.cluster,
                      "column whose rows belong together (participant, scene): bootstrap over its values");
  command->add_flag("--clamp", options->clamp,
                    "y are rates: Pearson of clamped x as well (Schwarz 2009, section 10.4.1)");
  command->add_flag("--probability", options->probability, "x are probabilities of 1: calibration as well");
  addDefaulted(*command, "--bins", options->bins, "of the calibration")->check(CLI::Range(1, 1000));
  addDefaulted(*command, "--confidence", options->bootstrap.level, "of the intervals");
  addDefaulted(*command, "--samples", options->bootstrap.samples, "of the bootstrap");
  addDefaulted(*command, "--seed", options->bootstrap.seed, "of the bootstrap");
  command->add_option("--plot", options->plot, "draw into FILE.svg, .pdf or .png")->type_name("FILE");
  command->callback([command, options] {
    const bool store = isStudyStore(*command, *options, {"--x", "--y", "--outcome", "--by", "--cluster"});
    checkTogether(*command);
    checkIntervals(options->bootstrap.level, options->bootstrap.samples, false);
    store ? correlateStore(*options) : correlateTable(*options);
  });
}

void addScaleCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "scale", "scale values of items that were compared in pairs (Thurstone, Bradley and Terry)");
  auto options = std::make_shared<ScaleOptions>();
  addStudyInput(*command, *options, "DATA",
                "CSV or TSV, columns named in the first line; or a result store with sessions");
  PairColumns& columns = options->columns;
  ScaleSetting& setting = options->setting;
  command->add_option("--winner", columns.winner, "column with the item that was chosen");
  command->add_option("--loser", columns.loser, "column with the other");
  command->add_option("--first", columns.first, "column with the item shown first, or left");
  command->add_option("--second", columns.second, "column with the other");
  command->add_option("--chosen", columns.chosen, "column with the name of the one that was chosen");
  command->add_option("--n", columns.count, "column with how many such answers a row stands for");
  command->add_option("--by", columns.by, "columns, or a store's factors, whose values have a scale each")
      ->delimiter(',');
  command->add_option("--subject", columns.subject,
                      "column with who answered: bootstrap over subjects, circular triads");
  command->add_option("--round", columns.round,
                      "column that tells a subject's passes through the pairs apart, for circular triads");
  addChoice<PairwiseModel>(*command, "--model", setting.model,
                           "thurstone (case V), thurstone-ls (by least squares) or bradley-terry (default)");
  addChoice<UnboundedScale>(
      *command, "--unbounded", setting.unbounded,
      "what to do if answers put an item infinitely far away: refuse (default) or penalise");
  addDefaulted(*command, "--prior-sd", setting.priorDeviation, "of values, if they are penalised");
  command->add_option("--reference", setting.reference, "item that is 0 on the scale");
  addDefaulted(*command, "--confidence", setting.bootstrap.level, "of the intervals");
  addDefaulted(*command, "--samples", setting.bootstrap.samples, "of the bootstrap; 0 for none");
  addDefaulted(*command, "--seed", setting.bootstrap.seed, "of the bootstrap");
  command->add_option("--plot", options->plot, "draw into FILE.svg, .pdf or .png")->type_name("FILE");
  command->callback([command, options] {
    const bool store = isStudyStore(
        *command, *options,
        {"--winner", "--loser", "--first", "--second", "--chosen", "--n", "--subject", "--round"});
    const ScaleSetting& chosen = options->setting;
    checkIntervals(chosen.bootstrap.level, chosen.bootstrap.samples, true);
    if (!(chosen.priorDeviation > 0.0 && chosen.priorDeviation < 1e6))
      throw Error("has to be above 0", "--prior-sd", "2 is usual");
    store ? scaleStore(*options) : scaleTable(*options);
  });
}

}  // namespace limen::analysis
