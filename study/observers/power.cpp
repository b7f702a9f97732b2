// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/power.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "perception/psychometrics/random.h"
#include "study/observers/simulated_front_end.h"
#include "study/procedures/student_t.h"

namespace limen::study {
namespace {

using psychometrics::childSeed;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct CellKey {
  int part = 0;
  std::map<std::string, std::string> condition;
  bool threshold = false;
  auto operator<=>(const CellKey&) const = default;
};

// One observer's result for a cell.
struct CellValue {
  double sum = 0.0;
  int count = 0;
  std::string unit;
  double value() const { return sum / count; }
};
using Values = std::map<CellKey, CellValue>;

// Sums over experiments for one cell of one design.
struct Tally {
  double mean = 0.0, variance = 0.0, width = 0.0, widthSquares = 0.0;
  int experiments = 0, reached = 0, degenerate = 0;
};

Protocol withRepetitions(const Protocol& protocol, int repetitions) {
  Protocol out = protocol;
  for (Part& part : out.parts) {
    part.practice = {};
    part.catchRepetitions = 0;
    if (!part.procedure) part.changeRepetitions = repetitions;
  }
  return out;
}

int positiveOutcome(const TaskSetting& task, int outcome) {
  return task.type == Task::Rating ? (outcome > 0 ? 1 : 0) : outcome;
}

double thresholdOf(const Estimate& estimate, std::string& unit) {
  for (const ParameterEstimate& parameter : estimate.parameters) {
    if (parameter.name != "threshold" && parameter.name != "mean") continue;
    unit = parameter.unit;
    return parameter.mean;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

class Experimenter {
 public:
  Experimenter(const Protocol& protocol, const ObserverBehaviour& behaviour, StimulusModel* model,
               int repetitions)
      : protocol_(withRepetitions(protocol, repetitions)),
        simulation_(protocol_),
        behaviour_(behaviour),
        model_(model),
        repetitions_(repetitions) {}

  Values run(uint64_t seed, int number) {
    SimulatedObserver observer(simulation_, behaviour_, childSeed(seed, "observer"), model_);
    Values out;
    Design design = makeDesign(protocol_, childSeed(seed, "design"), number);
    std::vector<std::vector<PlannedTrial>> ofProcedures(design.procedures.size());
    for (PlannedBlock& block : design.blocks)
      for (PlannedTrial& planned : block.trials) {
        if (planned.practice) continue;
        if (planned.procedure >= 0) {
          ofProcedures[static_cast<size_t>(planned.procedure)].push_back(std::move(planned));
          continue;
        }
        Trial trial = begin(std::move(planned), seed, 0);
        const int outcome = observer.respond(trial).outcome;
        add(out, trial.plan, trial.plan.condition, outcome);
      }
    for (size_t i = 0; i < design.procedures.size(); ++i)
      for (int run = 0; run < repetitions_; ++run)
        runProcedure(design.procedures[i], ofProcedures[i], childSeed(seed, "run " + std::to_string(run)),
                     run, observer, out);
    return out;
  }

 private:
  static Trial begin(PlannedTrial&& plan, uint64_t seed, int run) {
    Trial trial;
    trial.number = plan.number;
    trial.seed = childSeed(seed, "trial " + std::to_string(plan.number) + " " + std::to_string(run));
    trial.plan = std::move(plan);
    return trial;
  }

  void add(Values& values, const PlannedTrial& plan, std::map<std::string, std::string> condition,
           int outcome) const {
    const TaskSetting& task = protocol_.parts[static_cast<size_t>(plan.part)].task;
    // The position of a pair's items is not a condition.
    CellValue& cell = values[CellKey{plan.part, std::move(condition), false}];
    if (task.type == Task::Pairwise) outcome = outcome == plan.target ? 1 : 0;
    cell.sum += positiveOutcome(task, outcome);
    ++cell.count;
  }

  const ProcedureSettings& settingsOf(const PlannedProcedure& planned) {
    const std::string key = planned.settings.dump();
    auto found = settings_.find(key);
    if (found == settings_.end())
      found = settings_.emplace(key, readProcedure(planned.settings, protocol_.path + ": procedure")).first;
    return found->second;
  }

  void runProcedure(const PlannedProcedure& planned, const std::vector<PlannedTrial>& trials, uint64_t seed,
                    int run, SimulatedObserver& observer, Values& out) {
    const ProcedureSettings& settings = settingsOf(planned);
    std::vector<std::string> names;
    for (const StimulusDimension& dimension : settings.stimulus) names.push_back(dimension.name);
    const auto procedure = makeProcedure(settings, childSeed(planned.seed, "run " + std::to_string(run)));
    for (const PlannedTrial& plan : trials) {
      const auto stimulus = procedure->next();
      if (!stimulus) break;
      Trial trial = begin(PlannedTrial(plan), seed, run);
      trial.procedureStimulus = *stimulus;
      const Variables axes = axesOf(names, *stimulus);
      const int outcome = observer.respond(trial, axes).outcome;
      procedure->update(*stimulus, outcome);
      if (settings.type != "constant") continue;
      std::map<std::string, std::string> condition = plan.condition;
      for (const auto& [name, value] : axes) condition[name] = value.dump();
      add(out, plan, std::move(condition), outcome);
    }
    if (settings.type == "constant") return;
    CellValue& cell = out[CellKey{planned.part, planned.condition, true}];
    cell.sum += thresholdOf(procedure->estimate(), cell.unit);
    ++cell.count;
  }

  Protocol protocol_;
  Simulation simulation_;
  ObserverBehaviour behaviour_;
  StimulusModel* model_;
  int repetitions_;
  std::map<std::string, ProcedureSettings> settings_;
};

// Width if all observers have the same value, which says nothing about their spread.
double agreedWidth(double value, int n, double confidence, bool isRate) {
  if (!isRate) return kUnbounded;
  const double k = std::clamp(value, 0.0, 1.0) * n, tail = (1.0 - confidence) / 2.0;
  const double low = k < 1e-9 ? 0.0 : boost::math::ibeta_inv(k, n - k + 1.0, tail);
  const double high = k > n - 1e-9 ? 1.0 : boost::math::ibetac_inv(k + 1.0, n - k, tail);
  return high - low;
}

// The t interval over the first n of the observers' values.
void addExperiment(Tally& tally, const std::vector<double>& values, int n, double confidence, bool isRate,
                   double asked) {
  const double t = studentQuantile(confidence, n - 1);
  double mean = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) mean += values[static_cast<size_t>(i)] / n;
  for (int i = 0; i < n; ++i) {
    const double d = values[static_cast<size_t>(i)] - mean;
    squares += d * d;
  }
  const double variance = squares / (n - 1);
  // A variance that is 0 up to rounding.
  const bool degenerate = variance < 1e-24;
  double width = 2.0 * t * std::sqrt(variance / n);
  if (degenerate) width = agreedWidth(mean, n, confidence, isRate);
  if (std::isnan(width)) width = kUnbounded;
  ++tally.experiments;
  tally.mean += mean;
  tally.variance += variance;
  tally.width += width;
  tally.widthSquares += width * width;
  tally.degenerate += degenerate ? 1 : 0;
  tally.reached += width <= asked ? 1 : 0;
}

PowerCell cellOf(const Protocol& protocol, const CellKey& key, const Tally& tally, const std::string& unit) {
  const double n = tally.experiments;
  PowerCell out;
  out.part = protocol.parts[static_cast<size_t>(key.part)].name;
  out.condition = key.condition;
  out.threshold = key.threshold;
  out.unit = unit;
  out.mean = tally.mean / n;
  out.sdBetween = std::sqrt(tally.variance / n);
  out.meanWidth = tally.width / n;
  out.meanWidthError = std::sqrt(std::max(0.0, tally.widthSquares / n - out.meanWidth * out.meanWidth) /
                                 std::max(1.0, n - 1.0));
  out.reached = tally.reached / n;
  out.reachedError = std::sqrt(out.reached * (1.0 - out.reached) / n);
  out.degenerate = tally.degenerate / n;
  return out;
}

void judge(PowerDesign& design, const PowerRequest& request) {
  for (size_t i = 0; i < design.cells.size(); ++i) {
    if (design.cells[i].threshold && !request.thresholdWidth) continue;
    const PowerCell &cell = design.cells[i], &worst = design.cells[design.worst];
    if (!design.judged || cell.reached < worst.reached ||
        (cell.reached == worst.reached && cell.meanWidth > worst.meanWidth))
      design.worst = i;
    design.judged = true;
  }
  if (!design.judged) return;
  const PowerCell& worst = design.cells[design.worst];
  design.reaches = worst.reached >= request.probability;
  // With a share of 0 or 1 the binomial error is 0; the rule of succession keeps it from being mistaken for
  // certainty.
  const double n = request.simulations, p = (worst.reached * n + 1.0) / (n + 2.0);
  design.clear = std::abs(worst.reached - request.probability) >= 2.0 * std::sqrt(p * (1.0 - p) / n);
}

void check(const PowerRequest& request) {
  const auto refuse = [](const std::string& what, const std::string& where) { throw Error(what, where); };
  if (request.observers.empty() || request.repetitions.empty()) refuse("nothing to compare", "power");
  for (const int n : request.observers)
    if (n < 2 || n > 10000) refuse(std::to_string(n) + " is not from 2 to 10000", "--observers");
  for (const int r : request.repetitions)
    if (r < 1 || r > 1000) refuse(std::to_string(r) + " is not from 1 to 1000", "--repetitions");
  if (!(request.confidence > 0.0 && request.confidence < 1.0))
    refuse("is not between 0 and 1", "--confidence");
  if (!(request.probability > 0.0 && request.probability < 1.0))
    refuse("is not between 0 and 1", "--probability");
  if (!(request.width > 0.0)) refuse("is not above 0", "--width");
  if (request.thresholdWidth && !(*request.thresholdWidth > 0.0))
    refuse("is not above 0", "--threshold-width");
  if (request.simulations < 2 || request.simulations > 1000000)
    refuse("is not from 2 to 1000000", "--simulations");
}

}  // namespace

PowerResult simulatePower(const Protocol& protocol, const ObserverBehaviour& behaviour,
                          const PowerRequest& request, StimulusModel* model,
                          const std::function<bool(double)>& progress) {
  check(request);
  std::vector<int> observers = request.observers, repetitions = request.repetitions;
  for (std::vector<int>* list : {&observers, &repetitions}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  const int most = observers.back();
  double work = 0.0, done = 0.0;
  for (const int r : repetitions) work += static_cast<double>(r) * request.simulations;

  PowerResult out;
  for (const int r : repetitions) {
    Experimenter experimenter(protocol, behaviour, model, r);
    std::map<CellKey, std::vector<Tally>> tallies;
    std::map<CellKey, std::string> units;
    for (int k = 0; k < request.simulations; ++k) {
      std::map<CellKey, std::vector<double>> values;
      for (int i = 0; i < most; ++i) {
        const uint64_t seed =
            childSeed(request.seed, "experiment " + std::to_string(k) + " observer " + std::to_string(i));
        for (const auto& [key, value] : experimenter.run(seed, i)) {
          values[key].push_back(value.value());
          units[key] = value.unit;
        }
      }
      for (const auto& [key, list] : values) {
        if (static_cast<int>(list.size()) != most)
          throw Error("not every participant answers every condition", protocol.path,
                      "there are no widths then");
        std::vector<Tally>& ofCell = tallies[key];
        ofCell.resize(observers.size());
        const double asked = !key.threshold ? request.width : request.thresholdWidth.value_or(0.0);
        for (size_t o = 0; o < observers.size(); ++o)
          addExperiment(ofCell[o], list, observers[o], request.confidence, !key.threshold, asked);
      }
      done += r;
      if (progress && progress(done / work)) return {};
    }
    for (size_t o = 0; o < observers.size(); ++o) {
      PowerDesign design;
      design.observers = observers[o];
      design.repetitions = r;
      for (const auto& [key, ofCell] : tallies)
        design.cells.push_back(cellOf(protocol, key, ofCell[o], units[key]));
      judge(design, request);
      out.designs.push_back(std::move(design));
    }
  }
  const auto better = [&](const std::optional<size_t>& best, size_t candidate, bool byTrials) {
    if (!best) return true;
    const PowerDesign &a = out.designs[candidate], &b = out.designs[*best];
    const auto rank = [byTrials](const PowerDesign& d) {
      const long trials = static_cast<long>(d.observers) * d.repetitions;
      return byTrials ? std::pair<long, long>(trials, d.observers)
                      : std::pair<long, long>(d.observers, d.repetitions);
    };
    return rank(a) < rank(b);
  };
  for (size_t i = 0; i < out.designs.size(); ++i) {
    if (!out.designs[i].reaches) continue;
    if (better(out.fewestObservers, i, false)) out.fewestObservers = i;
    if (better(out.fewestTrials, i, true)) out.fewestTrials = i;
  }
  return out;
}

}  // namespace limen::study
