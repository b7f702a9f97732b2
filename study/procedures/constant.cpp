// SPDX-License-Identifier: BSD-3-Clause
// Method of constant stimuli: every stimulus as often as every other, in blocks of one repetition each, so
// that an interrupted session has shown all stimuli almost equally often.
#include <cmath>
#include <map>
#include <numeric>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/psychometrics/random.h"
#include "perception/psychometrics/standard_sigmoid.h"
#include "study/procedures/details.h"
#include "study/procedures/model_settings.h"
#include "study/procedures/settings_reader.h"

namespace limen::study {
namespace {

using nlohmann::json;

struct ConstantDetail : ProcedureDetail, std::enable_shared_from_this<ConstantDetail> {
  std::vector<psychometrics::GridAxis> stimulus;
  int repetitions = 10, outcomes = 2;
  bool shuffled = true;

  std::unique_ptr<Procedure> make(uint64_t seed) const override;
  json toJson() const override {
    return {{"stimulus", study::toJson(stimulus)},
            {"repetitions", repetitions},
            {"outcomes", outcomes},
            {"order", shuffled ? "shuffled" : "listed"}};
  }
};

// Wilson's score interval for k successes of n (Wilson 1927), z the two-sided normal quantile.
std::pair<double, double> wilson(double k, double n, double z) {
  const double p = k / n, scale = 1.0 / (1.0 + z * z / n);
  const double centre = scale * (p + z * z / (2.0 * n));
  const double half = scale * z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

class Constant : public Procedure {
 public:
  Constant(std::shared_ptr<const ConstantDetail> detail, uint64_t seed)
      : detail_(std::move(detail)), grid_(detail_->stimulus), seed_(seed) {
    for (int block = 0; block < detail_->repetitions; ++block) {
      std::vector<size_t> order(grid_.size());
      std::iota(order.begin(), order.end(), size_t{0});
      psychometrics::Random random(psychometrics::childSeed(seed, "block " + std::to_string(block)));
      if (detail_->shuffled) random.shuffle(order);
      sequence_.insert(sequence_.end(), order.begin(), order.end());
    }
  }

  std::optional<std::vector<double>> next() const override {
    const auto trial = static_cast<size_t>(trials_);
    if (trial >= sequence_.size()) return std::nullopt;
    return grid_.valuesOf(sequence_[trial]);
  }

  void update(const std::vector<double>& stimulus, int outcome) override {
    checkTrial(stimulus, outcome, grid_.dimensions(), detail_->outcomes);
    std::vector<int>& counts = counts_[stimulus];
    counts.resize(static_cast<size_t>(detail_->outcomes));
    ++counts[static_cast<size_t>(outcome)];
    ++trials_;
  }

  int trialsDone() const override { return trials_; }

  Estimate estimate(double level) const override {
    Estimate out;
    out.level = level;
    out.kind = "proportions, Wilson score interval";
    const double z =
        psychometrics::standardInverse(psychometrics::SigmoidFamily::Normal, 0.5 * (1.0 + level));
    for (const auto& [stimulus, counts] : counts_) {
      const double n = std::accumulate(counts.begin(), counts.end(), 0);
      for (size_t outcome = 1; outcome < counts.size(); ++outcome) {
        const double p = counts[outcome] / n;
        const auto [low, high] = wilson(counts[outcome], n, z);
        out.parameters.push_back({nameOf(stimulus, outcome), p, p, p, low, high, ""});
      }
    }
    return out;
  }

  json state() const override {
    json counts = json::array();
    for (const auto& [stimulus, numbers] : counts_)
      counts.push_back({{"stimulus", stimulus}, {"outcomes", numbers}});
    return {{"trials", trials_}, {"seed", seed_}, {"counts", counts}};
  }

 private:
  // "P(1 | contrast=0.1, speed=2)"
  std::string nameOf(const std::vector<double>& stimulus, size_t outcome) const {
    std::vector<std::string> parts;
    for (size_t d = 0; d < stimulus.size(); ++d) {
      parts.push_back(grid_.axes()[d].name + "=" + shortestNumber(stimulus[d]));
    }
    return "P(" + std::to_string(outcome) + " | " + join(parts) + ")";
  }

  std::shared_ptr<const ConstantDetail> detail_;
  psychometrics::ProductGrid grid_;
  uint64_t seed_;
  std::vector<size_t> sequence_;
  std::map<std::vector<double>, std::vector<int>> counts_;
  int trials_ = 0;
};

std::unique_ptr<Procedure> ConstantDetail::make(uint64_t seed) const {
  return std::make_unique<Constant>(shared_from_this(), seed);
}

}  // namespace

ProcedureSettings readConstant(SettingsReader& reader) {
  auto detail = std::make_shared<ConstantDetail>();
  detail->stimulus =
      readStimulusAxes(reader.required("stimulus", "the values to be shown"), reader.at("stimulus"));
  detail->repetitions = reader.integerOr("repetitions", 10, 1, 100'000);
  detail->outcomes = reader.integerOr("outcomes", 2, 2, 100);
  detail->shuffled = reader.choiceOr("order", "shuffled", {"shuffled", "listed"}) == "shuffled";
  reader.finish();
  const double trials =
      static_cast<double>(psychometrics::ProductGrid(detail->stimulus).size()) * detail->repetitions;
  if (trials > 1e6) {
    throw Error(shortestNumber(trials) + " trials", reader.at("repetitions"), "give at most a million");
  }
  ProcedureSettings out;
  out.type = "constant";
  out.stimulus = dimensionsOf(detail->stimulus);
  out.outcomes = detail->outcomes;
  out.mostTrials = static_cast<int>(trials);
  out.detail = std::move(detail);
  return out;
}

const char* describeConstant() {
  return "constant: method of constant stimuli; every stimulus once per block, each block shuffled "
         "separately\n"
         "    stimulus      as for quest_plus; every combination of several dimensions is shown\n"
         "    repetitions   blocks (default 10)\n"
         "    order         shuffled (default) or listed\n"
         "    outcomes      number of outcomes (default 2)\n"
         "    Estimate: proportion of each outcome for each stimulus with Wilson's (1927) score interval.\n";
}

}  // namespace limen::study
