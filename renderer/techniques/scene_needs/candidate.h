// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// A technique with the settings with which it is tried.
struct Candidate {
  std::string technique;                        ///< as registered
  std::map<std::string, ParameterValue> given;  ///< by path; the rest takes its defaults
  /// What makes it in place of a registered technique, and what tells it from others made so; null:
  /// registered.
  std::function<std::unique_ptr<Technique>()> make = {};
  std::string details = {};
};

/// Its settings, complete. Throws Error on a value that the technique does not take.
ParameterValues completeValues(const Candidate& candidate);
std::unique_ptr<Technique> makeTechnique(const Candidate& candidate);
/// The technique, and "path=value" of what is given: all numbers, and choices that are not the default.
std::string describe(const Candidate& candidate);
/// Why it cannot be tried: settings that it does not take, a trait that the scene lacks; "": it can.
std::string obstacleTo(const Candidate& candidate, const scene::Scene& scene);

/// What a file may list.
struct CandidateFileRules {
  ProductKind product = ProductKind::Visibility;
  std::string chooser;  ///< the technique that chooses among them, which is none of them
  std::string example;  ///< of an entry
  /// Gives what an entry leaves open; null: nothing.
  std::function<void(Candidate&)> complete = {};
};
/// Candidates listed in a YAML file, as the techniques of a descriptor are; lists are axes. Throws Error
/// naming file and line.
std::vector<Candidate> readCandidateFile(const std::string& path, const CandidateFileRules& rules);
/// Whether its technique declares a parameter of this path.
bool takes(const TechniqueInfo& info, const std::string& path);

}  // namespace limen::techniques
