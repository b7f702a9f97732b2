// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_fits/fit_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/answer_tables/choice.h"
#include "analysis/answer_tables/levels.h"
#include "analysis/answer_tables/table.h"
#include "analysis/output/text_output.h"
#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

size_t parameterNamed(const std::string& name, const std::string& option) {
  const auto& names = fitParameterNames();
  return placeOf(name, {names.begin(), names.end()}, "parameter", option);
}

/// Place of a choice among those that are known, of which the first is the default.
size_t choice(const std::string& text, const std::vector<std::string>& known, const std::string& option) {
  return text.empty() ? 0 : placeOf(text, known, "choice", option);
}

}  // namespace

void fixParameter(FitSettings& settings, const std::string& text) {
  const auto [name, digits] = splitAssignment(text, "has no value", "--fix", "write lapse=0.01");
  std::optional<double>& value = settings.fixed[parameterNamed(name, "--fix")];
  value = finiteNumber(digits);
  if (!value) throw Error("'" + digits + "' is not a number", "--fix " + name);
}

void shareParameter(FitSettings& settings, const std::string& name) {
  settings.shared[parameterNamed(name, "--share")] = true;
}

FitSettings readFitSettings(const FitOptions& options, const std::vector<Condition>& data) {
  FitSettings settings = options.settings;
  settings.sigmoid =
      psychometrics::sigmoidFamily(options.sigmoid.empty() ? "normal" : options.sigmoid, "--sigmoid");
  settings.axis = static_cast<psychometrics::StimulusAxis>(choice(options.axis, {"linear", "log"}, "--axis"));
  const size_t direction = choice(options.direction, {"rising", "falling", "auto"}, "--direction");
  settings.falling = direction == 2 ? answersFall(data, settings) : direction == 1;
  settings.thresholdLevel = options.thresholdLevel.value_or(0.5);
  if (options.range.empty()) return settings;
  if (options.range.size() != 2) throw Error("takes two numbers", "--range", "write --range 0.001,0.01");
  settings.range = {options.range[0], options.range[1]};
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
  const std::vector<size_t> by = table.columns(options.by, "--by");

  std::vector<std::string> names;
  for (size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> parts;
    for (const size_t column : by) parts.push_back(table.text(row, column));
    names.push_back(join(parts, " / "));
  }
  const Levels groups = namesIn(names);
  std::vector<Condition> conditions;
  for (const std::string& name : groups.names) conditions.push_back({name, {}});
  std::map<std::pair<size_t, double>, size_t> blockOf;  // of single trials
  for (size_t row = 0; row < table.rows(); ++row) {
    std::vector<Block>& blocks = conditions[groups.ofRow[row]].blocks;
    Block block;
    block.level = table.number(row, level);
    block.order = ordered ? table.number(row, order) : static_cast<double>(row);
    if (!single) {
      block.correct = table.count(row, correct);
      block.trials = table.count(row, trials);
      if (block.correct > block.trials)
        throw Error(fmt::format("{} correct of {} trials", block.correct, block.trials),
                    table.place(row, correct));
      blocks.push_back(block);
      continue;
    }
    const auto [place, first] = blockOf.emplace(std::pair(groups.ofRow[row], block.level), blocks.size());
    if (first) blocks.push_back({block.level, 0, 0, 0.0});
    Block& pooled = blocks[place->second];
    pooled.correct += readBinary(table, row, correct, "outcomes are 0 or 1; counts take --k and --n");
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
  const IntervalMethod method = options.intervals.value_or(IntervalMethod::None);
  const bool parametric = options.resampling == Resampling::Parametric;

  FitAnswer answer;
  answer.file = options.file;
  answer.level = options.level;
  answer.data = std::move(data);
  answer.hash = sha256File(options.file);
  answer.parametric = parametric;
  answer.samples = options.samples;
  answer.seed = options.seed;
  answer.fit = fitPsychometric(answer.data, settings, options.file);
  if (answer.data.size() > 1 && settings.sharesAny()) {
    FitSettings apart = settings;
    apart.shared.fill(false);
    try {
      answer.full = fitPsychometric(answer.data, apart, options.file);
    } catch (const Error&) {
      // A condition needs what the others tell.
    }
    if (answer.full && settings.method == FitMethod::MaximumLikelihood &&
        answer.full->freeParameters > answer.fit.freeParameters)
      answer.ratio = likelihoodRatio(answer.fit, *answer.full);
  }
  const bool bootstrapped = method == IntervalMethod::Bootstrap || method == IntervalMethod::Bca;
  const auto draw = [&](bool fromFit) {
    return bootstrap(answer.data, answer.fit,
                     {answer.samples, options.seed, fromFit, std::max(1u, options.threads)});
  };
  std::vector<Replicate> replicates;
  if (options.goodness || (bootstrapped && parametric)) replicates = draw(true);
  if (options.goodness) answer.goodness = goodnessOfFit(answer.data, answer.fit, replicates);
  if (bootstrapped) {
    answer.intervals = bootstrapIntervals(answer.data, answer.fit, parametric ? replicates : draw(false),
                                          method == IntervalMethod::Bca, options.confidence);
  } else if (method == IntervalMethod::Observers) {
    throw Error("takes the pooled answers of a result store's observers", "--intervals observers",
                "of a table or a single observer take profile");
  } else if (method != IntervalMethod::None) {
    const auto intervals = method == IntervalMethod::Profile   ? profileIntervals
                           : method == IntervalMethod::Laplace ? laplaceIntervals
                                                               : posteriorIntervals;
    answer.intervals = intervals(answer.data, answer.fit, options.confidence);
  }
  return answer;
}

}  // namespace limen::analysis
