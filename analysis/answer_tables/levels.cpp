// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_tables/levels.h"

#include <map>

#include "analysis/output/text_output.h"

namespace limen::analysis {

Levels namesIn(const std::vector<std::string>& column) {
  Levels out;
  std::map<std::string, size_t> known;
  for (const std::string& name : column) {
    const auto [at, fresh] = known.emplace(name, out.names.size());
    if (fresh) out.names.push_back(name);
    out.ofRow.push_back(at->second);
  }
  return out;
}

Levels levelsIn(const std::vector<std::string>& column) {
  const Levels plain = namesIn(column);
  std::map<double, std::string> numbers;  // growing
  std::vector<double> values;
  for (const std::string& name : plain.names) {
    const auto value = finiteNumber(name);
    if (!value) return plain;
    numbers.emplace(*value, name);
    values.push_back(*value);
  }
  Levels out;
  std::map<double, size_t> places;
  for (const auto& [value, name] : numbers) {
    places[value] = out.names.size();
    out.names.push_back(name);
  }
  for (const size_t level : plain.ofRow) out.ofRow.push_back(places.at(values[level]));
  return out;
}

}  // namespace limen::analysis
