// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "perception/command/figures.h"
#include "perception/popping/predictor.h"

namespace limen::perception {

/// "model schwarz_2009; daly98+kelly83, T (9.9), eye movement monotone": the model in brief.
std::string poppingModelText(const PoppingSettings& settings);

/// What poppingFigures() returns, without values.
Figures declaredPoppingFigures();
/// Figures of a prediction: rating, probability, regions, coverage, statistics of the difference map.
Figures poppingFigures(const PoppingResult& result);

/// The regions, highest rating first: a table of at most `most` lines, and all of them as JSON.
std::string regionTable(const PoppingResult& result, size_t most = 20);
nlohmann::json regionsAsJson(const PoppingResult& result);
/// The model's derived quantities for this display and size.
nlohmann::json poppingModelAsJson(const PoppingModel& model);
/// Warnings: non-finite inputs, guarded contrasts.
std::vector<std::string> poppingWarnings(const PoppingResult& result);

}  // namespace limen::perception
