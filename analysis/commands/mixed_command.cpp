// SPDX-License-Identifier: BSD-3-Clause
// limen analyse mixed: mixed-effects logistic regression of a study's answers, or of a table.
#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
#include "analysis/answer_tables/table_input.h"
#include "analysis/observer_statistics/mixed_table.h"
#include "analysis/study/head.h"
#include "analysis/study/mixed.h"
#include "experiments/base/error.h"

namespace limen::analysis {

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
  command
      ->add_option("--fixed", terms.fixed,
                   "Columns or factors, A,B,A:B; numbers as they are, text against its first level")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->required();
  command->add_option("--slope", terms.slope,
                      "One of these along which each group or observer has a slope of its own");
  command
      ->add_option("--reference", terms.references,
                   "COLUMN=LEVEL: the level that the others are compared with; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--categorical", terms.categorical, "Columns of numbers that are names of levels")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--center", terms.centre, "Columns of numbers of which their mean over rows is taken off")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--log", terms.log, "Columns of numbers of which the natural logarithm is taken, first")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->callback([call, command] {
    if (isStudyStore(*command, call->input, {"--outcome", "--k", "--n", "--group", "--where"})) {
      const StudyAnswers study = readStudy(call->input);
      print(call->input, headOf(study),
            resultOf(fitMixedModel(studyMixedRows(study, call->part), call->terms)));
    } else {
      if (command->count("--part") > 0)
        throw Error("means nothing for a table", "--part", "leave it out, or take rows with --where");
      const TableInput table = readTableInput(call->input.choice.store, call->input.where);
      print(call->input, headOf(table),
            resultOf(fitMixedModel(readMixedRows(table.table, call->group, call->answers), call->terms)));
    }
  });
}

}  // namespace limen::analysis
