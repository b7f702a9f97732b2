// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "experiments/base/error.h"
#include "experiments/store/sessions.h"
#include "study/observers/simulate.h"
#include "study/observers/true_threshold.h"
#include "study/procedures/threshold_target.h"

namespace limen::study {
namespace {

using nlohmann::json;
using Condition = std::map<std::string, std::string>;

// One participant's trials of one kind in one condition.
struct Count {
  int trials = 0, positive = 0;
  double expected = 0.0;
};

struct Rates {
  std::vector<Count> change, catches;  // of the participants
};

RateSummary summaryOf(const std::vector<Count>& counts) {
  RateSummary out;
  double squares = 0.0, sum = 0.0;
  for (const Count& count : counts) {
    if (count.trials == 0) continue;
    const double rate = static_cast<double>(count.positive) / count.trials;
    ++out.participants;
    out.trials += count.trials;
    sum += rate;
    squares += rate * rate;
    out.expected += count.expected;
  }
  if (out.participants == 0) return out;
  const double n = out.participants;
  out.mean = sum / n;
  out.sd = n > 1 ? std::sqrt(std::max(0.0, (squares - n * out.mean * out.mean) / (n - 1.0)))
                 : std::numeric_limits<double>::quiet_NaN();
  out.expected /= out.trials;
  return out;
}

Condition conditionOf(const json& condition) {
  Condition out;
  for (const auto& [name, level] : condition.items())
    out[name] = level.is_string() ? level.get<std::string>() : level.dump();
  return out;
}

struct EstimateSums {
  std::string unit, interval, type;
  double level = 0.95;
  int participants = 0, without = 0, held = 0;
  double truth = 0.0, estimate = 0.0, error = 0.0, squares = 0.0;
};

class Summariser {
 public:
  Summariser(const Protocol& protocol, const ObserverBehaviour& behaviour)
      : protocol_(protocol), simulation_(protocol), behaviour_(behaviour) {}

  void add(const store::StudySession& session, const std::vector<store::StudyTrial>& trials) {
    ++out_.sessions;
    out_.finished += session.state == "finished" ? 1 : 0;
    out_.aborted += session.state == "aborted" ? 1 : 0;
    std::map<std::pair<int, Condition>, std::pair<Count, Count>> counts;
    for (const store::StudyTrial& trial : trials) {
      if (trial.valid.has_value() && !*trial.valid) ++out_.invalid;
      if (trial.practice || !trial.counts()) continue;
      ++out_.trials;
      const int part = partOf(trial.part);
      const Task task = protocol_.parts[static_cast<size_t>(part)].task.type;
      int outcome = trial.response->outcome;
      if (task == Task::Rating) outcome = outcome > 0 ? 1 : 0;
      if (task == Task::Pairwise) outcome = outcome == trial.target ? 1 : 0;
      for (const Condition& condition : {conditionOf(trial.condition), Condition{}}) {
        auto& pair = counts[{condition.empty() ? -1 - part : part, condition}];
        Count& count = trial.change ? pair.first : pair.second;
        ++count.trials;
        count.positive += outcome;
        count.expected += trial.response->extra.value("probability", 0.0);
      }
    }
    for (const auto& [key, pair] : counts) {
      Rates& rates = rates_[key];
      rates.change.push_back(pair.first);
      rates.catches.push_back(pair.second);
    }
    addEstimates(session, trials);
  }

  SimulationSummary finish() {
    const auto inOrder = [this](auto& rows) {
      std::stable_sort(rows.begin(), rows.end(),
                       [this](const auto& a, const auto& b) { return this->rankOf(a) < this->rankOf(b); });
    };
    for (const auto& [key, rates] : rates_) {
      const int part = key.first < 0 ? -1 - key.first : key.first;
      ConditionSummary summary{
          protocol_.parts[static_cast<size_t>(part)].name, key.second, summaryOf(rates.change), {}};
      const RateSummary catches = summaryOf(rates.catches);
      if (catches.trials > 0) summary.catches = catches;
      (key.first < 0 ? out_.parts : out_.conditions).push_back(std::move(summary));
    }
    for (const auto& [key, sums] : estimates_) {
      EstimateSummary summary;
      summary.part = protocol_.parts[static_cast<size_t>(key.first)].name;
      summary.condition = key.second;
      summary.procedure = sums.type;
      summary.unit = sums.unit;
      summary.interval = sums.interval;
      summary.level = sums.level;
      summary.participants = sums.participants;
      summary.withoutInterval = sums.without;
      const double n = sums.participants - sums.without;
      summary.meanTrue = sums.truth / n;
      summary.meanEstimate = sums.estimate / n;
      summary.bias = sums.error / n;
      summary.rms = std::sqrt(sums.squares / n);
      summary.coverage = sums.held / n;
      out_.estimates.push_back(std::move(summary));
    }
    inOrder(out_.parts);
    inOrder(out_.conditions);
    inOrder(out_.estimates);
    return std::move(out_);
  }

