// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/scene_needs/needs_record.h"

#include <fmt/format.h>

#include <algorithm>

namespace limen::techniques {
namespace {

/// All candidates come from few families, which the last part of a technique's name tells apart.
std::string line(const Tried& tried) {
  std::string name = describe(tried.candidate);
  name.erase(0, tried.candidate.technique.rfind('/') + 1);
  return fmt::format("{:.3g} ms, {:.3g}: {}", tried.time.medianMs, tried.error.value(), name);
}

std::string targetRemark(const SceneNeedsFound& found) {
  const std::string target = fmt::format("{} {:.3g}", measureOf(found.target), largestOf(found.target));
  if (isJnd(found.target))
    return found.verdict.withinTarget
               ? fmt::format(
                     "{} of {} candidates stay within the target, {}: the cheapest of them was chosen",
                     found.verdict.eligible.size(), found.tried.size(), target)
               : fmt::format("no candidate stays within the target, {}: the most exact one was chosen",
                             target);
  if (!found.verdict.withinTarget)
    return fmt::format(
        "no candidate stays within the target, {} less {:.2g} % for the choice of pixels: the "
        "most exact one was chosen",
        target, 100.0 * margin(found.tried));
  return fmt::format(
      "{} of {} candidates stay within the target, {}, with {:.2g} % to spare for the choice "
      "of "
      "pixels: the cheapest of them was chosen",
      found.verdict.eligible.size(), found.tried.size(), target, 100.0 * margin(found.tried));
}

bool checkHolds(const FullSizeCheck& check, const NeedsTarget& target) {
  return check.error.value() <= largestOf(target);
}

std::string referenceRemark(const SceneNeedsFound& found) {
  if (found.samples.empty()) return "errors are those against an exact reference";
  if (isJnd(found.target))
    return fmt::format(
        "visible differences are those from the mean of two references of {} {}, and of {} in the check, "
        "each with other rays; between the two references {:.2g} and {:.2g} are seen",
        found.reference.samples, found.samples, found.reference.checkSamples, found.referenceNoise,
        found.check.referenceNoise);
  return fmt::format(
      "errors are those against two references of {} {} in the small picture and {} at full size, each with "
      "other rays; their own noise, an RMS of {:.2g} and {:.2g}, is removed",
      found.reference.samples, found.samples, found.reference.checkSamples, found.referenceNoise,
      found.check.referenceNoise);
}

/// The candidates that no other beats, one a sentence, then the others in one.
void addTried(std::vector<std::string>& out, const std::vector<Tried>& tried, const std::string& measure,
              const std::string& where) {
  const std::vector<size_t> best = front(tried);
  std::vector<size_t> beaten;
  for (size_t i = 0; i < tried.size(); ++i)
    if (std::find(best.begin(), best.end(), i) == best.end()) beaten.push_back(i);
  std::sort(beaten.begin(), beaten.end(),
            [&](size_t a, size_t b) { return tried[a].time.medianMs < tried[b].time.medianMs; });
  for (const size_t i : best)
    out.push_back(where + "not beaten in time and " + measure + ": " + line(tried[i]));
  std::string others;
  for (const size_t i : beaten) others += (others.empty() ? "" : "; ") + line(tried[i]);
  if (!others.empty())
    out.push_back(where + "beaten, as another is no worse in time and " + measure + ": " + others);
}

}  // namespace

std::string checkRemark(const FullSizeCheck& check, const NeedsTarget& target) {
  return fmt::format("at full size: {:.3g} ms (from {:.3g} to {:.3g}), {} {:.3g} (from {:.3g} to {:.3g}): {}",
                     check.time.medianMs, check.time.lowMs, check.time.highMs, measureOf(target),
                     check.error.value(), check.error.low(), check.error.high(),
                     checkHolds(check, target) ? "the target is met" : "the target is missed");
}

std::vector<std::string> wholeSetRemarks(const WholeSetCheck& check, const NeedsTarget& target) {
  const Tried &choice = check.tried[check.choice], &best = check.tried[check.best.chosen];
  std::vector<std::string> out = {
      check.choice == check.best.chosen
          ? fmt::format("of all {} candidates at full size none is better", check.tried.size())
          : fmt::format(
                "of all {} candidates at full size the best is {}: {:.3g} ms and {} {:.3g}, the choice "
                "{:.3g} ms and {:.3g}",
                check.tried.size(), describe(best.candidate), best.time.medianMs, measureOf(target),
                best.error.value(), choice.time.medianMs, choice.error.value())};
  addTried(out, check.tried, measureOf(target), "at full size ");
  for (const std::string& reason : check.notTried) out.push_back("not tried at full size: " + reason);
  return out;
}

std::vector<std::string> remarksOn(const SceneNeedsFound& found) {
  const Tried& chosen = found.chosen();
  const ErrorEstimate& error = chosen.error;
  const std::string measure = measureOf(found.target);
  std::vector<std::string> out = {
      "chosen: " + describe(chosen.candidate),
      targetRemark(found),
      fmt::format("in {} x {} pixels: {} {:.3g} (from {:.3g} to {:.3g}); timed at {:.3g} ms (from {:.3g} to "
                  "{:.3g})",
                  found.pictureSizePx.x, found.pictureSizePx.y, measure, error.value(), error.low(),
                  error.high(), chosen.time.medianMs, chosen.time.lowMs, chosen.time.highMs),
      checkRemark(found.check, found.target),
      referenceRemark(found),
      "times are medians of the " + found.times + ", from the lower to the upper quartile"};
  addTried(out, found.tried, measure, "");
  for (const std::string& reason : found.notTried) out.push_back("not tried: " + reason);
  if (found.wholeSet)
    for (std::string& remark : wholeSetRemarks(*found.wholeSet, found.target))
      out.push_back(std::move(remark));
  return out;
}

std::vector<Counter> checkCounters(const FullSizeCheck& check, const NeedsTarget& target) {
  const std::string unit = isJnd(target) ? "_jnd" : "_rmse";
  return {{"target" + unit, largestOf(target)},
          {"check" + unit, check.error.value()},
          {"check" + unit + "_limit", check.error.high()},
          {"check_ms", check.time.medianMs},
          {isJnd(target) ? "check_noise_jnd" : "check_noise", check.referenceNoise},
          {"target_met", checkHolds(check, target) ? 1.0 : 0.0}};
}

std::vector<Counter> countersOf(const SceneNeedsFound& found) {
  const Tried& chosen = found.chosen();
  const double within = found.verdict.withinTarget ? double(found.verdict.eligible.size()) : 0.0;
  const std::string unit = isJnd(found.target) ? "_jnd" : "_rmse";
  std::vector<Counter> out = checkCounters(found.check, found.target);
  out.insert(out.end(), {{"expected" + unit, chosen.error.value()},
                         {"expected" + unit + "_limit", chosen.error.high()},
                         {"expected_ms", chosen.time.medianMs},
                         {"candidates", double(found.tried.size())},
                         {"candidates_within_target", within}});
  if (found.wholeSet)
    for (Counter& counter : wholeSetCounters(*found.wholeSet, found.target))
      out.push_back(std::move(counter));
  return out;
}

std::vector<Counter> wholeSetCounters(const WholeSetCheck& check, const NeedsTarget& target) {
  const Tried& best = check.tried[check.best.chosen];
  const std::string unit = isJnd(target) ? "_jnd" : "_rmse";
  return {{"best_ms", best.time.medianMs},
          {"best" + unit, best.error.value()},
          {"regret_ms", check.regretMs()},
          {"regret" + unit, check.regretError()},
          {"regret_time_share", check.regretMs() / best.time.medianMs},
          {"best_within_target", check.best.withinTarget ? 1.0 : 0.0},
          {"candidates_at_full_size", double(check.tried.size())}};
}

std::vector<Quantity> wholeSetQuantities() {
  constexpr Direction kNeither = Direction::Neither, kLower = Direction::LowerIsBetter;
  return {
      {"best_ms", "Frame time of the best candidate at full size", "ms", kLower},
      {"best_rmse", "RMSE of the best candidate at full size", "", kLower},
      {"best_jnd", "Visible difference of the best candidate at full size", "JND", kLower},
      {"regret_ms", "Frame time of the choice beyond the best candidate's", "ms", kLower},
      {"regret_rmse", "RMSE of the choice beyond the best candidate's", "", kLower},
      {"regret_jnd", "Visible difference of the choice beyond the best candidate's", "JND", kLower},
      {"regret_time_share", "Frame time of the choice beyond the best's, share of the best's", "", kLower},
      {"best_within_target", "Target met by the best candidate (1: yes)", "", Direction::HigherIsBetter},
      {"candidates_at_full_size", "Candidates tried at full size", "", kNeither}};
}

std::vector<Quantity> needsQuantities() {
  constexpr Direction kNeither = Direction::Neither, kLower = Direction::LowerIsBetter;
  return {{"target_rmse", "Target of the RMSE", "", kNeither},
          {"expected_rmse", "RMSE in the small picture", "", kLower},
          {"expected_rmse_limit", "RMSE in the small picture, upper limit", "", kLower},
          {"expected_ms", "Frame time when chosen", "ms", kLower},
          {"check_rmse", "RMSE in the check at full size", "", kLower},
          {"check_rmse_limit", "RMSE in the check at full size, upper limit", "", kLower},
          {"check_ms", "Frame time in the check at full size", "ms", kLower},
          {"check_noise", "Noise of the check's reference, removed", "", kNeither},
          {"target_jnd", "Target of the visible difference", "JND", kNeither},
          {"expected_jnd", "Visible difference when chosen", "JND", kLower},
          {"expected_jnd_limit", "Visible difference when chosen, upper limit", "JND", kLower},
          {"check_jnd", "Visible difference in the check", "JND", kLower},
          {"check_jnd_limit", "Visible difference in the check, upper limit", "JND", kLower},
          {"check_noise_jnd", "Visible noise of the check's reference", "JND", kNeither},
          {"target_met", "Target met in the check (1: yes)", "", Direction::HigherIsBetter},
          {"candidates", "Candidates tried", "", kNeither},
          {"candidates_within_target", "Candidates within the target", "", kNeither}};
}

}  // namespace limen::techniques
