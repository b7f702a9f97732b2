// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_fits/fit_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/output/text_output.h"
#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

size_t parameterNamed(const std::string& name, const std::string& option) {
  const auto& names = fitParameterNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw Error("no parameter '" + name + "'", option, suggest(name, {names.begin(), names.end()}));
  return static_cast<size_t>(found - names.begin());
}

void readFixed(const std::string& text, FitSettings& settings) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos) throw Error("'" + text + "' has no value", "--fix", "write lapse=0.01");
  const size_t parameter = parameterNamed(text.substr(0, equals), "--fix");
  const std::string digits = text.substr(equals + 1);
  settings.fixed[parameter] = finiteNumber(digits);
  if (!settings.fixed[parameter])
    throw Error("'" + digits + "' is not a number", "--fix " + text.substr(0, equals));
}

std::string choice(const std::string& text, const std::vector<std::string>& known,
                   const std::string& option) {
  if (std::find(known.begin(), known.end(), text) == known.end())
    throw Error("no choice '" + text + "'", option, suggest(text, known));
  return text;
}

}  // namespace

FitSettings readFitSettings(const FitOptions& options, const std::vector<Condition>& data) {
  const auto orElse = [](const std::string& text, const char* otherwise) {
    return text.empty() ? std::string(otherwise) : text;
  };
  FitSettings settings;
  settings.sigmoid = psychometrics::sigmoidFamily(orElse(options.sigmoid, "normal"), "--sigmoid");
  settings.task = readFitTask(orElse(options.task, "2afc"), "--task");
  settings.axis = choice(orElse(options.axis, "linear"), {"linear", "log"}, "--axis") == "log"
                      ? psychometrics::StimulusAxis::Logarithmic
                      : psychometrics::StimulusAxis::Linear;
  const std::string direction =
      choice(orElse(options.direction, "rising"), {"rising", "falling", "auto"}, "--direction");
  settings.falling = direction == "auto" ? answersFall(data, settings) : direction == "falling";
  settings.method = choice(options.method, {"ml", "map"}, "--method") == "ml" ? FitMethod::MaximumLikelihood
                                                                              : FitMethod::MaximumPosterior;
  settings.thresholdLevel = options.thresholdLevel.value_or(0.5);
  settings.lapseMost = options.lapseMost;
  settings.guessMost = options.guessMost;
  settings.overdispersion = options.overdispersion;
  for (const std::string& text : options.fixed) readFixed(text, settings);
  for (const std::string& name : options.shared) settings.shared[parameterNamed(name, "--share")] = true;
  if (!options.range.empty()) {
    if (options.range.size() != 2) throw Error("takes two numbers", "--range", "write --range 0.001,0.01");
    settings.range = {options.range[0], options.range[1]};
  }
  return settings;
}

std::vector<Condition> readConditions(const FitOptions& options) {
  if (options.level.empty())
    throw Error("the column with the stimulus level is not named", "", "name it with --x");
  const bool single = !options.outcome.empty();
  if (single && (!options.correct.empty() || !options.trials.empty()))
    throw Error("rows are single trials or counts, not both", "--outcome", "drop it, or drop --k and --n");
  if (!single && (options.correct.empty() || options.trials.empty()))
    throw Error("the columns with the answers are not named", "", "name --k and --n, or --outcome");
  const Table table = Table::read(options.file);
  const size_t level = table.column(options.level, "--x");
  const size_t correct =
      single ? table.column(options.outcome, "--outcome") : table.column(options.correct, "--k");
  const size_t trials = single ? correct : table.column(options.trials, "--n");
  const bool ordered = !options.order.empty();
  const size_t order = ordered ? table.column(options.order, "--order") : 0;
  std::vector<size_t> by;
  for (const std::string& name : options.by) by.push_back(table.column(name, "--by"));

  std::vector<Condition> conditions;
  std::map<std::string, size_t> known;
  std::map<std::pair<size_t, double>, size_t> blockOf;  // of single trials
  for (size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> parts;
    for (const size_t column : by) parts.push_back(table.text(row, column));
    const std::string name = join(parts, " / ");
    const auto [at, fresh] = known.emplace(name, conditions.size());
    if (fresh) conditions.push_back({name, {}});
    Condition& condition = conditions[at->second];
    Block block;
    block.level = table.number(row, level);
    block.order = ordered ? table.number(row, order) : static_cast<double>(row);
    if (!single) {
      block.correct = table.count(row, correct);
      block.trials = table.count(row, trials);
      if (block.correct > block.trials)
        throw Error(fmt::format("{} correct of {} trials", block.correct, block.trials),
                    table.place(row, correct));
      condition.blocks.push_back(block);
      continue;
    }
    const int64_t outcome = readBinary(table, row, correct, "outcomes are 0 or 1; counts take --k and --n");
    const auto [place, first] = blockOf.emplace(std::pair(at->second, block.level), condition.blocks.size());
    if (first) condition.blocks.push_back({block.level, 0, 0, 0.0});
    Block& pooled = condition.blocks[place->second];
    pooled.correct += outcome;
    ++pooled.trials;
    // The mean time of its trials.
    pooled.order += (block.order - pooled.order) / static_cast<double>(pooled.trials);
  }
  return conditions;
}

