// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/pair_scales/scale.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/statistics/distributions.h"
#include "analysis/statistics/multiple_comparisons.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/psychometrics/random.h"

namespace limen::analysis {
namespace {

std::vector<int64_t> countWins(const PairGroup& group) {
  std::vector<int64_t> wins(group.items.size() * group.items.size());
  for (const PairJudgement& one : group.judgements)
    wins[one.winner * group.items.size() + one.loser] += one.count;
  return wins;
}

/// Values of all items for each sample of the bootstrap.
struct Draws {
  ScaleBootstrap of = ScaleBootstrap::None;
  std::vector<std::vector<double>> values;
  size_t penalised = 0, skipped = 0;
};

Draws drawSubjects(const PairGroup& group, PairwiseOptions options, const BootstrapSetting& setting) {
  const size_t items = group.items.size();
  std::vector<std::vector<const PairJudgement*>> own(group.subjects.size());
  for (const PairJudgement& one : group.judgements) own[one.subject].push_back(&one);
  Draws out{ScaleBootstrap::Subjects, {}, 0, 0};
  options.unbounded = UnboundedScale::kPenalise;
  options.resamples = 0;
  psychometrics::Random random(psychometrics::childSeed(setting.seed, group.name));
  for (size_t sample = 0; sample < setting.samples; ++sample) {
    std::vector<int64_t> wins(items * items);
    for (size_t i = 0; i < own.size(); ++i)
      for (const PairJudgement* one : own[random.below(own.size())])
        wins[one->winner * items + one->loser] += one->count;
    try {
      const PairwiseScale scale = scalePairs(wins, items, options);
      out.penalised += scale.penalised ? 1 : 0;
      out.values.push_back(scale.values);
    } catch (const Error&) {
      ++out.skipped;  // those drawn did not judge pairs that join all items
    }
  }
  return out;
}

Draws drawSamples(const PairGroup& group, const PairwiseOptions& options, const ScaleSetting& setting,
                  const PairwiseScale& fit, std::vector<std::string>& notes) {
  if (setting.bootstrap.samples == 0) return {};
  if (group.subjects.empty())
    return {ScaleBootstrap::Judgements, fit.bootstrapValues, static_cast<size_t>(fit.penalisedResamples), 0};
  if (const std::string note = noteOnClusters(group.subjects.size(), "subjects"); !note.empty())
    notes.push_back(note);
  if (group.subjects.size() < kLeastClusters) return {};
  return drawSubjects(group, options, setting.bootstrap);
}

/// Interval of what `of` makes of each sample; none without a bootstrap.
template <class Of>
std::optional<ResampledInterval> drawnInterval(const Draws& draws, const BootstrapSetting& setting, Of of) {
  if (draws.of == ScaleBootstrap::None) return {};
  std::vector<double> values;
  for (const std::vector<double>& sample : draws.values) values.push_back(of(sample));
  return percentileInterval(values, setting);
}

class GroupScale {
 public:
  GroupScale(const PairGroup& group, const ScaleSetting& setting)
      : group_(group), setting_(setting), wins_(countWins(group)) {
    if (!setting.reference.empty()) {
      const auto found = std::find(group.items.begin(), group.items.end(), setting.reference);
      if (found == group.items.end())
        throw Error("no item '" + setting.reference + "'" + (group.name.empty() ? "" : " in " + group.name),
                    "--reference", suggest(setting.reference, group.items));
      reference_ = static_cast<size_t>(found - group.items.begin());
    }
    PairwiseOptions options;
    options.model = setting.model;
    options.unbounded = setting.unbounded;
    options.priorDeviation = setting.priorDeviation;
    options.seed = psychometrics::childSeed(setting.bootstrap.seed, group.name);
    options.resamples = group.subjects.empty() ? static_cast<int>(setting.bootstrap.samples) : 0;
    options.names = group.items;
    out_.name = group.name;
    try {
      out_.fit = scalePairs(wins_, group.items.size(), options);
    } catch (const Error& error) {
      throw Error(error.message(), group.name.empty() ? "judgements" : "judgements of " + group.name,
                  error.hint());
    }
    draws_ = drawSamples(group, options, setting, out_.fit, out_.notes);
    out_.bootstrap = draws_.of;
    out_.penalised = draws_.penalised;
    out_.skipped = draws_.skipped;
    z_ = criticalZ(setting.bootstrap.level);
  }

