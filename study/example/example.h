// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "study/observers/observer_kind.h"
#include "study/protocol/protocol.h"

namespace limen::study {

/// A protocol that simulated observers go through.
struct ExampleStudy {
  std::string name;      ///< of its files; the protocol's if left out
  std::string protocol;  ///< shipped name, or path
  std::string display;   ///< preset or profile; "" that of the protocol
  ObserverChoice observer;
  int observers = 1;
  uint64_t seed = 1;
  /// In place of the protocol's window, so that stimuli are rendered quickly. They look different then: what
  /// comes out shows that all works, and is not what the protocol asks for.
  std::optional<std::pair<int, int>> windowPx;
  bool predictions = true;  ///< what predictors say of the stimuli, for the comparison with answers
};

/// A worked example: studies to simulate and what is then asked of their answers.
struct Example {
  std::string path, text, name;  ///< name: of the file, without ending
  std::string title, question, source;
  std::vector<std::string> features;  ///< ids of experiments/features.yaml
  std::vector<ExampleStudy> studies;
  std::vector<std::string> analyses;  ///< of exampleAnalyses(), in its order
};

/// "rates", "anova", "sdt", "validate", "report": subcommands of limen analyse.
const std::vector<std::string>& exampleAnalyses();

/// Reads and checks. Throws one Error with a line "file:line:column: what; what is allowed" for everything
/// that is wrong. `nameOrPath`: a file, or the name of a shipped example.
Example readExample(const std::string& nameOrPath);
Example parseExample(const std::string& text, const std::string& path);
/// Names and titles of the examples in study/examples.
std::vector<std::pair<std::string, std::string>> shippedExamples();

/// The study's protocol, its window replaced if the study has one of its own: the text that is stored with
/// the answers says so. Throws Error as readProtocol().
Protocol protocolOf(const ExampleStudy& study, std::shared_ptr<const Catalogue> catalogue);

}  // namespace limen::study
