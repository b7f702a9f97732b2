// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "study/session/session.h"

namespace limen::study {
namespace {

int indexOf(const Part& part, const std::string& answer) {
  const std::vector<std::string>& answers = part.task.answers;
  const auto found = std::find(answers.begin(), answers.end(), answer);
  if (found == answers.end())
    throw Error("'" + answer + "' is not an answer of part '" + part.name + "'", {},
                "known: " + join(answers));
  return static_cast<int>(found - answers.begin());
}

}  // namespace

std::optional<bool> Session::isCorrect(const Part& part, const PlannedTrial& trial,
                                       const std::string& answer) {
  const int index = indexOf(part, answer);
  switch (part.task.type) {
    case Task::YesNo:
      return (index == 0) == trial.change;
    case Task::Interval:
    case Task::Alternative:
      return index == trial.target;
    case Task::Rating:
    case Task::Pairwise:
      break;
  }
  return std::nullopt;
}

int Session::outcomeOf(const Part& part, const PlannedTrial& trial, const std::string& answer) {
  const int index = indexOf(part, answer);
  switch (part.task.type) {
    case Task::YesNo:
      return index == 0 ? 1 : 0;
    case Task::Interval:
    case Task::Alternative:
      return index == trial.target ? 1 : 0;
    case Task::Rating:
    case Task::Pairwise:
      break;
  }
  return index;
}

}  // namespace limen::study
