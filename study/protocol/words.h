// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "study/protocol/protocol.h"

namespace limen::study {

std::string toText(Task task);  ///< "yes_no", "interval", "alternative", "rating", "pairwise"
const std::vector<std::string>& taskNames();
Task taskNamed(const std::string& name);  ///< one of taskNames()

std::string toText(OrderKind kind);  ///< "fixed", "shuffle", "latin", "williams"
const std::vector<std::string>& orderNames();
OrderKind orderNamed(const std::string& name);

}  // namespace limen::study
