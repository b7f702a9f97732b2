// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/procedures/procedure.h"

namespace limen::study {

/// An answer to replay; if it has a stimulus it was given to that, otherwise to what the procedure requests.
struct TraceAnswer {
  std::optional<std::vector<double>> stimulus;
  int outcome = 0;
};

/// Reads answers separated by commas, blanks or newlines: "1,0,1", or pairs "-18:1 -22:1", a stimulus of
/// several dimensions with slashes: "-26/18:1". Text from a # to the end of its line is ignored.
/// Throws Error.
std::vector<TraceAnswer> readAnswers(const std::string& text, const std::string& where);

/// Runs a procedure on given answers. The result has
///     procedure   the settings with all defaults
///     seed        as text, for its 64 bits
///     trials      a list: trial (from 1), stimulus, proposed (what the procedure requested; null past its
///     end), outcome,
///                 estimates after it, and state
///     next        what it would show now, or null
/// Throws Error for bad settings, and if the procedure ends before the answers that have no stimulus.
nlohmann::json trace(const nlohmann::json& settings, uint64_t seed, const std::vector<TraceAnswer>& answers,
                     const std::string& where = {});

/// {level, kind, parameters: [{name, unit, mean, median, mode, low, high}]}; null for anything that does not
/// exist yet.
nlohmann::json toJson(const Estimate& estimate);

}  // namespace limen::study
