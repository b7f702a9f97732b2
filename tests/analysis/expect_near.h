// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace limen::analysis {

/// A number that a program printed.
inline void expectNear(const nlohmann::json& found, double expected, double within = 1e-6) {
  ASSERT_TRUE(found.is_number()) << found;
  EXPECT_NEAR(found.get<double>(), expected, within);
}

}  // namespace limen::analysis
