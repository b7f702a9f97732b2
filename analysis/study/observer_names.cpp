// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/observer_names.h"

#include <fmt/format.h>

namespace limen::analysis {

ObserverNames::ObserverNames(const std::vector<store::StudySession>& sessions, bool codes) : codes_(codes) {
  for (const store::StudySession& session : sessions)
    numbers_.try_emplace(session.participant, numbers_.size() + 1);
}

std::string ObserverNames::of(const std::string& participant, bool simulated) const {
  return codes_ || simulated ? participant : fmt::format("O{:02}", numbers_.at(participant));
}

}  // namespace limen::analysis
