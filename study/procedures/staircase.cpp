// SPDX-License-Identifier: BSD-3-Clause
// Up-down staircases: transformed (Levitt 1971) and weighted (Kaernbach 1991).
#include "study/procedures/staircase.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "study/procedures/details.h"
#include "study/procedures/settings_reader.h"
#include "study/procedures/student_t.h"

namespace limen::study {
namespace {

using nlohmann::json;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class StepScale { Linear, Log10, Decibel };

struct StaircaseDetail : ProcedureDetail, std::enable_shared_from_this<StaircaseDetail> {
  std::string name = "stimulus", unit;
  double start = 0.0, minimum = -kInfinity, maximum = kInfinity;
  int up = 1, down = 1;
  std::vector<double> steps, stepsUp;
  int reversalsPerStep = 1;
  StepScale scale = StepScale::Linear;
  bool harderIsLower = true;
  StopRule stop;
  int estimateReversals = 16;

  std::unique_ptr<Procedure> make(uint64_t seed) const override;
  json toJson() const override {
    json stimulus = {{"name", name}, {"start", start}};
    if (!unit.empty()) stimulus["unit"] = unit;
    if (std::isfinite(minimum)) stimulus["minimum"] = minimum;
    if (std::isfinite(maximum)) stimulus["maximum"] = maximum;
    return {{"stimulus", stimulus},
            {"up", up},
            {"down", down},
            {"steps", steps},
            {"steps_up", stepsUp},
            {"reversals_per_step", reversalsPerStep},
            {"scale", scale == StepScale::Linear  ? "linear"
                      : scale == StepScale::Log10 ? "log10"
                                                  : "db"},
            {"harder", harderIsLower ? "lower" : "higher"},
            {"stop", study::toJson(stop)},
            {"estimate_reversals", estimateReversals}};
  }

  double moved(double level, double step) const {
    double out = level;
    if (scale == StepScale::Linear) out = level + step;
    if (scale == StepScale::Log10) out = level * std::pow(10.0, step);
    if (scale == StepScale::Decibel) out = level * std::pow(10.0, step / 20.0);
    // Without explicit limits it still stays finite, and above 0 if steps multiply.
    const double lowest = scale == StepScale::Linear ? -1e300 : 1e-300;
    return std::clamp(out, std::max(minimum, lowest), std::min(maximum, 1e300));
  }
};

class Staircase : public Procedure {
 public:
  explicit Staircase(std::shared_ptr<const StaircaseDetail> detail)
      : detail_(std::move(detail)), level_(detail_->start) {}

  std::optional<std::vector<double>> next() const override {
    const StopRule& stop = detail_->stop;
    if (stop.trials > 0 && trials_ >= stop.trials) return std::nullopt;
    if (stop.reversals > 0 && static_cast<int>(reversals_.size()) >= stop.reversals) return std::nullopt;
    return std::vector<double>{level_};
  }

  void update(const std::vector<double>& stimulus, int outcome) override {
    checkTrial(stimulus, outcome, 1, 2);
    if (detail_->scale != StepScale::Linear && !(stimulus[0] > 0.0)) {
      throw Error("the trial's stimulus is not above 0", {},
                  "a staircase with steps in ratios needs one that is");
    }
    ++trials_;
    level_ = stimulus[0];  // what was shown counts, whatever had been requested
    run_ = outcome == 1 ? std::max(run_, 0) + 1 : std::min(run_, 0) - 1;
    if (run_ >= detail_->down) move(true);
    if (run_ <= -detail_->up) move(false);
  }

  int trialsDone() const override { return trials_; }

  Estimate estimate(double level) const override {
    size_t used = std::min(reversals_.size(), static_cast<size_t>(detail_->estimateReversals));
    used -= used % 2;
    std::vector<double> last(reversals_.end() - static_cast<std::ptrdiff_t>(used), reversals_.end());
    const bool ratios = detail_->scale != StepScale::Linear;
    if (ratios) {
      for (double& reversal : last) reversal = std::log(reversal);
    }
    ReversalMean m = meanOfReversals(last, level);
    if (ratios) {
      for (double* value : {&m.mean, &m.median, &m.low, &m.high}) *value = std::exp(*value);
    }
    Estimate out;
    out.level = level;
    out.kind = std::string(ratios ? "geometric mean" : "mean") + " of " + std::to_string(used) +
               " reversals, approximate t interval of block means";
    out.parameters.push_back({"threshold", m.mean, m.median, kNan, m.low, m.high, detail_->unit});
    const double target =
        convergenceProbability(detail_->down, detail_->up, detail_->steps.back(), detail_->stepsUp.back());
    out.parameters.push_back({"target_probability", target, target, target, target, target, ""});
    return out;
  }

