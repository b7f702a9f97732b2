// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/observer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::study {
namespace {

using psychometrics::childSeed;
using psychometrics::Random;
using psychometrics::Sigmoid;
using psychometrics::SigmoidFamily;
using psychometrics::StimulusAxis;

// A probability shifted on the logit scale; 0 and 1 stay unchanged.
double moveLogit(double p, double by) {
  if (by == 0.0 || p <= 0.0 || p >= 1.0) return p;
  return psychometrics::standardValue(SigmoidFamily::Logistic,
                                      psychometrics::standardInverse(SigmoidFamily::Logistic, p) + by);
}

Variables allVariables(const PlannedTrial& plan, const Variables& axes) {
  Variables out = plan.variables;
  for (const auto& [name, value] : axes) out[name] = value;
  return out;
}

double normalOf(uint64_t seed, const std::string& name) { return Random(childSeed(seed, name)).normal(); }

}  // namespace

struct SimulatedObserver::Sight {
  const SimulationRules* rules = nullptr;
  DecisionSetting setting;
  double first = 0.0, second = 0.0;  // Pairwise
};

SimulatedObserver::SimulatedObserver(const Simulation& simulation, const ObserverBehaviour& behaviour,
                                     uint64_t seed, StimulusModel* model)
    : simulation_(simulation), behaviour_(behaviour), seed_(seed), model_(model) {
  Random random(childSeed(seed, "traits"));
  for (double* trait : {&threshold_, &width_, &strength_, &guess_, &lapse_}) *trait = random.normal();
}

double SimulatedObserver::shiftOf(const SimulationRules& rules, const PlannedTrial& trial) {
  double shift = rules.spread.strengthSd * strength_ + behaviour_.strengthSd * strength_;
  if (!trial.practice) shift += behaviour_.strengthPerHundred * trial.number / 100.0;
  if (rules.spread.conditionSd > 0.0) {
    std::string name = "condition " + std::to_string(trial.part);
    for (const auto& [factor, level] : trial.condition) name += "\n" + factor + "=" + level;
    shift += rules.spread.conditionSd * normalOf(seed_, name);
  }
  return shift;
}

double SimulatedObserver::detectedOf(const SimulationRules& rules, const Trial& trial,
                                     const Variables& axes) {
  const Variables variables = allVariables(trial.plan, axes);
  const std::string& file = simulation_.protocol().path;
  const double shift = shiftOf(rules, trial.plan);
  if (rules.source == SimulationRules::Source::Sigmoid && !behaviour_.fromModel) {
    const double x = numberOf(rules.variable, variables, rules.where + ".variable", file);
    double threshold = numberOf(rules.threshold, variables, rules.where + ".threshold", file);
    double width = numberOf(rules.width, variables, rules.where + ".width", file);
    if (!(width > 0.0))
      throw Error("width or slope " + shortestNumber(width) + " is not above 0", rules.where);
    const bool logarithmic =
        rules.axis == StimulusAxis::Logarithmic || rules.family == SigmoidFamily::Weibull;
    if ((logarithmic || rules.spread.thresholdSdLog > 0.0) && !(threshold > 0.0))
      throw Error("threshold " + shortestNumber(threshold) + " has no logarithm", rules.where);
    threshold = threshold * std::exp(rules.spread.thresholdSdLog * threshold_) +
                rules.spread.thresholdSd * threshold_;
    if (logarithmic && !(threshold > 0.0))
      throw Error("an observer's threshold is not above 0", rules.where, "spread it by threshold_sd_log");
    width *= std::exp(rules.spread.widthSdLog * width_);
    // A falling curve has F(threshold) = level just like a rising one; mirrored, it is the complement there.
    const double level = rules.falling ? 1.0 - rules.level : rules.level;
    Sigmoid sigmoid = rules.widthIsSlope
                          ? Sigmoid::fromThresholdSlope(rules.family, rules.axis, threshold, width, level)
                          : Sigmoid::fromThresholdWidth(rules.family, rules.axis, threshold, width, level);
    const double move = (rules.falling ? 1.0 : -1.0) * shift * sigmoid.scale();
    sigmoid = Sigmoid(sigmoid.family(), sigmoid.axis(), sigmoid.location() + move, sigmoid.scale());
    return rules.falling ? sigmoid.complement(x) : sigmoid.value(x);
  }
  double detected = 0.0;
  if (rules.source == SimulationRules::Source::Detected && !behaviour_.fromModel) {
    detected = numberOf(rules.detected, variables, rules.where + ".detected", file);
    if (!(detected >= 0.0 && detected <= 1.0))
      throw Error(shortestNumber(detected) + " is not a probability", rules.where + ".detected");
  } else {
    if (!model_) throw Error("the trial needs the popping predictor", rules.where, "declare what is seen");
    const Task task = simulation_.protocol().parts[static_cast<size_t>(trial.plan.part)].task.type;
    const bool several = task == Task::Interval || task == Task::Alternative;
    const size_t which = several ? static_cast<size_t>(trial.plan.target) : 0;
    const perception::DetectionModel& detection = behaviour_.detection;
    const StimulusPrediction seen = model_->predict(trial, axes, which);
    const double p = detection.probability(seen.rating);
    if (seen.popping)
      detected =
          std::clamp((p - detection.guessRate) / (1.0 - detection.guessRate - detection.lapseRate), 0.0, 1.0);
  }
  return moveLogit(detected, shift);
}

