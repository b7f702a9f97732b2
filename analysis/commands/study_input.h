// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/output/text_output.h"
#include "analysis/study/answers.h"
#include "analysis/study/head.h"
#include "experiments/store/predictions.h"

namespace limen::analysis {

/// What the commands on answers have in common: where the answers are and which of them count, and how the
/// result is printed.
struct StudyInput {
  StudyChoice choice;  ///< `store` may be a table where a command takes one
  bool noExclusions = false, asJson = false;
  std::string csv;
};

/// Adds --protocol, --observers, --no-exclusions, --unfinished: which sessions and answers count.
void addStudyChoice(CLI::App& command, StudyInput& input);
/// Whether one of those was given.
bool choosesSessions(const CLI::App& command);

/// Adds the positional, the options of addStudyChoice(), --json, --csv.
void addStudyInput(CLI::App& command, StudyInput& input, const std::string& positional = "store",
                   const std::string& meaning = "Result store with sessions");

/// Names of displays by hash: those of the answers and those that were predicted for.
std::map<std::string, std::string> displayNames(const std::string& store, const StudyAnswers& study,
                                                const std::vector<store::StudyPrediction>& predictions);

/// The choice with what the options say.
StudyChoice choiceOf(const StudyInput& input);

/// Throws Error as readStudyAnswers().
StudyAnswers readStudy(const StudyInput& input);

/// For commands that take a store or a table, before anything is read: whether it is a store. Throws Error if
/// an option was given that means nothing for the other kind: `tableOptions` beside a store, those of
/// addStudyChoice() and `storeOptions` beside a table.
bool isStudyStore(const CLI::App& command, const StudyInput& input,
                  const std::vector<std::string>& tableOptions,
                  const std::vector<std::string>& storeOptions = {});

/// Prints a JSON object on one line.
void printJson(const nlohmann::json& out);

/// Every result on sessions opens with what the answers are and what was left out. Uses toText(), toJson()
/// and toCsv() of the result.
template <class Result>
void printStudyResult(const StudyInput& input, const StudyAnswers& study, const Result& result,
                      const std::string& name) {
  if (!input.csv.empty()) writeFileBytes(input.csv, toCsv(result));
  if (input.asJson) {
    nlohmann::json out = headJson(study);
    out[name] = toJson(result);
    printJson(out);
  } else {
    std::printf("%s%s", headText(study).c_str(), toText(result).c_str());
  }
}

}  // namespace limen::analysis
