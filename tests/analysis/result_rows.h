// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace limen::analysis {

/// Rows of a result's table in which every field of `fields` has its value.
inline nlohmann::json rowsWith(const nlohmann::json& rows, const nlohmann::json& fields) {
  nlohmann::json out = nlohmann::json::array();
  for (const nlohmann::json& row : rows) {
    bool fits = true;
    for (const auto& [name, value] : fields.items()) fits = fits && row.at(name) == value;
    if (fits) out.push_back(row);
  }
  return out;
}

/// The only such row.
inline nlohmann::json rowWith(const nlohmann::json& rows, const nlohmann::json& fields) {
  const nlohmann::json found = rowsWith(rows, fields);
  EXPECT_EQ(found.size(), 1U) << fields.dump() << " in " << rows.dump();
  return found.empty() ? nlohmann::json() : found[0];
}

}  // namespace limen::analysis
