// SPDX-License-Identifier: BSD-3-Clause
// limen analyse anova: of a study's detection rates, or of a table.
// limen analyse mixed: mixed-effects logistic regression of a study's answers, or of a table.
// limen analyse sdt: sensitivity and criterion of a study's observers, or of a table.
#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/answer_tables/table_input.h"
#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
#include "analysis/observer_statistics/anova.h"
#include "analysis/observer_statistics/mixed.h"
#include "analysis/observer_statistics/sensitivity.h"
#include "analysis/study/analyses.h"
#include "experiments/base/error.h"

namespace limen::analysis {

void addAnovaCommand(CLI::App& app) {
  struct Call {
    StudyInput input;
    AnovaColumns columns;
    AnovaSettings settings;
  };
  auto call = std::make_shared<Call>();
  CLI::App* command = app.add_subcommand(
      "anova",
      "repeated-measures analysis of variance with paired comparisons: detection rates of a "
      "study's store (with the published values of experiment_1 and _2), or any CSV");
  addTableInput(*command, call->input);
  AnovaColumns& columns = call->columns;
  command->add_option("--subject", columns.subject, "CSV: column that says who answered");
  addList(*command, "--within", columns.within, "CSV: columns of the factors, A,B,...; numbers are ordered");
  addAnswerColumns(*command, columns.answers);
  command->add_option("--value", columns.answers.value, "CSV: column with any measured number");
  command->add_flag("--drop-incomplete", columns.dropIncomplete,
                    "CSV: leave out subjects who miss a cell (of a store they always are)");
  addChoice<RateTransform>(*command, "--transform", call->settings.transform,
                           "of each cell's rate: none, or arcsine for asin(sqrt(p)) (default: none)");
  command->add_flag("--ranks", call->settings.ranks,
                    "Friedman's test of each factor and Wilcoxon's signed ranks of its pairs too");
  command->callback([call, command] {
    analyseInput(
        *command, call->input, {"--subject", "--within", "--outcome", "--k", "--n", "--value", "--where"},
        [&](const StudyAnswers& study) { return studyAnova(study, call->settings); },
        [&](const Table& table) {
          return std::vector<PartAnova>{tableAnova(table, call->columns, call->settings)};
        });
  });
}

void addMixedCommand(CLI::App& app) {
  struct Call {
    StudyInput input;
    AnswerColumns answers;
    MixedTerms terms;
    std::string group, part;
  };
  auto call = std::make_shared<Call>();
  CLI::App* command =
      app.add_subcommand("mixed",
                         "mixed-effects logistic regression of yes/no or right/wrong answers: of a "
                         "study's trials with a change, by observer, or of any CSV");
  addTableInput(*command, call->input);
  addAnswerColumns(*command, call->answers);
  command->add_option("--group", call->group, "CSV: column that says who answered (random effect)");
  command->add_option("--part", call->part, "Store: the protocol's part, if several have answers");
  MixedTerms& terms = call->terms;
  addList(*command, "--fixed", terms.fixed,
          "Columns or factors, A,B,A:B; numbers as they are, text against its first level")
      ->required();
  command->add_option("--slope", terms.slope,
                      "One of these along which each group or observer has a slope of its own");
  command
      ->add_option("--reference", terms.references,
                   "COLUMN=LEVEL: the level that the others are compared with; may be repeated")
      ->allow_extra_args(false);
  addList(*command, "--categorical", terms.categorical, "Columns of numbers that are names of levels");
  addList(*command, "--center", terms.centre,
          "Columns of numbers of which their mean over rows is taken off");
  addList(*command, "--log", terms.log, "Columns of numbers of which the natural logarithm is taken, first");
  command->callback([call, command] {
    analyseInput(
        *command, call->input, {"--outcome", "--k", "--n", "--group", "--where"},
        [&](const StudyAnswers& study) {
          return fitMixedModel(studyMixedRows(study, call->part), call->terms);
        },
        [&](const Table& table) {
          if (command->count("--part") > 0)
            throw Error("means nothing for a table", "--part", "leave it out, or take rows with --where");
          return fitMixedModel(readMixedRows(table, call->group, call->answers), call->terms);
        });
  });
}

void addSdtCommand(CLI::App& app) {
  struct Call {
    StudyInput input;
    SensitivityColumns columns;
  };
  auto call = std::make_shared<Call>();
  CLI::App* command = app.add_subcommand(
      "sdt", "sensitivity and criterion (signal detection theory): of a study's observers, or of any CSV");
  addTableInput(*command, call->input);
  SensitivityColumns& columns = call->columns;
  command->add_option("--subject", columns.subject,
                      "CSV: column that says who answered; means are over subjects");
  addList(*command, "--by", columns.by,
          "CSV: columns of conditions, A,B,...; without --subject means are over their rows");
  addDefaulted(*command, "--task", columns.task, "CSV: yesno, 2afc, mafc:M");
  addAnswerColumns(*command, columns.answers);
  command->add_option("--signal", columns.signal,
                      "CSV: column with 1 where there was something to see and 0 elsewhere, beside --outcome "
                      "with 1 for yes");
  command->add_option("--hits", columns.hits, "CSV: column with the number of hits ...");
  command->add_option("--signals", columns.signals, "CSV: ... of so many trials with a signal");
  command->add_option("--false-alarms", columns.falseAlarms,
                      "CSV: column with the number of false alarms ...");
  command->add_option("--noises", columns.noises, "CSV: ... of so many trials without");
  addChoice<RateCorrection>(*command, "--correction", columns.correction,
                            "of rates k of n: loglinear for (k + 1/2) / (n + 1), the default, or none, which "
                            "refuses rates of 0 and 1",
                            "correction");
  command->callback([call, command] {
    analyseInput(
        *command, call->input,
        {"--subject", "--by", "--outcome", "--k", "--n", "--signal", "--hits", "--signals", "--false-alarms",
         "--noises", "--where"},
        [&](const StudyAnswers& study) {
          if (command->count("--task") > 0)
            throw Error("is said by the store's protocol", "--task", "leave it out, or give a CSV file");
          return studySensitivity(study, call->columns.correction);
        },
        [&](const Table& table) { return tableSensitivity(table, call->columns); });
  });
}

}  // namespace limen::analysis
