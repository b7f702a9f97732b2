// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/procedure_estimates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "experiments/base/error.h"
#include "study/procedures/threshold_target.h"

namespace limen::analysis {
namespace {

bool isBroken(const StudyAnswers& study, const std::vector<const StudyAnswer*>& answers) {
  const StudyAnswer* const first = answers.front();
  return first->session != answers.back()->session ||
         std::any_of(study.leftOut.begin(), study.leftOut.end(), [&](const LeftOut& left) {
           return left.observer == study.observers[first->observer] &&
                  left.rule.rfind("reaction_time", 0) == 0;
         });
}

}  // namespace

std::optional<ProcedureEstimate> procedureEstimate(const StudyAnswers& study, size_t part,
                                                   const std::vector<const StudyAnswer*>& answers) {
  const StudyPart& own = study.plan.parts[part];
  if (own.procedure.is_null() || answers.empty()) return {};
  const study::ProcedureSettings settings = study::readProcedure(own.procedure, "part " + own.name);
  if (settings.stimulus.size() != 1 || (settings.type == "staircase" && isBroken(study, answers))) return {};
  // The seed decides what is shown next, and nothing here.
  const std::unique_ptr<study::Procedure> procedure = study::makeProcedure(settings, 0);
  for (const StudyAnswer* answer : answers) procedure->update(answer->axes, answer->outcome);
  const study::Estimate estimate = procedure->estimate(0.95);
  const study::ParameterEstimate* threshold = study::thresholdOf(estimate);
  const auto target = study::thresholdTarget(settings, estimate);
  if (!threshold || !target || !std::isfinite(threshold->mean)) return {};
  ProcedureEstimate out;
  out.value = threshold->mean;
  if (std::isfinite(threshold->low) && std::isfinite(threshold->high))
    out.interval = Interval{threshold->low, threshold->high};
  out.kind = estimate.kind;
  out.target = fmt::format("{} = {:.3g}", target->ofF ? "F" : "P", target->value);
  return out;
}

}  // namespace limen::analysis
