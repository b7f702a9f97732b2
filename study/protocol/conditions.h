// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "study/protocol/protocol.h"

namespace limen::study {

/// One level of every factor, except the compared items of a pairwise part.
struct Condition {
  std::map<std::string, std::string> levels;
  Variables variables;  ///< of the part and the levels
};

/// Every combination, the last factor fastest; one without levels if there are no factors.
std::vector<Condition> conditionsOf(const Part& part);
/// "distance=4,speed=2" in the order of the factors; "" without factors.
std::string nameOf(const Part& part, const std::map<std::string, std::string>& levels);

/// The factor of that name, or null.
const Factor* findFactor(const Part& part, const std::string& name);
/// Null unless the part compares items.
const Factor* itemsOf(const Part& part);
/// Numbers of all pairs of different item levels, the lower first.
std::vector<std::pair<size_t, size_t>> pairsOf(const Factor& items);

/// `base` overridden by `with`.
Variables merged(Variables base, const Variables& with);

}  // namespace limen::study
