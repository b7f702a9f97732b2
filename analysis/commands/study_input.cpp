// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/commands/study_input.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "analysis/answer_tables/table_input.h"
#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "experiments/base/error.h"

namespace limen::analysis {

namespace {

const std::vector<std::string>& choiceOptions() {
  static const std::vector<std::string> kOptions = {"--protocol", "--observers", "--no-exclusions",
                                                    "--unfinished", "--codes"};
  return kOptions;
}

}  // namespace

CLI::Option* addList(CLI::App& command, const std::string& name, std::vector<std::string>& target,
                     const std::string& meaning) {
  return command.add_option(name, target, meaning)->delimiter(',')->allow_extra_args(false);
}

void addStudyChoice(CLI::App& command, StudyInput& input) {
  command.add_option("--protocol", input.choice.protocol,
                     "Name, or first digits of the SHA-256, if the store has several");
  addChoice<Observers>(command, "--observers", input.choice.observers,
                       "people or simulated, if the store has sessions of both");
  command.add_flag("--no-exclusions", input.noExclusions,
                   "Do not apply the exclusion rules that the protocol declares");
  command.add_flag("--unfinished", input.choice.unfinished, "Take broken-off sessions too");
  command.add_flag("--codes", input.choice.codes,
                   "Participant codes in place of O01, O02, ...: for the lab's own use");
}

bool choosesSessions(const CLI::App& command) {
  return std::any_of(choiceOptions().begin(), choiceOptions().end(),
                     [&](const std::string& option) { return command.count(option) > 0; });
}

void addOutput(CLI::App& command, StudyInput& input) {
  command.add_flag("--json", input.asJson, "One JSON object");
  command.add_option("--csv", input.csv, "Writes all tables of the result to this file")->type_name("FILE");
}

void addStudyInput(CLI::App& command, StudyInput& input, const std::string& positional,
                   const std::string& meaning) {
  command.add_option(positional, input.choice.store, meaning)->required();
  addStudyChoice(command, input);
  addOutput(command, input);
}

void addTableInput(CLI::App& command, StudyInput& input) {
  addStudyInput(command, input, "data",
                "Result store with sessions; or CSV or TSV, columns named in the first line");
  command
      .add_option("--where", input.where,
                  "CSV: only rows with COLUMN=VALUE; may be repeated, of one column any value fits")
      ->allow_extra_args(false);
}

void addAnswerColumns(CLI::App& command, AnswerColumns& columns) {
  command.add_option("--outcome", columns.outcome,
                     "CSV: column with 0 or 1, no or yes, where each row is one trial");
  command.add_option("--k", columns.correct, "CSV: column with the number of correct or positive answers");
  command.add_option("--n", columns.trials, "CSV: column with the number of trials");
}

StudyChoice choiceOf(const StudyInput& input) {
  StudyChoice choice = input.choice;
  choice.exclusions = !input.noExclusions;
  return choice;
}

StudyAnswers readStudy(const StudyInput& input) { return readStudyAnswers(choiceOf(input)); }

bool isStudyStore(const CLI::App& command, const StudyInput& input,
                  const std::vector<std::string>& tableOptions,
                  const std::vector<std::string>& storeOptions) {
  const bool store = isDatabase(input.choice.store);
  std::vector<std::string> ofStores = choiceOptions();
  ofStores.insert(ofStores.end(), storeOptions.begin(), storeOptions.end());
  for (const std::string& option : store ? tableOptions : ofStores)
    if (command.count(option) > 0)
      throw Error(store ? "names a column, and a result store has none" : "means nothing for a table", option,
                  store ? "leave it out, or give a CSV file" : "leave it out, or give a result store");
  return store;
}

void checkIntervals(double level, size_t samples, bool orNone) {
  if (!(level > 0.0 && level < 1.0))
    throw Error("has to lie between 0 and 1, both excluded", "--confidence", "0.95 is usual");
  if (!(orNone && samples == 0) && (samples < 100 || samples > 1000000))
    throw Error(std::string("has to be 100 to 1000000") + (orNone ? ", or 0 for no bootstrap" : ""),
                "--samples", "2000 are usual");
}

void print(const StudyInput& input, const Section& head, Result result) {
  Section& own = result.head;
  own.title = head.title;
  own.facts.insert(own.facts.begin(), head.facts.begin(), head.facts.end());
  own.tables.insert(own.tables.begin(), head.tables.begin(), head.tables.end());
  own.notes.insert(own.notes.begin(), head.notes.begin(), head.notes.end());
  if (!input.csv.empty()) writeFileBytes(input.csv, toCsv(result.sections));
  std::fputs((input.asJson ? jsonLine(result) : toText(result)).c_str(), stdout);
}

}  // namespace limen::analysis
