// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/pair_scales/scale.h"
#include "analysis/study/answers.h"

namespace limen::analysis {

/// Of a part that compares items in pairs: their scale, or why there is none.
struct PartScale {
  std::string part;
  ScaleSetting setting;
  std::optional<ItemScale> scale;
  std::string note;
};

/// Every part that compares items in pairs, as `limen analyse scale` scales it unless told otherwise; parts
/// without a judgement are left out.
std::vector<PartScale> studyScales(const StudyAnswers& study);

}  // namespace limen::analysis
