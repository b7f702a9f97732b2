// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/describe.h"

#include <fmt/format.h>

#include "experiments/base/text.h"
#include "study/protocol/blocks.h"
#include "study/protocol/conditions.h"

namespace limen::study {
namespace {

using nlohmann::json;

/// The kind of trial, as text for people.
std::string kindOf(const Protocol& protocol, const Part& part, const PlannedTrial& trial) {
  std::string out = trial.change ? "" : "catch";
  if (!trial.change && trial.procedure < 0)
    out += stimuliOf(protocol, trial).front().catchShowsAfter ? ": after" : ": before";
  const std::vector<std::string>& answers = part.task.answers;
  if (part.task.type == Task::Interval || part.task.type == Task::Alternative)
    out = "change: " + answers[static_cast<size_t>(trial.target)];
  else if (part.task.type == Task::Pairwise)
    out = trial.condition.at(trial.target == 0 ? "item_b" : "item_a") + " | " +
          trial.condition.at(trial.target == 0 ? "item_a" : "item_b");
  else if (trial.change && part.task.type == Task::YesNo)
    out = "change";
  return out;
}

std::string describePart(const Part& part) {
  const size_t conditions = conditionsOf(part).size();
  std::string out =
      fmt::format("part {}: {}, \"{}\"\n", part.name, toText(part.task.type), part.task.question);
  for (const Factor& factor : part.factors) {
    std::vector<std::string> names;
    for (const FactorLevel& level : factor.levels) names.push_back(level.name);
    out +=
        fmt::format("  {} {}: {}\n", &factor == itemsOf(part) ? "items" : "factor", factor.name, join(names));
  }
  size_t changes = 0, catches = 0;
  for (const PlannedBlock& block : unorderedBlocks(part, 0, 0))
    for (const PlannedTrial& trial : block.trials) ++(trial.change ? changes : catches);
  out += fmt::format("  {} condition{}, {}{} trials", conditions, conditions == 1 ? "" : "s",
                     part.procedure ? "at most " : "", changes + catches);
  if (catches > 0) out += fmt::format(" ({} change, {} catch)", changes, catches);
  if (part.practice.trials > 0)
    out += fmt::format("; practice of {} trials, {} round{} at most", part.practice.trials,
                       part.practice.rounds, part.practice.rounds == 1 ? "" : "s");
  return out + "\n";
}

json trialAsJson(const Protocol& protocol, const PlannedTrial& trial) {
  json out = {{"number", trial.number}, {"condition", trial.condition},   {"variables", trial.variables},
              {"change", trial.change}, {"repetition", trial.repetition}, {"target", trial.target},
              {"procedure", nullptr}};
  if (trial.procedure >= 0) {
    out["procedure"] = trial.procedure;
  } else {
    out["stimulus_hashes"] = json::array();
    out["shown"] = json::array();
    for (const Stimulus& stimulus : stimuliOf(protocol, trial)) {
      out["stimulus_hashes"].push_back(stimulusHash(stimulus));
      out["shown"].push_back(stimulus.changes ? "change" : stimulus.catchShowsAfter ? "after" : "before");
    }
  }
  return out;
}

}  // namespace

size_t trialsOf(const Design& design) {
  size_t out = 0;
  for (const PlannedBlock& block : design.blocks)
    if (!block.practice) out += block.trials.size();
  return out;
}

std::string describe(const Protocol& protocol, const Design& design, uint64_t seed, int participantNumber) {
  std::string out = fmt::format("{}: {}\n  {}\n", protocol.name, protocol.title, protocol.question);
  if (!protocol.source.empty()) out += "  source: " + protocol.source + "\n";
  out += fmt::format("  display {}, window {} x {} px; sha256 {}\n\n", protocol.display,
                     protocol.window.widthPx, protocol.window.heightPx, protocol.hash);
  for (const Part& part : protocol.parts) {
    out += describePart(part);
    if (part.task.type != Task::YesNo) continue;
    std::vector<std::string> answers;
    for (const size_t i : answersShown(part.task, design.answersMirrored))
      answers.push_back(part.task.answers[i]);
    out += fmt::format("  answers from the left: {} ({})\n", join(answers), toText(part.task.answerSides));
  }
  out += fmt::format("\nparticipant {}, seed {}: {} trials{}\n", participantNumber, seed, trialsOf(design),
                     design.procedures.empty() ? "" : " at most");
  for (const PlannedBlock& block : design.blocks) {
    const Part& part = protocol.parts[static_cast<size_t>(block.part)];
    out += fmt::format("block {} ({} trials)\n", block.name, block.trials.size());
    for (const PlannedTrial& trial : block.trials)
      out += fmt::format("  {:4}  {:<24}  {}\n", trial.number, kindOf(protocol, part, trial),
                         nameOf(part, trial.condition));
  }
  return out;
}

json describeAsJson(const Protocol& protocol, const Design& design, uint64_t seed, int participantNumber) {
  json out = {{"name", protocol.name},
              {"path", protocol.path},
              {"sha256", protocol.hash},
              {"title", protocol.title},
              {"question", protocol.question},
              {"source", protocol.source},
              {"features", protocol.features},
              {"display", protocol.display},
              {"window", {{"width_px", protocol.window.widthPx}, {"height_px", protocol.window.heightPx}}},
              {"seed", seed},
              {"participant_number", participantNumber},
              {"trials", trialsOf(design)},
              {"answers_mirrored", design.answersMirrored},
              {"parts", json::array()},
              {"blocks", json::array()},
              {"procedures", json::array()}};
  for (const Part& part : protocol.parts) {
    json conditions = json::array(), factors = json::object();
    for (const Condition& condition : conditionsOf(part))
      conditions.push_back({{"levels", condition.levels}, {"variables", condition.variables}});
    for (const Factor& factor : part.factors)
      for (const FactorLevel& level : factor.levels) factors[factor.name][level.name] = level.variables;
    out["parts"].push_back({{"name", part.name},
                            {"task", toText(part.task.type)},
                            {"question", part.task.question},
                            {"answers", part.task.answers},
                            {"factors", factors},
                            {"items", part.items},
                            {"conditions", conditions},
                            {"trials", trialCount(part)},
                            {"adaptive", part.procedure.has_value()}});
  }
  for (const PlannedBlock& block : design.blocks) {
    json trials = json::array();
    for (const PlannedTrial& trial : block.trials) trials.push_back(trialAsJson(protocol, trial));
    out["blocks"].push_back(
        {{"part", block.part}, {"name", block.name}, {"practice", block.practice}, {"trials", trials}});
  }
  for (const PlannedProcedure& procedure : design.procedures)
    out["procedures"].push_back({{"part", procedure.part},
                                 {"condition", procedure.condition},
                                 {"settings", procedure.settings},
                                 {"seed", procedure.seed}});
  return out;
}

}  // namespace limen::study
