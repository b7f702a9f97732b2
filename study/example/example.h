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

/// A protocol completed by simulated observers.
struct ExampleStudy {
  std::string name;      ///< of its files; the protocol's if left out
  std::string protocol;  ///< shipped name, or path
  std::string display;   ///< preset or profile; "" that of the protocol
  ObserverChoice observer;
  int observers = 1;
  uint64_t seed = 1;
  /// Replaces the protocol's window, so that stimuli render quickly. They then look different: the result
  /// shows that everything works but is not what the protocol specifies.
  std::optional<std::pair<int, int>> windowPx;
  bool predictions = true;  ///< predictions for the stimuli, to compare with the answers
};

/// A worked example: studies to simulate and how their answers are analysed.
struct Example {
  std::string path, text, name;  ///< name: the file's, without extension
  std::string title, question, source;
  std::vector<std::string> features;  ///< ids of experiments/features.yaml
  std::vector<ExampleStudy> studies;
  std::vector<std::string> analyses;  ///< of exampleAnalyses(), in its order
};

/// "rates", "anova", "sdt", "validate", "report": subcommands of limen analyse.
const std::vector<std::string>& exampleAnalyses();

/// Reads and checks. Throws one Error with a line "file:line:column: what; what is allowed" per problem.
/// `nameOrPath`: a file, or the name of a shipped example.
Example readExample(const std::string& nameOrPath);
Example parseExample(const std::string& text, const std::string& path);
/// Names and titles of the examples in study/examples.
std::vector<std::pair<std::string, std::string>> shippedExamples();

/// The study's protocol, with its window replaced if the study has its own: this is the text stored with the
/// answers. Throws Error like readProtocol().
Protocol protocolOf(const ExampleStudy& study, std::shared_ptr<const Catalogue> catalogue);

}  // namespace limen::study
