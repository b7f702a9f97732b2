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
  std::map<double, size_t> places;  // of equal numbers the first, growing
  for (size_t i = 0; i < plain.names.size(); ++i) {
    const auto value = finiteNumber(plain.names[i]);
    if (!value) return plain;
    places.emplace(*value, i);
  }
  Levels out;
  for (auto& [value, place] : places) {
    out.names.push_back(plain.names[place]);
    place = out.names.size() - 1;
  }
  for (const std::string& name : column) out.ofRow.push_back(places.at(*finiteNumber(name)));
  return out;
}

}  // namespace limen::analysis
