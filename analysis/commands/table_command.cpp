// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/commands/table_command.h"

namespace limen::analysis {

void addTableInput(CLI::App& command, StudyInput& input, std::vector<std::string>& where) {
  addStudyInput(command, input, "data",
                "Result store with sessions; or CSV or TSV, columns named in the first line");
  command
      .add_option("--where", where,
                  "CSV: only rows with COLUMN=VALUE; may be repeated, of one column any value fits")
      ->allow_extra_args(false);
}

void addAnswerColumns(CLI::App& command, AnswerColumns& columns) {
  command.add_option("--outcome", columns.outcome, "CSV: column with 0 or 1, where each row is one trial");
  command.add_option("--k", columns.correct, "CSV: column with the number of correct or positive answers");
  command.add_option("--n", columns.trials, "CSV: column with the number of trials");
}

}  // namespace limen::analysis
