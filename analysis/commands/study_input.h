// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/output/result.h"
#include "analysis/study/answers.h"
#include "experiments/store/predictions.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace limen::analysis {

/// What the commands on answers have in common: where the answers are and which of them count, and how the
/// result is printed.
struct StudyInput {
  StudyChoice choice;              ///< `store` may be a table where a command takes one
  std::vector<std::string> where;  ///< conditions on rows of a table
  bool noExclusions = false, asJson = false;
  std::string csv;
};

/// An option that takes A,B,... and no further argument.
CLI::Option* addList(CLI::App& command, const std::string& name, std::vector<std::string>& target,
                     const std::string& meaning);

/// Adds --protocol, --observers, --no-exclusions, --unfinished: which sessions and answers count.
void addStudyChoice(CLI::App& command, StudyInput& input);
/// Whether one of those was given.
bool choosesSessions(const CLI::App& command);
/// Adds the positional, the options of addStudyChoice(), --json, --csv.
void addStudyInput(CLI::App& command, StudyInput& input, const std::string& positional = "store",
                   const std::string& meaning = "Result store with sessions");
/// For commands that take a store or a table: addStudyInput() and --where.
void addTableInput(CLI::App& command, StudyInput& input);
/// --outcome, --k, --n.
void addAnswerColumns(CLI::App& command, AnswerColumns& columns);

StudyChoice choiceOf(const StudyInput& input);
StudyAnswers readStudy(const StudyInput& input);

/// Whether the input is a store; it is a table otherwise. Throws Error for options that the other kind of
/// input takes: `tableOptions`, or those on sessions and `storeOptions`.
bool isStudyStore(const CLI::App& command, const StudyInput& input,
                  const std::vector<std::string>& tableOptions,
                  const std::vector<std::string>& storeOptions = {});

/// Throws Error unless a confidence level lies between 0 and 1, both excluded, and samples of a bootstrap are
/// 100 to 1,000,000, or 0 if `orNone`.
void checkIntervals(double level, size_t samples, bool orNone);

/// Prints the result as text, or as one line of JSON, with what the data are in front, and writes --csv.
void print(const StudyInput& input, const Section& head, Result result);

}  // namespace limen::analysis