FitAnswer answerFit(const FitOptions& options, std::vector<Condition> data) {
  if (!(options.confidence > 0.0 && options.confidence < 1.0))
    throw Error("has to lie between 0 and 1, both excluded", "--confidence");
  if (options.samples < 100 || options.samples > 1000000)
    throw Error("has to be 100 to 1000000", "--samples", "2000 are usual");
  const FitSettings settings = readFitSettings(options, data);
  std::optional<IntervalMethod> method;
  if (!options.intervals.empty() && options.intervals != "none")
    method = readIntervalMethod(options.intervals, "--intervals");
  const bool parametric =
      choice(options.resample, {"parametric", "nonparametric"}, "--resample") == "parametric";

  FitAnswer answer;
  answer.file = options.file;
  answer.level = options.level;
  answer.data = std::move(data);
  answer.hash = sha256File(options.file);
  answer.parametric = parametric;
  answer.samples = static_cast<size_t>(options.samples);
  answer.seed = options.seed;
  answer.fit = fitPsychometric(answer.data, settings, options.file);
  if (answer.data.size() > 1 && !options.shared.empty()) {
    FitSettings apart = settings;
    apart.shared.fill(false);
    bool possible = true;
    try {
      checkFit(answer.data, apart);
    } catch (const Error&) {
      possible = false;  // a condition needs what the others tell
    }
    if (possible) {
      answer.full = fitPsychometric(answer.data, apart, options.file);
      if (settings.method == FitMethod::MaximumLikelihood &&
          answer.full->freeParameters > answer.fit.freeParameters)
        answer.ratio = likelihoodRatio(answer.fit, *answer.full);
    }
  }
  const bool bootstrapped = method == IntervalMethod::Bootstrap || method == IntervalMethod::Bca;
  std::vector<Replicate> fromFit, own;
  BootstrapOptions bootstrapOptions{answer.samples, options.seed, true, std::max(1u, options.threads)};
  if (options.goodness || (bootstrapped && parametric))
    fromFit = bootstrap(answer.data, answer.fit, bootstrapOptions);
  if (bootstrapped && !parametric) {
    bootstrapOptions.parametric = false;
    own = bootstrap(answer.data, answer.fit, bootstrapOptions);
  }
  if (method) {
    switch (*method) {
      case IntervalMethod::Bootstrap:
      case IntervalMethod::Bca:
        answer.intervals = bootstrapIntervals(answer.data, answer.fit, parametric ? fromFit : own,
                                              *method == IntervalMethod::Bca, options.confidence);
        break;
      case IntervalMethod::Profile:
        answer.intervals = profileIntervals(answer.data, answer.fit, options.confidence);
        break;
      case IntervalMethod::Laplace:
        answer.intervals = laplaceIntervals(answer.data, answer.fit, options.confidence);
        break;
      case IntervalMethod::Observers:
        throw Error("takes the pooled answers of a result store's observers", "--intervals observers",
                    "of a table or a single observer take profile");
      case IntervalMethod::Posterior:
        answer.intervals = posteriorIntervals(answer.data, answer.fit, options.confidence);
        break;
    }
  }
  if (options.goodness) answer.goodness = goodnessOfFit(answer.data, answer.fit, fromFit);
  return answer;
}

}  // namespace limen::analysis