  json state() const override {
    return {{"trials", trials_},
            {"level", level_},
            {"run", run_},
            {"direction", direction_},
            {"reversals", reversals_}};
  }

 private:
  void move(bool harder) {
    run_ = 0;
    const int direction = harder ? 1 : -1;
    // A change of direction is a reversal at the stimulus that caused it; the new step size applies from the
    // next step.
    if (direction_ == -direction) reversals_.push_back(level_);
    direction_ = direction;
    const std::vector<double>& steps = harder ? detail_->steps : detail_->stepsUp;
    const size_t index = reversals_.size() / static_cast<size_t>(detail_->reversalsPerStep);
    const double step = steps[std::min(index, steps.size() - 1)];
    level_ = detail_->moved(level_, harder == detail_->harderIsLower ? -step : step);
  }

  std::shared_ptr<const StaircaseDetail> detail_;
  double level_;
  int trials_ = 0;
  int run_ = 0;        // answers of one kind in a row: positive ones counted up, negative ones down
  int direction_ = 0;  // of the last move: 1 harder, -1 easier
  std::vector<double> reversals_;
};

std::unique_ptr<Procedure> StaircaseDetail::make(uint64_t /*seed*/) const {
  return std::make_unique<Staircase>(shared_from_this());
}

std::vector<double> readSteps(const json& source, const std::string& where) {
  std::vector<double> steps;
  const json list = source.is_array() ? source : json::array({source});
  for (const json& entry : list) {
    if (!entry.is_number() || !(entry.get<double>() > 0.0) || !std::isfinite(entry.get<double>())) {
      throw Error("found " + entry.dump(), where, "give a number above 0 or a list of them");
    }
    steps.push_back(entry.get<double>());
  }
  if (steps.empty()) throw Error("the list is empty", where, "give a number above 0 or a list of them");
  return steps;
}

void readStimulus(SettingsReader& reader, StaircaseDetail& detail) {
  SettingsReader stimulus(reader.required("stimulus", "{name, unit, start, minimum, maximum}"),
                          reader.at("stimulus"));
  detail.name = stimulus.textOr("name", detail.name);
  detail.unit = stimulus.textOr("unit", "");
  detail.start = stimulus.number("start");
  detail.minimum = stimulus.numberOr("minimum", -kInfinity);
  detail.maximum = stimulus.numberOr("maximum", kInfinity);
  stimulus.finish();
  if (!(std::abs(detail.start) <= 1e300)) {
    throw Error("the start is too large", stimulus.at("start"), "keep it within 1e300");
  }
  if (!(detail.minimum <= detail.start && detail.start <= detail.maximum)) {
    throw Error("the start is not between minimum and maximum", stimulus.at("start"));
  }
  const double lowest = std::isfinite(detail.minimum) ? detail.minimum : detail.start;
  if (detail.scale != StepScale::Linear && !(lowest >= 1e-300)) {
    throw Error("steps in ratios need a stimulus above 0", stimulus.where(),
                "raise start and minimum, or use scale: linear");
  }
}

}  // namespace

double convergenceProbability(int down, int up, double stepDown, double stepUp) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 100; ++i) {
    const double p = 0.5 * (low + high), q = 1.0 - p;
    const double run = std::pow(p, down - 1), otherRun = std::pow(q, up - 1);
    const double harderFirst = run * (1.0 - std::pow(q, up)) / (run + otherRun - run * otherRun);
    (harderFirst * stepDown < (1.0 - harderFirst) * stepUp ? low : high) = p;
  }
  return 0.5 * (low + high);
}

