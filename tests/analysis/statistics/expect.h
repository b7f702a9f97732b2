// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "experiments/base/error.h"

namespace limen::analysis {

/// Within `tolerance` of `expected`, relative.
inline void expectRelative(double actual, double expected, double tolerance) {
  EXPECT_LE(std::abs(actual - expected), tolerance * std::abs(expected)) << actual << " for " << expected;
}

/// `call` throws a limen::Error whose text holds `part`, such as the index of what is wrong.
template <typename Call>
void expectError(Call call, const std::string& part) {
  try {
    call();
    ADD_FAILURE() << "nothing was refused, expected '" << part << "'";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

}  // namespace limen::analysis