 private:
  // Positions of part and levels in the protocol.
  template <class Row>
  std::vector<size_t> rankOf(const Row& row) const {
    const Part& part = protocol_.parts[static_cast<size_t>(partOf(row.part))];
    std::vector<size_t> out = {static_cast<size_t>(partOf(row.part))};
    for (const Factor& factor : part.factors)
      for (const char* name : {factor.name.c_str(), "item_a", "item_b"}) {
        const auto found = row.condition.find(name);
        if (found == row.condition.end()) continue;
        for (size_t i = 0; i < factor.levels.size(); ++i)
          if (factor.levels[i].name == found->second) out.push_back(i);
      }
    return out;
  }

  int partOf(const std::string& name) const {
    for (size_t i = 0; i < protocol_.parts.size(); ++i)
      if (protocol_.parts[i].name == name) return static_cast<int>(i);
    throw Error("the store has a part '" + name + "' that the protocol lacks");
  }

  void addEstimates(const store::StudySession& session, const std::vector<store::StudyTrial>& trials) {
    if (behaviour_.fromModel) return;
    const Design design = makeDesign(protocol_, session.seed, session.participantNumber);
    if (design.procedures.empty()) return;
    SimulatedObserver observer(simulation_, behaviour_, observerSeed(session.seed));
    for (size_t i = 0; i < design.procedures.size(); ++i) {
      const PlannedProcedure& planned = design.procedures[i];
      const ProcedureSettings settings = readProcedure(planned.settings, protocol_.path + ": procedure");
      if (settings.stimulus.size() != 1 || settings.type == "constant") continue;
      const std::unique_ptr<Procedure> procedure = makeProcedure(settings, planned.seed);
      for (const store::StudyTrial& trial : trials)
        if (trial.counts() && !trial.practice && trial.change && trial.procedure == static_cast<int>(i))
          procedure->update(trial.procedureStimulus, trial.response->outcome);
      const Estimate estimate = procedure->estimate();
      const auto truth = trueThreshold(observer, firstTrial(design, static_cast<int>(i)), settings, estimate);
      if (!truth) continue;
      if (const ParameterEstimate* threshold = thresholdOf(estimate)) {
        EstimateSums& sums = estimates_[{planned.part, planned.condition}];
        sums.unit = threshold->unit;
        sums.interval = estimate.kind;
        sums.type = settings.type;
        sums.level = estimate.level;
        addEstimate(sums, *threshold, *truth);
      }
    }
  }

  static void addEstimate(EstimateSums& sums, const ParameterEstimate& parameter, double truth) {
    ++sums.participants;
    if (!std::isfinite(parameter.mean) || std::isnan(parameter.low) || std::isnan(parameter.high)) {
      ++sums.without;
      return;
    }
    sums.truth += truth;
    sums.estimate += parameter.mean;
    sums.error += parameter.mean - truth;
    sums.squares += (parameter.mean - truth) * (parameter.mean - truth);
    sums.held += parameter.low <= truth && truth <= parameter.high ? 1 : 0;
  }

  static Trial firstTrial(const Design& design, int procedure) {
    Trial out;
    for (const PlannedBlock& block : design.blocks)
      for (const PlannedTrial& trial : block.trials)
        if (trial.procedure == procedure && trial.change && !trial.practice) {
          out.plan = trial;
          out.plan.number = 0;  // before any drift
          return out;
        }
    return out;
  }