ReversalMean meanOfReversals(const std::vector<double>& reversals, double level) {
  ReversalMean out{kNan, kNan, kNan, kNan};
  const size_t n = reversals.size();
  if (n == 0) return out;
  double sum = 0.0;
  for (double reversal : reversals) sum += reversal;
  out.mean = sum / static_cast<double>(n);
  std::vector<double> sorted = reversals;
  std::sort(sorted.begin(), sorted.end());
  out.median = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
  const size_t length = n / 8 * 2;  // of a block
  if (length == 0) return out;
  double blocks[4] = {0.0, 0.0, 0.0, 0.0}, centre = 0.0, squares = 0.0;
  for (size_t i = 0; i < 4 * length; ++i) {
    blocks[i / length] += reversals[n - 4 * length + i] / static_cast<double>(length);
  }
  for (double block : blocks) centre += block / 4.0;
  for (double block : blocks) squares += (block - centre) * (block - centre);
  const double half = studentQuantile(level, 3) * std::sqrt(squares / 3.0 / 4.0);
  out.low = out.mean - half;
  out.high = out.mean + half;
  return out;
}

ProcedureSettings readStaircase(SettingsReader& reader) {
  auto detail = std::make_shared<StaircaseDetail>();
  const std::string scale = reader.choiceOr("scale", "linear", {"linear", "log10", "db"});
  detail->scale = scale == "linear"  ? StepScale::Linear
                  : scale == "log10" ? StepScale::Log10
                                     : StepScale::Decibel;
  readStimulus(reader, *detail);
  detail->up = reader.integerOr("up", 1, 1, 100);
  detail->down = reader.integerOr("down", 1, 1, 100);
  detail->steps = readSteps(reader.required("steps", "the size of the steps"), reader.at("steps"));
  detail->stepsUp = detail->steps;
  if (reader.has("steps_up"))
    detail->stepsUp = readSteps(reader.required("steps_up", ""), reader.at("steps_up"));
  detail->reversalsPerStep = reader.integerOr("reversals_per_step", 1, 1, 1000);
  detail->harderIsLower = reader.choiceOr("harder", "lower", {"lower", "higher"}) == "lower";
  detail->stop = readStop(reader, {"reversals", "trials"});
  detail->estimateReversals = reader.integerOr("estimate_reversals", 16, 2, 1000);
  if (detail->estimateReversals % 2 != 0) {
    throw Error(std::to_string(detail->estimateReversals) + " is odd", reader.at("estimate_reversals"),
                "give an even number: as many peaks as valleys");
  }
  reader.finish();
  ProcedureSettings out;
  out.type = "staircase";
  out.stimulus = {{detail->name, detail->unit, detail->minimum, detail->maximum}};
  if (detail->stop.trials > 0) out.mostTrials = detail->stop.trials;
  out.detail = std::move(detail);
  return out;
}

const char* describeStaircase() {
  return "staircase: harder after `down` positive answers in a row, easier after `up` negative ones (Levitt "
         "1971, JASA\n"
         "    49; with unequal steps Kaernbach 1991, Percept. Psychophys. 49)\n"
         "    stimulus      {name, unit, start, minimum, maximum}; limits are optional\n"
         "    down, up      default 1 and 1\n"
         "    steps         size of the steps, or a list: each for `reversals_per_step` (default 1) "
         "reversals, the last\n                  until the end; in units of the stimulus, log10 units or dB "
         "(20 per factor of ten)\n"
         "    steps_up      the same for steps to easier (default: steps)\n"
         "    scale         linear (default), log10 or db: unit of the steps; the latter two "
         "multiply\n"
         "    harder        lower (default) or higher: which way the stimulus gets harder\n"
         "    stop          {reversals, trials}\n"
         "    estimate_reversals   how many of the last reversals are averaged, an even number (default 16)\n"
         "    A move at a limit counts although the stimulus does not change. Estimate: the mean of the last "
         "reversals "
         "(the geometric\n"
         "    one where steps multiply), the probability that the rule targets, and a t interval of four "
         "block means. It is\n"
         "    approximate: 95 % intervals contained the targeted stimulus of simulated observers in 61 to 86 "
         "% "
         "of cases with 8\n"
         "    reversals, in 78 to 92 % with 16, 89 to 94 % with 32 and 91 to 95 % with 64. Fit the answers "
         "for better intervals.\n";
}

}  // namespace limen::study
