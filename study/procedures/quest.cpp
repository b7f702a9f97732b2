// SPDX-License-Identifier: BSD-3-Clause
// QUEST (Watson and Pelli 1983, Perception and Psychophysics 33) in the form of Pelli's QuestCreate,
// QuestUpdate and QuestQuantile: one Weibull psychometric function of log10 intensity that is shifted along
// the axis, a normal prior on a grid around a guess, the next trial at a quantile (Pelli 1987), the mean
// (King-Smith et al. 1994) or the mode of the posterior. As in that program, the distance of a stimulus from
// the guess is rounded to the grain before its likelihood is looked up; unlike there, a stimulus outside the
// grid keeps its own likelihood.
#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/psychometrics/grid_posterior.h"
#include "perception/psychometrics/psychometric_function.h"
#include "study/procedures/details.h"
#include "study/procedures/settings_reader.h"

namespace limen::study {
namespace {

using nlohmann::json;
using psychometrics::GridAxis;
using psychometrics::GridPosterior;
using psychometrics::PsychometricFunction;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct QuestDetail : ProcedureDetail, std::enable_shared_from_this<QuestDetail> {
  std::string name = "stimulus", unit = "log10";
  double minimum = -kInfinity, maximum = kInfinity;
  double guess = 0.0, guessSd = 0.0, level = 0.82, beta = 3.5, delta = 0.01, gamma = 0.5, grain = 0.01,
         range = 5.0;
  std::string next = "quantile";
  std::optional<double> quantileOrder;
  StopRule stop;

  std::unique_ptr<Procedure> make(uint64_t seed) const override;
  json toJson() const override {
    json stimulus = {{"name", name}, {"unit", unit}};
    if (std::isfinite(minimum)) stimulus["minimum"] = minimum;
    if (std::isfinite(maximum)) stimulus["maximum"] = maximum;
    json out = {{"stimulus", stimulus},
                {"threshold_guess", guess},
                {"threshold_guess_sd", guessSd},
                {"threshold_probability", level},
                {"beta", beta},
                {"delta", delta},
                {"gamma", gamma},
                {"grain", grain},
                {"range", range},
                {"next", next},
                {"stop", study::toJson(stop)}};
    if (quantileOrder) out["quantile_order"] = *quantileOrder;
    return out;
  }

  /// P of a positive answer over log10 intensity relative to the threshold.
  PsychometricFunction function() const {
    const PsychometricFunction atZero = PsychometricFunction::watsonPelli(0.0, beta, delta, gamma);
    return PsychometricFunction::watsonPelli(-atZero.inverse(level), beta, delta, gamma);
  }
  // Steps of the grid on either side of the guess.
  int half() const { return static_cast<int>(std::ceil(range / grain / 2.0 - 1e-9)); }
  GridAxis axis() const {
    GridAxis out{"threshold", unit, {}, false};
    for (int i = -half(); i <= half(); ++i) out.values.push_back(guess + i * grain);
    return out;
  }
  std::vector<double> prior() const {
    std::vector<double> out;
    double sum = 0.0;
    for (int i = -half(); i <= half(); ++i) {
      const double z = i * grain / guessSd;
      out.push_back(std::exp(-0.5 * z * z));
      sum += out.back();
    }
    for (double& weight : out) weight /= sum;
    return out;
  }
};

// The most informative quantile for these asymptotes (Pelli 1987, computed as in QuestRecompute).
double bestQuantile(const PsychometricFunction& f, double range) {
  const double low = f.probability(-range), high = f.probability(range);
  const auto timesLog = [](double p) { return p * std::log(p + 1e-14); };
  const double difference = timesLog(high) - timesLog(low) + timesLog(1.0 - high) - timesLog(1.0 - low);
  const double best = 1.0 / (1.0 + std::exp(difference / (low - high)));
  return (best - low) / (high - low);
}

class Quest : public Procedure {
 public:
  explicit Quest(std::shared_ptr<const QuestDetail> detail)
      : detail_(std::move(detail)),
        function_(detail_->function()),
        order_(
            detail_->quantileOrder.value_or(bestQuantile(function_, 2.0 * detail_->half() * detail_->grain))),
        posterior_({detail_->axis()}, {detail_->prior()}) {}

  std::optional<std::vector<double>> next() const override {
    const StopRule& stop = detail_->stop;
    if (stop.trials > 0 && trials_ >= stop.trials) return std::nullopt;
    if (stop.sd > 0.0 && posterior_.standardDeviation(0) <= stop.sd) return std::nullopt;
    double stimulus = posterior_.mean(0);
    if (detail_->next == "quantile") stimulus = interpolatedQuantile();
    if (detail_->next == "mode") stimulus = posterior_.mode(0);
    return std::vector<double>{std::clamp(stimulus, detail_->minimum, detail_->maximum)};
  }

  void update(const std::vector<double>& stimulus, int outcome) override {
    checkTrial(stimulus, outcome, 1, 2);
    const double steps = std::round((stimulus[0] - detail_->guess) / detail_->grain);
    std::vector<double> likelihood(posterior_.size());
    for (size_t i = 0; i < likelihood.size(); ++i) {
      const double x = (steps + detail_->half() - static_cast<double>(i)) * detail_->grain;
      likelihood[i] = outcome == 1 ? function_.logProbability(x) : function_.logComplement(x);
    }
    if (!posterior_.update(likelihood.data())) {
      throw Error("outcome " + std::to_string(outcome) + " is impossible at every threshold of the grid", {},
                  "allow for guesses (gamma) and lapses (delta)");
    }
    ++trials_;
  }

