// SPDX-License-Identifier: BSD-3-Clause
// limen analyse published: what the thesis printed of its experiments, beside the answers of stores.
#include <algorithm>
#include <memory>
#include <set>

#include "analysis/commands/commands.h"
#include "analysis/commands/study_input.h"
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
    const nlohmann::json facts = reader.environment(session.environment).facts;
    const nlohmann::json frontEnd = facts.value("front_end", nlohmann::json::object());
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

void comparePublished(const PublishedOptions& options) {
  std::vector<PublishedComparison> comparisons;
  nlohmann::json heads = nlohmann::json::array();
  std::string text;
  for (const std::string& store : options.stores) {
    StudyInput input = options;
    input.choice.store = store;
    const StudyAnswers study = readStudy(input);
    comparisons.push_back(compareStore(input, study));
    heads.push_back(headJson(study));
    heads.back()["store"] = store;
    text += (text.empty() ? "" : "\n") + headText(study);
  }
  if (std::all_of(comparisons.begin(), comparisons.end(),
                  [](const PublishedComparison& one) { return one.statistics.empty(); }))
    throw Error(comparisons.front().notes.front(), options.stores.front());
  if (!options.csv.empty()) writeFileBytes(options.csv, toCsv(comparisons));
  if (options.asJson)
    printJson({{"stores", heads}, {"published", toJson(comparisons)}});
  else
    std::printf("%s%s", text.c_str(), toText(comparisons).c_str());
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
  command->add_flag("--json", options->asJson, "One JSON object");
  command->add_option("--csv", options->csv, "Writes a table to this file")->type_name("FILE");
  command->callback([options] { comparePublished(*options); });
}

}  // namespace limen::analysis
