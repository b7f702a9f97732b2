// SPDX-License-Identifier: BSD-3-Clause
// limen analyse sdt: sensitivity and criterion of a study's observers, or of a table.
#include <CLI/CLI.hpp>
#include <memory>

#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
#include "analysis/answer_tables/table_input.h"
#include "analysis/observer_statistics/sensitivity_table.h"
#include "analysis/study/head.h"
#include "analysis/study/sensitivity.h"
#include "experiments/base/error.h"

namespace limen::analysis {

void addSdtCommand(CLI::App& app) {
  struct Call {
    StudyInput input;
    SensitivityColumns columns;
    std::string correction = "loglinear";
  };
  auto call = std::make_shared<Call>();
  CLI::App* command = app.add_subcommand(
      "sdt", "sensitivity and criterion (signal detection theory): of a study's observers, or of any CSV");
  addTableInput(*command, call->input);
  SensitivityColumns& columns = call->columns;
  command->add_option("--subject", columns.subject,
                      "CSV: column that says who answered; means are over subjects");
  command
      ->add_option("--by", columns.by,
                   "CSV: columns of conditions, A,B,...; without --subject means are over their rows")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--task", columns.task, "CSV: yesno, 2afc, mafc:M")->capture_default_str();
  addAnswerColumns(*command, columns.answers);
  command->add_option("--signal", columns.signal,
                      "CSV: column with 1 where there was something to see and 0 elsewhere, beside --outcome "
                      "with 1 for yes");
  command->add_option("--hits", columns.hits, "CSV: column with the number of hits ...");
  command->add_option("--signals", columns.signals, "CSV: ... of so many trials with a signal");
  command->add_option("--false-alarms", columns.falseAlarms,
                      "CSV: column with the number of false alarms ...");
  command->add_option("--noises", columns.noises, "CSV: ... of so many trials without");
  command
      ->add_option(
          "--correction", call->correction,
          "of rates k of n: loglinear for (k + 1/2) / (n + 1), or none, which refuses rates of 0 and 1")
      ->capture_default_str();
  command->callback([call, command] {
    const RateCorrection correction = readRateCorrection(call->correction);
    if (isStudyStore(*command, call->input,
                     {"--subject", "--by", "--outcome", "--k", "--n", "--signal", "--hits", "--signals",
                      "--false-alarms", "--noises", "--where"})) {
      if (command->count("--task") > 0)
        throw Error("is said by the store's protocol", "--task", "leave it out, or give a CSV file");
      const StudyAnswers study = readStudy(call->input);
      print(call->input, headOf(study), resultOf(studySensitivity(study, correction)));
    } else {
      const TableInput table = readTableInput(call->input.choice.store, call->input.where);
      call->columns.correction = correction;
      print(call->input, headOf(table), resultOf(tableSensitivity(table.table, call->columns)));
    }
  });
}

}  // namespace limen::analysis
