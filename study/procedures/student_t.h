// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limen::study {

/// The t that Student's distribution with `degrees` >= 1 degrees of freedom exceeds in absolute value with
/// probability 1 - level.
double studentQuantile(double level, int degrees);

}  // namespace limen::study
