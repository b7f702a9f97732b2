// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/node_reader.h"
#include "study/procedures/procedure.h"
#include "study/protocol/protocol.h"

namespace limen::study {

/// Keys of a part.
const std::vector<std::string>& partKeys();

/// Reads one part of a protocol, and checks that all its conditions give stimuli and its orders exist.
class PartReader {
 public:
  PartReader(NodeReader& reader, const Catalogue& catalogue, double refreshHz, const Words& words)
      : reader_(reader), catalogue_(catalogue), refreshHz_(refreshHz), words_(words) {}

  /// `otherKeys`: keys of the map that do not belong to the part, if a single part is at the top level.
  Part read(const YamlNode& map, const std::string& defaultName, const std::vector<std::string>& otherKeys);

 private:
  void readTask(const YamlNode& map, Part& out);
  std::optional<Scale> readScale(const YamlNode& node, const std::string& key, bool always, Part& out);
  void readAnswers(const YamlNode& map, Part& out);
  void readVariables(const YamlNode& node, const std::string& what, Variables& out);
  void readFactors(const YamlNode& node, Part& out);
  FactorLevel readLevel(const std::string& factor, const YamlMember* named, const YamlNode& value);
  /// Words for factors and axes, which the analysis reads.
  void checkTitles(const YamlNode& node, const Part& part);
  void readTrials(const YamlNode& map, Part& out);
  void readProcedure(const YamlNode& node, Part& out);
  void readBlocks(const YamlNode& node, Part& out);
  void readPractice(const YamlNode& node, Part& out);
  void readItems(const YamlNode& map, Part& out);
  void checkNames(const Part& part, Mark mark);
  void checkSize(const Part& part, Mark mark);
  void checkStimuli(const Part& part);
  void checkOrders(const Part& part, Mark mark);

  NodeReader& reader_;
  const Catalogue& catalogue_;
  double refreshHz_;
  const Words& words_;
  std::optional<ProcedureSettings> procedure_;
};

/// `shuffle`, or {kind: shuffle, at_most_in_a_row: {change: 4}} where `limits` are allowed.
OrderSetting readOrder(NodeReader& reader, const YamlNode& node, const std::string& key,
                       const std::vector<std::string>& limits);

}  // namespace limen::study
