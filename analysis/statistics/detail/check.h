// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace limen::analysis {

/// Checks shared by the statistics. Each throws limen::Error whose `where` names the list and the index,
/// counted from 0: "values[3]".

std::string indexed(const std::string& name, size_t index);

/// A confidence level lies strictly between 0 and 1.
void requireLevel(double level);
void requireFinite(double value, const std::string& where);
void requireFinite(const std::vector<double>& values, const std::string& name);
void requireAtLeast(size_t length, size_t least, const std::string& name);
void requireSameLength(size_t length, const std::string& name, size_t other, const std::string& otherName);
/// 0 <= successes <= trials. With `atLeastOne`, trials > 0.
void requireCounts(int64_t successes, int64_t trials, const std::string& where, bool atLeastOne);

/// Two lists of equal length, at least 2, of finite numbers.
void requireSample(const std::vector<double>& x, const std::string& nameX, const std::vector<double>& y,
                   const std::string& nameY, double level);

}  // namespace limen::analysis
