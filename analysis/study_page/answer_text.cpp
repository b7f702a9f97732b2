// SPDX-License-Identifier: BSD-3-Clause
// The answer to a protocol's question, in one sentence.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

/// An estimate of a condition, with its interval.
struct Named {
  std::string name;
  double value = 0.0;
  std::optional<Interval> interval;
};

constexpr size_t kAll = 4;  ///< conditions that are all named; of more the least and the most

std::string numberText(double value) { return fmt::format("{:.3g}", value); }

std::string oneText(const Named& one, bool percent) {
  const auto value = [&](double v) { return percent ? percentText(v) : numberText(v); };
  std::string out = value(one.value);
  if (one.interval && one.interval->low < one.interval->high)
    out += fmt::format(" [{} to {}]", value(one.interval->low), value(one.interval->high));
  return one.name.empty() ? out : out + " for " + one.name;
}

std::string allText(std::vector<Named> all, bool percent) {
  const bool some = all.size() > kAll;
  if (some) {
    std::stable_sort(all.begin(), all.end(),
                     [](const Named& a, const Named& b) { return a.value < b.value; });
    all = {all.front(), all.back()};
  }
  std::vector<std::string> words;
  for (const Named& one : all) words.push_back(oneText(one, percent));
  if (some) return "from " + words[0] + " to " + words[1];
  const bool commas = std::any_of(all.begin(), all.end(),
                                  [](const Named& one) { return one.name.find(',') != std::string::npos; });
  return commas ? join(words, "; ") : listed(words);
}

/// Of an adaptive part.
std::string thresholdText(const StudyPage& page, const StudyPart& part) {
  for (const PartThresholds& one : page.thresholds) {
    if (one.part != part.name) continue;
    std::vector<Named> all;
    for (const ThresholdCondition& condition : one.conditions)
      if (condition.mean)
        all.push_back({conditionTitle(part, condition.levels), *condition.mean, condition.interval});
    if (!all.empty())
      return fmt::format("the threshold of {}, mean over {}, is {}", one.title,
                         counted(page.study.observers.size(), "observer"), allText(std::move(all), false));
  }
  return "";
}

/// `extremes`: also the conditions with the least and the most.
std::string rateText(const StudyPage& page, const StudyPart& part, bool extremes) {
  const RateRow *change = nullptr, *catches = nullptr;
  std::vector<Named> conditions;
  for (const RateRow& row : page.rates.rows) {
    if (row.part != part.name) continue;
    if (row.scope == RateScope::Part) (row.change ? change : catches) = &row;
    const RateScope finest = part.factors.size() > 1 ? RateScope::Condition : RateScope::Level;
    if (row.scope == finest && row.change && !row.condition.empty())
      conditions.push_back(
          {conditionTitle(part, row.condition), row.overObservers.mean, row.overObservers.interval});
  }
  if (!change) return "";
  std::string out =
      fmt::format("{} {} {} of the trials with one", counted(change->overObservers.subjects, "observer"),
                  part.asksYesNo() ? "reported a change in" : "found the change in",
                  oneText({"", change->overObservers.mean, change->overObservers.interval}, true));
  if (catches) out += fmt::format(" and {} of those without", percentText(catches->overObservers.mean));
  if (extremes && conditions.size() > 1) out += ": " + allText(std::move(conditions), true);
  return out;
}

/// Of a part with constant stimuli of a numeric variable.
std::string functionText(const StudyPage& page, const StudyPart& part) {
  for (const PartFit& one : page.fits) {
    if (one.part != part.name || !one.answer) continue;
    const FitAnswer& answer = *one.answer;
    std::vector<Named> all;
    for (size_t c = 0; c < answer.fit.conditions.size(); ++c) {
      const ConditionFit& fit = answer.fit.conditions[c];
      const size_t threshold = indexOf(FitParameter::Threshold);
      if (fit.atBound[threshold] != 0) continue;
      Named own{
          c < answer.levels.size() ? conditionTitle(part, answer.levels[c]) : "", fit.values[threshold], {}};
      if (answer.intervals && answer.intervals->conditions[c][threshold])
        own.interval = *answer.intervals->conditions[c][threshold];
      all.push_back(std::move(own));
    }
    if (!all.empty())
      return fmt::format("the threshold of {} (F = {:.3g}) of their pooled answers is {}",
                         part.titleOf(answer.level), answer.fit.settings.thresholdLevel,
                         allText(std::move(all), false));
  }
  return "";
}

std::string scaleText(const StudyPage& page, const StudyPart& part) {
  for (const PartScale& one : page.scales)
    if (one.part == part.name && one.scale && one.scale->items.size() > 1)
      return fmt::format("of {}, {} was preferred most and {} least",
                         counted(one.scale->items.size(), "item"), levelTitle(one.scale->items.front().name),
                         levelTitle(one.scale->items.back().name));
  return "";
}

}  // namespace

std::string answerText(const StudyPage& page) {
  std::vector<std::string> sentences;
  for (const StudyPart& part : page.study.plan.parts) {
    const std::string function = part.adaptive ? thresholdText(page, part) : functionText(page, part);
    std::vector<std::string> words = {function, scaleText(page, part)};
    if (!part.adaptive) words.insert(words.begin(), rateText(page, part, function.empty()));
    std::erase(words, "");
    if (words.empty()) continue;
    std::string own = words.front();
    for (size_t i = 1; i < words.size(); ++i) own += "; " + words[i];
    sentences.push_back((page.study.plan.parts.size() > 1 ? "part " + part.name + ": " : "") + own);
  }
  if (sentences.empty()) return "";
  std::string out = page.study.simulated > 0 ? "Of simulated observers: " : "";
  for (size_t i = 0; i < sentences.size(); ++i) out += (i > 0 ? "; " : "") + sentences[i];
  if (page.study.simulated == 0) out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  return out + (out.find('[') == std::string::npos ? "." : " (in brackets: 95 % intervals over observers).");
}

}  // namespace limen::analysis
