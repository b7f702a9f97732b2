// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/part_scales.h"

#include <algorithm>

#include "analysis/study/pairs.h"
#include "experiments/base/error.h"

namespace limen::analysis {

std::vector<PartScale> studyScales(const StudyAnswers& study) {
  std::vector<PartScale> out;
  for (size_t i = 0; i < study.plan.parts.size(); ++i) {
    if (study.plan.parts[i].task != "pairwise") continue;
    StudyAnswers own = study;
    own.answers.erase(std::remove_if(own.answers.begin(), own.answers.end(),
                                     [&](const StudyAnswer& answer) { return answer.part != i; }),
                      own.answers.end());
    if (own.answers.empty()) continue;
    PartScale one;
    one.part = study.plan.parts[i].name;
    try {
      one.scale = scaleItems(readStudyPairs(own, {}), one.setting).groups.at(0);
    } catch (const Error& error) {
      one.note = error.message();
    }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace limen::analysis
