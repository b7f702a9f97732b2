// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "study/observers/observer.h"
#include "study/protocol/protocol.h"

namespace limen::study {

/// A protocol about scene "box", whose only parameter is `distance`. `keys`: those of its only part, and
/// `simulation`.
Protocol boxProtocol(const std::string& keys);

/// The first planned trial of the protocol that has (or has not) a change and is of this condition.
Trial trialOf(const Protocol& protocol, bool change,
              const std::map<std::string, std::string>& condition = {});

/// A yes/no task at distances 4 and 10.
inline const std::string kYesNo = R"(
task: {type: yes_no, question: "Seen?"}
factors: {distance: [4, 10]}
stimulus:
  scene: {name: box, distance: = distance}
  levels: {before: 1, after: 0}
trials: {change: 2, catch: 1}
)";

/// A store that is gone with the object.
struct TemporaryStore {
  TemporaryStore();
  ~TemporaryStore();
  TemporaryStore(const TemporaryStore&) = delete;
  TemporaryStore& operator=(const TemporaryStore&) = delete;
  std::string folder, path;
};

}  // namespace limen::study
