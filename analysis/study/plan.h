// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/store/sessions.h"

namespace limen::analysis {

struct StudyFactor {
  std::string name;
  std::vector<std::string> levels;  ///< in order of writing
};

/// The psychometric function that a protocol's `simulation:` block gives its simulated observers, or else its
/// procedure assumes: what its author takes answers to be like. Names as `limen analyse fit` has them.
struct AssumedFunction {
  std::string variable;              ///< an axis or a factor
  std::string sigmoid = "logistic";  ///< of the mirrored axis where it falls
  std::string axis = "linear", direction = "rising";
  double level = 0.5;  ///< F at the threshold
};

/// What the analysis needs to know of a protocol's part.
struct StudyPart {
  std::string name;
  std::string task;  ///< "yes_no", "interval", "alternative", "rating", "pairwise"
  int alternatives = 2;
  bool adaptive = false;  ///< a procedure chose its stimuli
  std::vector<StudyFactor> factors;
  /// Of an adaptive part: names of the numbers of StudyAnswer::axes; "" for the number of an interleaved
  /// procedure.
  std::vector<std::string> axes;
  std::optional<AssumedFunction> assumed;
  nlohmann::json procedure;                   ///< settings of an adaptive part's procedure; null without one
  std::map<std::string, std::string> titles;  ///< of factors and axes, as the protocol words them
  std::map<std::string, std::string> units;   ///< of axes

  /// "Switch distance (m)": for people, of a factor or axis.
  std::string titleOf(const std::string& variable) const;
  bool asksYesNo() const { return task == "yes_no"; }
  /// Whether an answer's outcome of 1 is one of two: "yes", or the right one.
  bool isBinary() const { return asksYesNo() || task == "interval" || task == "alternative"; }
};

struct ExclusionRule {
  std::string name;
  double limit = 0.0;
};

/// A protocol as it was stored with its sessions. Only what is named here is read: the protocol was checked
/// when they were run.
struct StudyPlan {
  std::string name, hash, title;
  int widthPx = 1024, heightPx = 768;  ///< of the stimuli's window
  std::vector<StudyPart> parts;
  std::vector<ExclusionRule> exclusions;

  /// That there is.
  const StudyPart& part(const std::string& name) const;
  /// Index of a part, which is added as one that asks for nothing known if the text does not have it.
  size_t partNamed(const std::string& name);
};

/// A factor's level for people: "2 to 3" for "2_to_3".
std::string levelTitle(const std::string& level);
/// Levels of the part's factors in their order: "2 to 3, static".
std::string conditionTitle(const StudyPart& part, const std::map<std::string, std::string>& condition);

/// Throws Error, which names the store that holds it, on text that is no YAML.
StudyPlan readStudyPlan(const store::StudyProtocol& protocol, const std::string& store);

}  // namespace limen::analysis
