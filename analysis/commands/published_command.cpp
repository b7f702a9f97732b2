// SPDX-License-Identifier: BSD-3-Clause
// limen analyse published: what the thesis printed of its experiments, beside the answers of stores.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
#include "analysis/study/analyses.h"
#include "analysis/study/predicted.h"
#include "analysis/study/published_comparison.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

struct PublishedOptions : StudyInput {
  std::vector<std::string> stores;
};

std::vector<std::string> observerKindsOf(const std::string& path, const StudyAnswers& study) {
  std::set<std::string> kinds;
  if (study.simulated == 0) return {};
  const store::SessionReader reader(path);
  for (const store::StudySession& session : reader.sessions()) {
    if (session.protocol != study.plan.hash) continue;
    const nlohmann::json frontEnd = frontEndOf(reader.environment(session.environment));
    if (!frontEnd.value("simulated", false)) continue;
    kinds.insert(frontEnd.value("observer", nlohmann::json::object()).value("kind", "of unknown kind"));
  }
  return {kinds.begin(), kinds.end()};
}

PublishedComparison compareStore(const StudyInput& input, const StudyAnswers& study) {
  const std::string& store = input.choice.store;
  const StudyRates rates = studyRates(study);
  const std::vector<PartAnova> anova = studyAnova(study);
  StudyFindings findings;
  findings.study = &study;
  findings.rates = &rates;
  findings.anova = &anova;
  findings.observerKinds = observerKindsOf(store, study);
  std::optional<StudyValidation> validation;
  const std::vector<store::StudyPrediction> predictions = store::readPredictions(store);
  if (predictions.empty()) {
    findings.whyNotValidated = "the store has no predictions (limen study predict makes them)";
  } else {
    try {
      ValidationSetting setting;
      setting.onlyAgreements = true;
      validation = validateStudy(study, predictions, displayNames(store, study, predictions), setting);
      findings.validation = &*validation;
    } catch (const Error& error) {
      findings.whyNotValidated = error.message();
    }
  }
  return comparePublished(findings);
}

/// Facts of the heads make a table, a row for each store.
void addStore(Section& all, const std::string& store, const Section& head) {
  if (all.tables.empty()) {
    all.tables = {{"stores", "", {text("store")}}, head.tables[0], head.tables[1]};
    all.tables[0].columns.insert(all.tables[0].columns.end(), head.facts.begin(), head.facts.end());
    for (Column& column : all.tables[0].columns) column.cells.clear();
    for (const size_t table : {1U, 2U}) {
      for (Column& column : all.tables[table].columns) column.cells.clear();
      all.tables[table].columns.insert(all.tables[table].columns.begin(), text("store"));
    }
  }
  const auto append = [](Column& to, const Column& from) {
    to.cells.insert(to.cells.end(), from.cells.begin(), from.cells.end());
  };
  all.tables[0].columns[0].cells.push_back(store);
  for (size_t i = 0; i < head.facts.size(); ++i) append(all.tables[0].columns[i + 1], head.facts[i]);
  for (const size_t table : {0U, 1U}) {
    std::vector<Column>& columns = all.tables[table + 1].columns;
    columns[0].cells.insert(columns[0].cells.end(), head.tables[table].rows(), store);
    for (size_t i = 0; i < head.tables[table].columns.size(); ++i)
      append(columns[i + 1], head.tables[table].columns[i]);
  }
  for (const std::string& note : head.notes) all.notes.push_back(store + ": " + note);
}

void comparePublished(const PublishedOptions& options) {
  std::vector<PublishedComparison> comparisons;
  Section head;
  for (const std::string& store : options.stores) {
    StudyInput input = options;
    input.choice.store = store;
    const StudyAnswers study = readStudy(input);
    comparisons.push_back(compareStore(input, study));
    addStore(head, store, headOf(study));
  }
  if (std::all_of(comparisons.begin(), comparisons.end(),
                  [](const PublishedComparison& one) { return one.statistics.empty(); }))
    throw Error(comparisons.front().notes.front(), options.stores.front());
  print(options, head, resultOf(comparisons));
}

}  // namespace

void addPublishedCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "published",
      "every statistic that the thesis printed of experiment_1 and _2, beside the answers of stores");
  auto options = std::make_shared<PublishedOptions>();
  command->add_option("stores", options->stores, "Result stores with sessions of these protocols")
      ->required();
  addStudyChoice(*command, *options);
  addOutput(*command, *options);
  command->callback([options] { comparePublished(*options); });
}

}  // namespace limen::analysis
