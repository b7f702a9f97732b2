// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "experiments/base/node_reader.h"
#include "study/stimulus/stimulus.h"

namespace limen::study {

/// Makes stimuli from a template. Anything invalid becomes a problem.
class StimulusReader {
 public:
  StimulusReader(NodeReader& reader, const Catalogue& catalogue) : reader_(reader), catalogue_(catalogue) {}

  /// The stimulus with these variables; `changes` as if a change is due. Nothing after a problem.
  std::optional<Stimulus> read(const StimulusTemplate& source, const Variables& variables);
  /// Whether the plan decides what the stimulus read last shows where it does not change.
  bool balancesUnchanged() const { return balancesUnchanged_; }

 private:
  void readChange(const YamlNode& map, Stimulus& out);
  void readLevels(const YamlNode& node, Stimulus& out);
  void readCue(const YamlNode& node, Stimulus& out);
  void readCatchShows(const YamlNode& node, Stimulus& out);
  std::optional<NamedEntry> readEntry(const YamlNode& node, const char* kind, const CatalogueKind& known);
  ParameterValues readValues(const YamlNode& map, const std::string& what,
                             const std::vector<Parameter>& declared, bool named,
                             std::map<std::string, std::string>* fileHashes);

  /// The node with its expressions evaluated, including those in nested maps and lists; nothing after a
  /// problem.
  std::optional<YamlNode> resolved(const YamlNode& node);
  /// Like NodeReader::take() with the same arguments, with an expression evaluated.
  template <class... Arguments>
  void take(const YamlNode& map, const std::string& key, Arguments&&... arguments);

  NodeReader& reader_;
  const Catalogue& catalogue_;
  const Variables* variables_ = nullptr;
  bool balancesUnchanged_ = true;
};

}  // namespace limen::study