double SimulatedObserver::valueOf(const SimulationRules& rules, const Trial& trial, const Variables& axes,
                                  const std::string& item, size_t which) {
  double value = 0.0;
  if (usesModel(trial)) {
    if (!model_) throw Error("the trial needs the popping predictor", rules.where, "declare items");
    value = behaviour_.valuePerRating * model_->predict(trial, axes, which).rating;
  } else {
    const auto found = rules.items.find(item);
    if (found == rules.items.end())
      throw Error("no scale value for item '" + item + "'", rules.where + ".items");
    value = found->second;
  }
  if (rules.spread.itemsSd > 0.0) value += rules.spread.itemsSd * normalOf(seed_, "item " + item);
  return value;
}

SimulatedObserver::Sight SimulatedObserver::look(const Trial& trial, const Variables& axes) {
  Sight out;
  const PlannedTrial& plan = trial.plan;
  const TaskSetting& task = simulation_.protocol().parts[static_cast<size_t>(plan.part)].task;
  out.rules = &simulation_.rules(plan.part, plan.condition);
  const SimulationRules& rules = *out.rules;
  const Variables variables = allVariables(plan, axes);
  const std::string& file = simulation_.protocol().path;
  const bool fromModel = usesModel(trial);
  const bool yesNo = task.type == Task::YesNo || task.type == Task::Rating;

  DecisionSetting& setting = out.setting;
  setting.theory = rules.theory;
  setting.criterionShift = behaviour_.criterionShift;
  setting.firstBias = behaviour_.firstBias;
  setting.guess = fromModel ? behaviour_.detection.guessRate
                            : numberOf(rules.guess, variables, rules.where + ".guess", file);
  setting.lapse = fromModel ? behaviour_.detection.lapseRate
                            : numberOf(rules.lapse, variables, rules.where + ".lapse", file);
  if (behaviour_.guess) setting.guess = *behaviour_.guess;
  if (behaviour_.lapse) setting.lapse = *behaviour_.lapse;
  setting.guess = moveLogit(setting.guess, rules.spread.guessSdLogit * guess_);
  setting.lapse = moveLogit(setting.lapse, rules.spread.lapseSdLogit * lapse_);
  const double chance =
      yesNo ? setting.guess : 1.0 / std::max(2, task.type == Task::Pairwise ? 2 : task.alternatives);
  if (!(setting.guess >= 0.0 && setting.lapse >= 0.0 && setting.guess < 1.0 && chance + setting.lapse < 1.0))
    throw Error("guess " + shortestNumber(chance) + " and lapse " + shortestNumber(setting.lapse) +
                    " are not rates that sum to less than 1",
                rules.where);
  if (yesNo && rules.theory == DetectionTheory::SignalDetection && !(setting.guess > 0.0))
    throw Error("signal detection needs a guess rate above 0", rules.where + ".guess",
                "the criterion is where the guess rate puts it");
  if (!plan.practice) setting.lapse += behaviour_.lapsePerHundred * trial.plan.number / 100.0;
  // Fatigue ends in chance performance.
  setting.lapse = behaviour_.lapses ? std::clamp(setting.lapse, 0.0, 1.0 - chance) : 0.0;

  if (task.type == Task::Pairwise) {
    const std::string a = plan.condition.at("item_a"), b = plan.condition.at("item_b");
    out.first = valueOf(rules, trial, axes, plan.target == 1 ? a : b, 0);
    out.second = valueOf(rules, trial, axes, plan.target == 1 ? b : a, 1);
  } else if (plan.change || !yesNo) {
    setting.detected = detectedOf(rules, trial, axes);
  }
  return out;
}

