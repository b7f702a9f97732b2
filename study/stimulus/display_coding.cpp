// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/display_coding.h"

#include <algorithm>

namespace limen::study {

CodeThresholds codeThresholds(const perception::DisplayProfile& display) {
  CodeThresholds out{};
  for (size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<float>(display.decode((static_cast<double>(i) + 0.5) / 255.0));
  return out;
}

int displayCode(const perception::DisplayProfile& display, double linear) {
  const CodeThresholds thresholds = codeThresholds(display);
  const auto light = static_cast<float>(linear > 0.0 ? std::min(linear, 1.0) : 0.0);
  return static_cast<int>(std::upper_bound(thresholds.begin(), thresholds.end(), light) - thresholds.begin());
}

}  // namespace limen::study
