// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/scene_needs/needs_record.h"

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

bool checkHolds(const SceneNeedsFound& found) { return found.check.error.value() <= largestOf(found.target); }

std::string checkRemark(const SceneNeedsFound& found) {
  const FullSizeCheck& check = found.check;
  return fmt::format("at full size: {:.3g} ms (from {:.3g} to {:.3g}), {} {:.3g} (from {:.3g} to {:.3g}): {}",
                     check.time.medianMs, check.time.lowMs, check.time.highMs, measureOf(found.target),
                     check.error.value(), check.error.low(), check.error.high(),
                     checkHolds(found) ? "the target is met" : "the target is missed");
}

}  // namespace

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
      checkRemark(found),
      isJnd(found.target)
          ? fmt::format(
                "visible differences are those from the mean of two references of {} rays per receiver, "
                "and of {} in the check, each with other rays; between the two references {:.2g} and "
                "{:.2g} are seen",
                found.reference.samples, found.reference.checkSamples, found.referenceNoise,
                found.check.referenceNoise)
          : fmt::format(
                "errors are those against two references of {} rays per receiver in the small picture and {} "
                "at "
                "full size, each with other rays; their own noise, an RMS of {:.2g} and {:.2g}, is removed",
                found.reference.samples, found.reference.checkSamples, found.referenceNoise,
                found.check.referenceNoise),
      "times are medians of the " + found.times + ", from the lower to the upper quartile"};
  const std::vector<size_t> best = front(found.tried);
  std::vector<size_t> beaten;
  for (size_t i = 0; i < found.tried.size(); ++i)
    if (std::find(best.begin(), best.end(), i) == best.end()) beaten.push_back(i);
  std::sort(beaten.begin(), beaten.end(),
            [&](size_t a, size_t b) { return found.tried[a].time.medianMs < found.tried[b].time.medianMs; });
  for (const size_t i : best)
    out.push_back("not beaten in time and " + measure + ": " + line(found.tried[i]));
  std::string others;
  for (const size_t i : beaten) others += (others.empty() ? "" : "; ") + line(found.tried[i]);
  if (!others.empty()) out.push_back("beaten, as another is no worse in time and " + measure + ": " + others);
  for (const std::string& reason : found.notTried) out.push_back("not tried: " + reason);
  return out;
}

std::vector<Counter> countersOf(const SceneNeedsFound& found) {
  const Tried& chosen = found.chosen();
  const double within = found.verdict.withinTarget ? double(found.verdict.eligible.size()) : 0.0;
  const std::string unit = isJnd(found.target) ? "_jnd" : "_rmse";
  return {{"target" + unit, largestOf(found.target)},
          {"expected" + unit, chosen.error.value()},
          {"expected" + unit + "_limit", chosen.error.high()},
          {"expected_ms", chosen.time.medianMs},
          {"check" + unit, found.check.error.value()},
          {"check" + unit + "_limit", found.check.error.high()},
          {"check_ms", found.check.time.medianMs},
          {isJnd(found.target) ? "check_noise_jnd" : "check_noise", found.check.referenceNoise},
          {"target_met", checkHolds(found) ? 1.0 : 0.0},
          {"candidates", double(found.tried.size())},
          {"candidates_within_target", within}};
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