  ItemScale scale() {
    std::vector<size_t> order(group_.items.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return out_.fit.values[a] > out_.fit.values[b]; });
    for (const size_t item : order) out_.items.push_back(describeItem(item));
    for (size_t i = 0; i + 1 < order.size(); ++i) out_.steps.push_back(describeStep(order[i], order[i + 1]));
    if (out_.steps.size() > 1) adjustHolm(out_.steps, &ItemStep::p, &ItemStep::holm);
    out_.subjects = group_.subjects.size();
    out_.judgements = group_.judged;
    out_.consistency = subjectConsistencies(group_);
    if (group_.ordered && group_.judged > 0)
      out_.firstChosen = detectionRate(group_.firstChosen, group_.judged, setting_.bootstrap.level);
    return std::move(out_);
  }

 private:
  double errorOfDifference(size_t a, size_t b) const {
    const std::vector<double>& c = out_.fit.covariance;
    const size_t n = group_.items.size();
    return std::sqrt(std::max(0.0, c[a * n + a] + c[b * n + b] - 2.0 * c[a * n + b]));
  }

  ScaledItem describeItem(size_t item) const {
    const size_t n = group_.items.size();
    ScaledItem out;
    out.name = group_.items[item];
    for (size_t other = 0; other < n; ++other) {
      out.chosen += wins_[item * n + other];
      out.judged += wins_[item * n + other] + wins_[other * n + item];
    }
    out.value = out_.fit.values[item];
    out.standardError = out_.fit.standardErrors[item];
    if (reference_) {
      out.value -= out_.fit.values[*reference_];
      out.standardError = errorOfDifference(item, *reference_);
      out.preferred = predictPreference(setting_.model, out.value);
    }
    if (reference_ == item) {
      out.standardError.reset();
      out.preferred.reset();
      return out;
    }
    out.interval = around(out.value, z_ * *out.standardError);
    out.bootstrap = drawnInterval(draws_, setting_.bootstrap, [&](const std::vector<double>& sample) {
      return sample[item] - (reference_ ? sample[*reference_] : 0.0);
    });
    if (reference_) {
      const Interval ends =
          out.bootstrap && out.bootstrap->interval ? *out.bootstrap->interval : *out.interval;
      out.preferredInterval =
          Interval{predictPreference(setting_.model, ends.low), predictPreference(setting_.model, ends.high)};
    }
    return out;
  }

  ItemStep describeStep(size_t upper, size_t lower) const {
    const size_t n = group_.items.size();
    ItemStep out;
    out.upper = group_.items[upper];
    out.lower = group_.items[lower];
    out.difference = out_.fit.values[upper] - out_.fit.values[lower];
    out.standardError = errorOfDifference(upper, lower);
    out.interval = around(out.difference, z_ * out.standardError);
    if (!out_.fit.penalised && out.standardError > 0.0) {
      out.z = out.difference / out.standardError;
      out.p = normalTwoSided(*out.z);
    }
    out.bootstrap = drawnInterval(draws_, setting_.bootstrap, [&](const std::vector<double>& sample) {
      return sample[upper] - sample[lower];
    });
    out.preferred = predictPreference(setting_.model, out.difference);
    out.chosen = wins_[upper * n + lower];
    out.judged = out.chosen + wins_[lower * n + upper];
    return out;
  }

  const PairGroup& group_;
  const ScaleSetting& setting_;
  std::vector<int64_t> wins_;
  std::optional<size_t> reference_;
  Draws draws_;
  double z_ = 0.0;
  ItemScale out_;
};

}  // namespace

Scales scaleItems(const std::vector<PairGroup>& groups, const ScaleSetting& setting) {
  Scales out{setting, {}, {}};
  for (const PairGroup& group : groups) out.groups.push_back(GroupScale(group, setting).scale());
  return out;
}

}  // namespace limen::analysis
