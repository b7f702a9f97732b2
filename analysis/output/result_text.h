// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/output/result.h"

namespace limen::analysis {

/// A cell of a column as people read it; "-" for a number that is missing.
std::string cellText(const Column& column, const ResultCell& cell);

/// What a terminal shows.
std::string toText(const Result& result);
std::string toText(const Section& section);

}  // namespace limen::analysis
