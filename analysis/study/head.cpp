// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/head.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "experiments/base/text.h"

namespace limen::analysis {

std::string headText(const StudyAnswers& study) {
  std::string out =
      fmt::format("{} ({}, SHA-256 {})\n{} answers of {} observers in {} sessions on {}\n", study.plan.title,
                  study.plan.name, study.plan.hash.substr(0, 12), study.answers.size(),
                  study.observers.size(), study.sessions, join(study.displays));
  if (study.simulated > 0) out += "simulated observers: these answers say nothing about people\n";
  if (study.notLabReady > 0)
    out += fmt::format("{} sessions were shown by a machine that was not ready for a laboratory\n",
                       study.notLabReady);
  for (const AppliedRule& rule : study.rules) {
    out += fmt::format("rule {}: {}{}", rule.name, shortestNumber(rule.limit),
                       rule.applied ? "" : " - not applied");
    if (!rule.note.empty()) out += (rule.applied ? " - " : ": ") + rule.note;
    out += "\n";
  }
  for (const LeftOut& left : study.leftOut)
    out += fmt::format("left out by {}: {}, {} answers ({})\n", left.rule, left.observer, left.answers,
                       left.detail);
  if (study.leftOut.empty()) out += "nothing was left out\n";
  return out;
}

nlohmann::json headJson(const StudyAnswers& study) {
  nlohmann::json rules = nlohmann::json::array(), left = nlohmann::json::array();
  for (const AppliedRule& rule : study.rules)
    rules.push_back(
        {{"rule", rule.name}, {"limit", rule.limit}, {"applied", rule.applied}, {"note", rule.note}});
  for (const LeftOut& one : study.leftOut)
    left.push_back(
        {{"rule", one.rule}, {"observer", one.observer}, {"answers", one.answers}, {"detail", one.detail}});
  return {{"protocol", study.plan.name},
          {"protocol_hash", study.plan.hash},
          {"title", study.plan.title},
          {"observers", study.observers},
          {"sessions", study.sessions},
          {"simulated_sessions", study.simulated},
          {"not_lab_ready_sessions", study.notLabReady},
          {"answers", study.answers.size()},
          {"displays", study.displays},
          {"rules", rules},
          {"left_out", left}};
}

}  // namespace limen::analysis
