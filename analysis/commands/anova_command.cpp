// SPDX-License-Identifier: BSD-3-Clause
// limen analyse anova: of a study's detection rates, or of a table.
#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
#include "analysis/answer_tables/table_input.h"
#include "analysis/observer_statistics/anova_table.h"
#include "analysis/study/head.h"
#include "analysis/study/anova.h"

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
  command->add_option("--within", columns.within, "CSV: columns of the factors, A,B,...; numbers are ordered")
      ->delimiter(',')
      ->allow_extra_args(false);
  addAnswerColumns(*command, columns.answers);
  command->add_option("--value", columns.answers.value, "CSV: column with any measured number");
  command->add_flag("--drop-incomplete", columns.dropIncomplete,
                    "CSV: leave out subjects who miss a cell (of a store they always are)");
  static const std::map<std::string, RateTransform> kTransforms = {{"none", RateTransform::None},
                                                                   {"arcsine", RateTransform::Arcsine}};
  command
      ->add_option("--transform", call->settings.transform,
                   "of each cell's rate: none, or arcsine for asin(sqrt(p)) (default: none)")
      ->transform(CLI::CheckedTransformer(kTransforms))
      ->option_text("none|arcsine");
  command->add_flag("--ranks", call->settings.ranks,
                    "Friedman's test of each factor and Wilcoxon's signed ranks of its pairs too");
  command->callback([call, command] {
    if (isStudyStore(*command, call->input,
                     {"--subject", "--within", "--outcome", "--k", "--n", "--value", "--where"})) {
      const StudyAnswers study = readStudy(call->input);
      print(call->input, headOf(study), resultOf(studyAnova(study, call->settings)));
    } else {
      const TableInput table = readTableInput(call->input.choice.store, call->input.where);
      print(call->input, headOf(table),
            resultOf(std::vector<PartAnova>{tableAnova(table.table, call->columns, call->settings)}));
    }
  });
}

}  // namespace limen::analysis