  int trialsDone() const override { return trials_; }

  Estimate estimate(double level) const override {
    const psychometrics::CredibleInterval interval = posterior_.equalTailed(0, level);
    return {level,
            "equal-tailed credible interval",
            {{"threshold", posterior_.mean(0), posterior_.median(0), posterior_.mode(0), interval.low,
              interval.high, detail_->unit}}};
  }

  json state() const override { return {{"trials", trials_}, {"posterior", posterior_.hash()}}; }

 private:
  // As in QuestQuantile: linear between the points (value of the grid, sum of the probabilities up to and
  // including it), so that it lies half a grain above the quantile of the histogram.
  double interpolatedQuantile() const {
    const std::vector<double>& p = posterior_.probability();
    const std::vector<double>& x = posterior_.grid().axes()[0].values;
    double total = 0.0;
    for (double value : p) total += value;
    const double target = order_ * total;
    double below = 0.0, previousX = x.front();
    for (size_t i = 0; i < p.size(); ++i) {
      if (p[i] > 0.0 && below + p[i] >= target) {
        if (below == 0.0) return x[i];
        return previousX + (x[i] - previousX) * (target - below) / p[i];
      }
      if (p[i] > 0.0) previousX = x[i];
      below += p[i];
    }
    return x.back();
  }

  std::shared_ptr<const QuestDetail> detail_;
  PsychometricFunction function_;
  double order_;
  GridPosterior posterior_;
  int trials_ = 0;
};

std::unique_ptr<Procedure> QuestDetail::make(uint64_t /*seed*/) const {
  return std::make_unique<Quest>(shared_from_this());
}

void readStimulus(SettingsReader& reader, QuestDetail& detail) {
  if (!reader.has("stimulus")) return;
  SettingsReader stimulus(reader.required("stimulus", ""), reader.at("stimulus"));
  detail.name = stimulus.textOr("name", detail.name);
  detail.unit = stimulus.textOr("unit", detail.unit);
  detail.minimum = stimulus.numberOr("minimum", -kInfinity);
  detail.maximum = stimulus.numberOr("maximum", kInfinity);
  stimulus.finish();
  if (!(detail.minimum <= detail.maximum)) {
    throw Error("the minimum is above the maximum", stimulus.at("minimum"));
  }
}

}  // namespace

ProcedureSettings readQuest(SettingsReader& reader) {
  auto detail = std::make_shared<QuestDetail>();
  QuestDetail& d = *detail;
  readStimulus(reader, d);
  d.guess = reader.number("threshold_guess", -1e6, 1e6);
  d.guessSd = reader.number("threshold_guess_sd", 0.0, 1e6, true);
  d.beta = reader.numberOr("beta", d.beta, 0.0, 1e6, true);
  d.gamma = reader.numberOr("gamma", d.gamma, 0.0, 0.999);
  d.delta = reader.numberOr("delta", d.delta, 0.0, 0.999);
  d.level = reader.numberOr("threshold_probability", d.level);
  const double highest = 1.0 - d.delta * (1.0 - d.gamma);
  if (!(d.level > d.gamma && d.level < highest)) {
    throw Error(shortestNumber(d.level) + " is not between the asymptotes",
                reader.at("threshold_probability"),
                "give a number above " + shortestNumber(d.gamma) + " and below " + shortestNumber(highest));
  }
  d.grain = reader.numberOr("grain", d.grain, 1e-6, 1e6);
  d.range = reader.numberOr("range", d.range, 1e-6, 1e6);
  if (!(d.range / d.grain >= 2.0 && d.range / d.grain <= 1e6)) {
    throw Error("the range has " + shortestNumber(d.range / d.grain) + " grains", reader.at("range"),
                "make it 2 to a million of them");
  }
  d.next = reader.choiceOr("next", d.next, {"quantile", "mean", "mode"});
  if (reader.has("quantile_order")) d.quantileOrder = reader.number("quantile_order", 0.0, 1.0, true);
  d.stop = readStop(reader, {"trials", "sd"});
  reader.finish();
  ProcedureSettings out;
  out.type = "quest";
  out.stimulus = {{d.name, d.unit, d.minimum, d.maximum}};
  if (d.stop.trials > 0) out.mostTrials = d.stop.trials;
  out.detail = std::move(detail);
  return out;
}

const char* describeQuest() {
  return "quest: posterior of one threshold (Watson and Pelli 1983, Percept. Psychophys. 33; Pelli's "
         "QuestCreate)\n"
         "    stimulus      {name, unit, minimum, maximum}, in log10 units (default unit: log10); limits are "
         "optional\n"
         "    threshold_guess, threshold_guess_sd   mean and standard deviation of the normal prior, log10 "
         "units\n"
         "    threshold_probability   P at threshold (default 0.82)\n"
         "    beta          slope of the Weibull (default 3.5)\n"
         "    delta         probability of a blind answer (default 0.01)\n"
         "    gamma         probability that a blind answer is positive (default 0.5)\n"
         "    grain, range  step and width of the grid of thresholds (default 0.01 and 5)\n"
         "    next          quantile (default), mean or mode of the posterior\n"
         "    quantile_order   default: the most informative one (Pelli 1987)\n"
         "    stop          {trials, sd}: after this many trials, or once the posterior's SD is at or below "
         "sd\n";
}

}  // namespace limen::study
