// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/conditions.h"

namespace limen::study {

Variables merged(Variables base, const Variables& with) {
  for (const auto& [name, value] : with) base[name] = value;
  return base;
}

const Factor* findFactor(const Part& part, const std::string& name) {
  for (const Factor& factor : part.factors)
    if (factor.name == name) return &factor;
  return nullptr;
}

const Factor* itemsOf(const Part& part) {
  return part.task.type == Task::Pairwise ? findFactor(part, part.items) : nullptr;
}

std::vector<Condition> conditionsOf(const Part& part) {
  std::vector<Condition> out = {{{}, part.variables}};
  for (const Factor& factor : part.factors) {
    if (&factor == itemsOf(part)) continue;
    std::vector<Condition> more;
    for (const Condition& condition : out)
      for (const FactorLevel& level : factor.levels) {
        Condition next = condition;
        next.levels[factor.name] = level.name;
        next.variables = merged(std::move(next.variables), level.variables);
        more.push_back(std::move(next));
      }
    out = std::move(more);
  }
  return out;
}

std::string nameOf(const Part& part, const std::map<std::string, std::string>& levels) {
  std::string out;
  for (const Factor& factor : part.factors)
    if (const auto level = levels.find(factor.name); level != levels.end())
      out += (out.empty() ? "" : ",") + factor.name + "=" + level->second;
  return out;
}

std::vector<std::pair<size_t, size_t>> pairsOf(const Factor& items) {
  std::vector<std::pair<size_t, size_t>> out;
  for (size_t a = 0; a < items.levels.size(); ++a)
    for (size_t b = a + 1; b < items.levels.size(); ++b) out.emplace_back(a, b);
  return out;
}

}  // namespace limen::study
