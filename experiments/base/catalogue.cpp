// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/catalogue.h"

#include <algorithm>

#include "experiments/base/text.h"

namespace limen {

std::string titleOf(const Quantity& quantity) {
  return quantity.title.empty() ? titleFromName(quantity.name, quantity.unit) : quantity.title;
}

std::vector<std::string> names(const CatalogueKind& kind) {
  std::vector<std::string> out;
  for (const auto& [name, entry] : kind) out.push_back(name);
  return out;
}

std::vector<std::string> counterNames(const Catalogue& catalogue,
                                      const std::vector<std::string>& techniques) {
  std::vector<std::string> out;
  for (const std::string& technique : techniques)
    for (const Quantity& counter : catalogue.techniques.at(technique).counters)
      if (std::find(out.begin(), out.end(), counter.name) == out.end()) out.push_back(counter.name);
  return out;
}

}  // namespace limen