double SimulatedObserver::probability(const Trial& trial, const Variables& axes) {
  const Sight sight = look(trial, axes);
  const TaskSetting& task = simulation_.protocol().parts[static_cast<size_t>(trial.plan.part)].task;
  if (task.type == Task::YesNo || task.type == Task::Rating) return yesProbability(sight.setting);
  if (task.type != Task::Pairwise)
    return correctProbability(sight.setting, task.alternatives, trial.plan.target);
  const double second = secondProbability(sight.setting, sight.first, sight.second);
  return trial.plan.target == 1 ? second : 1.0 - second;
}

double SimulatedObserver::detected(const Trial& trial, const Variables& axes) {
  return look(trial, axes).setting.detected;
}

bool SimulatedObserver::usesModel(const Trial& trial) const {
  return behaviour_.fromModel ||
         simulation_.rules(trial.plan.part, trial.plan.condition).source == SimulationRules::Source::Model;
}

ObserverResponse SimulatedObserver::respond(const Trial& trial, const Variables& axes, uint64_t seed) {
  const Sight sight = look(trial, axes);
  const SimulationRules& rules = *sight.rules;
  const TaskSetting& task = simulation_.protocol().parts[static_cast<size_t>(trial.plan.part)].task;
  const bool yesNo = task.type == Task::YesNo;
  Random random(childSeed(seed, "answer"));
  Judgement judgement;
  if (yesNo || task.type == Task::Rating)
    judgement = decideYesNo(sight.setting, random);
  else if (task.type == Task::Pairwise)
    judgement = decidePair(sight.setting, sight.first, sight.second, random);
  else
    judgement = decideAlternative(sight.setting, task.alternatives, trial.plan.target, random);

  ObserverResponse out;
  out.detected = sight.setting.detected;
  out.probability = judgement.probability;
  if (task.type == Task::Pairwise && trial.plan.target == 0) out.probability = 1.0 - judgement.probability;
  out.lapsed = judgement.lapsed;
  size_t index = static_cast<size_t>(judgement.choice);
  if (yesNo) index = judgement.choice ? 0 : 1;
  if (task.type == Task::Rating) index = static_cast<size_t>(stepOf(judgement.evidence, rules.rating)) - 1;
  assert(index < task.answers.size());
  out.answer = task.answers[index];
  out.outcome = static_cast<int>(index);
  if (yesNo) out.outcome = judgement.choice;
  if (task.type == Task::Interval || task.type == Task::Alternative)
    out.outcome = judgement.choice == trial.plan.target ? 1 : 0;
  if (task.severity && (task.severityAlways || !yesNo || judgement.choice))
    out.severity = stepOf(judgement.evidence, rules.severity);
  if (task.confidence) {
    const bool blank = std::isinf(judgement.evidence);
    out.confidence = stepOf(blank ? judgement.evidence : std::abs(judgement.evidence), rules.confidence);
  }
  out.reactionTimeS = rules.reactionMedianS * std::exp(rules.reactionSdLog * normalOf(seed, "reaction"));
  return out;
}

}  // namespace limen::study