  const Protocol& protocol_;
  Simulation simulation_;
  ObserverBehaviour behaviour_;
  SimulationSummary out_;
  std::map<std::pair<int, Condition>, Rates> rates_;
  std::map<std::pair<int, Condition>, EstimateSums> estimates_;
};

json numberOrNull(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json toJson(const RateSummary& rate) {
  return {{"participants", rate.participants},
          {"trials", rate.trials},
          {"mean", rate.mean},
          {"sd", numberOrNull(rate.sd)},
          {"expected", rate.expected}};
}

json toJson(const ConditionSummary& summary) {
  json out = {{"part", summary.part}, {"condition", summary.condition}, {"change", toJson(summary.change)}};
  if (summary.catches) out["catch"] = toJson(*summary.catches);
  return out;
}

std::string rateText(const RateSummary& rate) {
  if (rate.trials == 0) return fmt::format("{:>26}", "-");
  const std::string sd = std::isfinite(rate.sd) ? fmt::format("{:.1f}", 100.0 * rate.sd) : "-";
  return fmt::format("{:>6.1f} {:>5} {:>6.1f} {:>6}", 100.0 * rate.mean, sd, 100.0 * rate.expected,
                     rate.trials);
}

}  // namespace

SimulationSummary summarise(const Protocol& protocol, const std::string& path,
                            const ObserverBehaviour& behaviour, const std::string& prefix) {
  Summariser summariser(protocol, behaviour);
  const store::SessionReader reader(path);
  for (const store::StudySession& session : reader.sessions())
    if (session.protocol == protocol.hash && session.name == "1" && session.participant.rfind(prefix, 0) == 0)
      summariser.add(session, reader.trials(session.id));
  return summariser.finish();
}

json toJson(const SimulationSummary& summary) {
  json out = {{"sessions", summary.sessions}, {"finished", summary.finished}, {"aborted", summary.aborted},
              {"trials", summary.trials},     {"invalid", summary.invalid},   {"parts", json::array()},
              {"conditions", json::array()},  {"estimates", json::array()}};
  for (const ConditionSummary& part : summary.parts) out["parts"].push_back(toJson(part));
  for (const ConditionSummary& condition : summary.conditions) out["conditions"].push_back(toJson(condition));
  for (const EstimateSummary& e : summary.estimates)
    out["estimates"].push_back({{"part", e.part},
                                {"condition", e.condition},
                                {"procedure", e.procedure},
                                {"unit", e.unit},
                                {"interval", e.interval},
                                {"level", e.level},
                                {"participants", e.participants},
                                {"without_interval", e.withoutInterval},
                                {"mean_true", numberOrNull(e.meanTrue)},
                                {"mean_estimate", numberOrNull(e.meanEstimate)},
                                {"bias", numberOrNull(e.bias)},
                                {"rms_error", numberOrNull(e.rms)},
                                {"coverage", numberOrNull(e.coverage)}});
  return out;
}

std::string conditionText(const std::string& part, const Condition& condition) {
  std::string out = part;
  for (const auto& [name, level] : condition) out += (out.empty() ? "" : ", ") + name + "=" + level;
  return out;
}

std::string toText(const SimulationSummary& summary) {
  std::string out =
      fmt::format("{} sessions, {} finished, {} aborted; {} trials answered, {} presentations invalid\n",
                  summary.sessions, summary.finished, summary.aborted, summary.trials, summary.invalid);
  out += fmt::format(
      "\nrates in %: mean and SD over participants, mean of the observers' probabilities, trials\n  {:<48} "
      "{:>26}   {:>26}\n",
      "", "change", "no change");
  const RateSummary none;
  for (const auto* list : {&summary.parts, &summary.conditions}) {
    for (const ConditionSummary& row : *list)
      out += fmt::format("  {:<48} {}   {}\n", conditionText(row.part, row.condition), rateText(row.change),
                         rateText(row.catches.value_or(none)));
    if (list == &summary.parts) out += "\n";
  }
  if (summary.estimates.empty()) return out;
  out += "\nestimates against the truth: means, bias, RMS error, share of intervals that contain the truth\n";
  for (const EstimateSummary& e : summary.estimates) {
    out += fmt::format(
        "  {:<48} {:>9.4g} for {:>9.4g} {}  bias {:+.3g}, RMS {:.3g}, {:.1f} % of {} ({}, {:g} %)\n",
        conditionText(e.part, e.condition), e.meanEstimate, e.meanTrue, e.unit, e.bias, e.rms,
        100.0 * e.coverage, e.participants - e.withoutInterval, e.interval, 100.0 * e.level);
    if (e.withoutInterval > 0) out += fmt::format("  {:<48} {} without an interval\n", "", e.withoutInterval);
  }
  return out;
}

}  // namespace limen::study
