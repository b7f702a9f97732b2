// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/analyses.h"

#include <fmt/format.h>

#include <set>

namespace limen::analysis {

ResultTable ruleTable(const StudyAnswers& study) {
  const auto leftOut = [&](const AppliedRule& rule, bool observers) -> ResultCell {
    if (!rule.applied) return {};
    std::set<std::string> who;
    size_t answers = 0;
    for (const LeftOut& left : study.leftOut)
      if (left.rule == rule.name) {
        who.insert(left.observer);
        answers += left.answers;
      }
    return observers ? who.size() : answers;
  };
  return TableOf("rules", "rules of exclusion that the protocol declares", study.rules)
      .add(text("rule"), &AppliedRule::name)
      .add(significant("limit"), &AppliedRule::limit)
      .add(flag("applied"), &AppliedRule::applied)
      .add(integer("observers"), [&](const AppliedRule& rule) { return leftOut(rule, true); })
      .add(integer("answers"), [&](const AppliedRule& rule) { return leftOut(rule, false); })
      .add(ifAny(text("note")), &AppliedRule::note);
}

ResultTable leftOutTable(const StudyAnswers& study) {
  return TableOf("left_out", "left out", study.leftOut)
      .add(text("observer"), &LeftOut::observer)
      .add(text("rule", "by"), &LeftOut::rule)
      .add(integer("answers"), &LeftOut::answers)
      .add(text("detail"), &LeftOut::detail);
}

Section headOf(const StudyAnswers& study) {
  Section out;
  out.title = study.plan.title;
  out.fact(text("protocol"), study.plan.name);
  out.fact(text("protocol_hash", "SHA-256"), study.plan.hash);
  out.fact(forData(text("title")), study.plan.title);
  out.fact(forData(list("observers")), study.observers);
  out.fact(forPeople(integer("", "observers")), study.observers.size());
  out.fact(integer("sessions"), study.sessions);
  out.fact(forData(integer("simulated_sessions")), study.simulated);
  out.fact(forData(integer("not_lab_ready_sessions")), study.notLabReady);
  out.fact(integer("answers"), study.answers.size());
  out.fact(list("displays"), study.displays);
  out.add(ruleTable(study));
  out.add(leftOutTable(study));
  if (study.simulated > 0) out.notes.push_back("simulated observers: these answers say nothing about people");
  if (study.notLabReady > 0)
    out.notes.push_back(fmt::format("{} sessions were shown by a machine that was not ready for a laboratory",
                                    study.notLabReady));
  if (study.leftOut.empty()) out.notes.push_back("nothing was left out");
  return out;
}

}  // namespace limen::analysis
