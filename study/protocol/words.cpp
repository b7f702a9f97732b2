// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/words.h"

#include <algorithm>
#include <cassert>

namespace limen::study {
namespace {

size_t placeOf(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  assert(found != names.end());
  return static_cast<size_t>(found - names.begin());
}

}  // namespace

// In the order of the enumerations.
const std::vector<std::string>& taskNames() {
  static const std::vector<std::string> kNames = {"yes_no", "interval", "alternative", "rating", "pairwise"};
  return kNames;
}
std::string toText(Task task) { return taskNames()[static_cast<size_t>(task)]; }
Task taskNamed(const std::string& name) { return static_cast<Task>(placeOf(taskNames(), name)); }

const std::vector<std::string>& orderNames() {
  static const std::vector<std::string> kNames = {"fixed", "shuffle", "latin", "williams"};
  return kNames;
}
std::string toText(OrderKind kind) { return orderNames()[static_cast<size_t>(kind)]; }
OrderKind orderNamed(const std::string& name) { return static_cast<OrderKind>(placeOf(orderNames(), name)); }

}  // namespace limen::study
