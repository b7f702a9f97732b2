// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "analysis/study/answers.h"
#include "analysis/study/lapse_rule.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

/// Removes single answers and says for each observer how many.
template <class Hits>
void leaveOutAnswers(StudyAnswers& study, const ExclusionRule& rule, Hits hits) {
  std::vector<size_t> counts(study.observers.size());
  const auto end = std::remove_if(study.answers.begin(), study.answers.end(), [&](const StudyAnswer& answer) {
    if (!hits(answer)) return false;
    ++counts[answer.observer];
    return true;
  });
  study.answers.erase(end, study.answers.end());
  for (size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) study.leftOut.push_back({rule.name, study.observers[i], counts[i], "single answers"});
}

/// Removes observers, so that those left are numbered without gaps.
void leaveOutObservers(StudyAnswers& study, const ExclusionRule& rule,
                       const std::map<size_t, std::string>& reasons) {
  if (reasons.empty()) return;
  std::vector<std::string> kept;
  std::vector<size_t> renumbered(study.observers.size());
  std::vector<size_t> counts(study.observers.size());
  for (const StudyAnswer& answer : study.answers) ++counts[answer.observer];
  for (size_t i = 0; i < study.observers.size(); ++i) {
    const auto reason = reasons.find(i);
    if (reason != reasons.end()) {
      study.leftOut.push_back({rule.name, study.observers[i], counts[i], reason->second});
      continue;
    }
    renumbered[i] = kept.size();
    kept.push_back(study.observers[i]);
  }
  const auto end = std::remove_if(study.answers.begin(), study.answers.end(), [&](const StudyAnswer& answer) {
    return reasons.count(answer.observer) != 0;
  });
  study.answers.erase(end, study.answers.end());
  for (StudyAnswer& answer : study.answers) answer.observer = renumbered[answer.observer];
  study.observers = std::move(kept);
}

std::map<size_t, std::string> aboveCatchRate(const StudyAnswers& study, double limit) {
  std::vector<size_t> yes(study.observers.size()), trials(study.observers.size());
  for (const StudyAnswer& answer : study.answers) {
    if (answer.change || !study.plan.parts[answer.part].asksYesNo()) continue;
    ++trials[answer.observer];
    yes[answer.observer] += answer.outcome == 1 ? 1 : 0;
  }
  std::map<size_t, std::string> out;
  for (size_t i = 0; i < yes.size(); ++i)
    // A quotient, unlike a product, is rounded as the limit was when it was read.
    if (trials[i] > 0 && static_cast<double>(yes[i]) / static_cast<double>(trials[i]) > limit)
      out[i] = fmt::format("yes in {} of {} catch trials", yes[i], trials[i]);
  return out;
}

/// Who lapses more often than the limit; what could not be told becomes the rule's note.
std::map<size_t, std::string> aboveLapseRate(const StudyAnswers& study, AppliedRule& applied) {
  std::map<size_t, std::string> out;
  applied.applied = false;
  if (!(applied.limit > 0.0 && applied.limit < 1.0)) {
    applied.note = "a limit lies between 0 and 1";
    return out;
  }
  const LapseRates rates = lapseRates(study, applied.limit);
  std::vector<std::string> untold;
  for (size_t i = 0; i < rates.observers.size(); ++i) {
    const ObserverLapse& one = rates.observers[i];
    if (one.verdict == ObserverLapse::Verdict::Untold)
      untold.push_back(study.observers[i] + (one.rate ? fmt::format(" ({:.2f})", *one.rate) : ""));
    if (one.verdict == ObserverLapse::Verdict::Above)
      out[i] = fmt::format("lapse rate {:.3f}; the limit fits worse by a likelihood ratio of {:.1f}",
                           *one.rate, one.statistic);
  }
  const size_t count = untold.size();
  applied.applied = count < rates.observers.size();
  if (!rates.why.empty()) {
    applied.note = rates.why;
  } else if (count > 0) {
    constexpr size_t kListed = 12;
    if (count > kListed) untold.resize(kListed);
    applied.note = fmt::format(
        "answers of {} of {} observers do not tell whether their lapse rate is above (the rate that fits "
        "best in brackets): {}{}",
        count, rates.observers.size(), join(untold), count > kListed ? ", ..." : "");
  }
  return out;
}

}  // namespace

void applyExclusions(StudyAnswers& study) {
  const auto isOfAnswers = [](const ExclusionRule& rule) { return rule.name.rfind("reaction_time", 0) == 0; };
  for (const bool ofAnswers : {true, false})
    for (const ExclusionRule& rule : study.plan.exclusions) {
      if (isOfAnswers(rule) != ofAnswers) continue;
      AppliedRule applied{rule.name, rule.limit, true, ""};
      if (rule.name == "reaction_time_below_s") {
        leaveOutAnswers(study, rule,
                        [&](const StudyAnswer& answer) { return answer.reactionTimeS < rule.limit; });
      } else if (rule.name == "reaction_time_above_s") {
        leaveOutAnswers(study, rule,
                        [&](const StudyAnswer& answer) { return answer.reactionTimeS > rule.limit; });
      } else if (rule.name == "catch_rate_above") {
        leaveOutObservers(study, rule, aboveCatchRate(study, rule.limit));
      } else if (rule.name == "lapse_above") {
        leaveOutObservers(study, rule, aboveLapseRate(study, applied));
      } else {
        applied.applied = false;
        applied.note = "this program does not know it";
      }
      study.rules.push_back(applied);
    }
}

}  // namespace limen::analysis
