// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/answer_tables/choice.h"
#include "analysis/answer_tables/table_input.h"
#include "analysis/study/analyses.h"
#include "experiments/store/predictions.h"

namespace limen::analysis {

constexpr EnumNames<Observers, 2> enumNames(Observers) {
  return {{{{Observers::People, "people"}, {Observers::Simulated, "simulated"}}}};
}

/// What the commands on answers have in common: where the answers are and which of them count, and how the
/// result is printed.
struct StudyInput {
  StudyChoice choice;              ///< `store` may be a table where a command takes one
  std::vector<std::string> where;  ///< conditions on rows of a table
  bool noExclusions = false, asJson = false;
  std::string csv;
};

/// An option whose default is what the target holds; help shows it.
template <class T>
CLI::Option* addDefaulted(CLI::App& command, const std::string& name, T& target, const std::string& meaning) {
  return command.add_option(name, target, meaning)->capture_default_str();
}

/// An option that takes A,B,... and no further argument.
CLI::Option* addList(CLI::App& command, const std::string& name, std::vector<std::string>& target,
                     const std::string& meaning);

/// An option that takes one of an enumeration's names. Throws Error: no such `noun`, with the nearest name.
template <NamedEnum E, class Target>
CLI::Option* addChoice(CLI::App& command, const std::string& name, Target& target, const std::string& meaning,
                       const std::string& noun = "choice") {
  return command
      .add_option_function<std::string>(
          name, [&target, name, noun](const std::string& text) { target = readChoice<E>(text, name, noun); },
          meaning)
      ->option_text(join(namesOf<E>(), "|"));
}

/// Adds --protocol, --observers, --no-exclusions, --unfinished: which sessions and answers count.
void addStudyChoice(CLI::App& command, StudyInput& input);
/// Whether one of those was given.
bool choosesSessions(const CLI::App& command);
/// Adds --json, --csv.
void addOutput(CLI::App& command, StudyInput& input);
/// Adds the positional, the options of addStudyChoice() and addOutput().
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

/// Prints what `ofStudy` makes of a store or `ofTable` of a table, whichever the input is. `tableOptions` are
/// as of isStudyStore().
template <class OfStudy, class OfTable>
void analyseInput(const CLI::App& command, const StudyInput& input,
                  const std::vector<std::string>& tableOptions, OfStudy ofStudy, OfTable ofTable) {
  if (isStudyStore(command, input, tableOptions)) {
    const StudyAnswers study = readStudy(input);
    print(input, headOf(study), resultOf(ofStudy(study)));
  } else {
    const TableInput table = readTableInput(input.choice.store, input.where);
    print(input, headOf(table), resultOf(ofTable(table.table)));
  }
}

}  // namespace limen::analysis
