// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/base/node_reader.h"

namespace limen {

/// Values by path that are set together: one point of an axis.
using AxisPoint = std::map<std::string, ParameterValue>;

/// What a map gives for one parameter: one point, or several, which are crossed with the points of the other
/// axes.
struct Axis {
  std::string
      name;  ///< path of what varies: "budget.rim"; if several paths vary, that of the choice above them
  std::vector<AxisPoint> points;
};

/// Every combination of the axes' points; the last axis changes fastest, as in loops nested in that order.
std::vector<AxisPoint> combine(const std::vector<Axis>& axes);

/// Reads the parameters of a scene, technique or metric from a map, as its declarations allow:
///   - `radius: 4`; a list is an axis: `radius: [2, 4]`;
///   - a choice with parameters of its own: `budget: {kind: radial, rim: [25, 50]}`, `budget: radial`, or
///   without
///     `kind` for the default one; a list of such is one axis: `structure: [hsm, {kind: ysm, base: [128,
///     256]}]`;
///   - a number in place of a choice or group that has a shorthand: `budget: 256`;
///   - a group: a map of its members.
class EntryReader {
 public:
  /// `listHint`: what to do instead of giving a list, where lists are refused; "": lists are axes.
  explicit EntryReader(NodeReader& reader, std::string listHint = {})
      : reader_(reader), listHint_(std::move(listHint)) {}

  /// One axis for each parameter that the map gives. `what` has the parameters: "technique
  /// 'soft_shadows/pcf'". Keys in `others` are read elsewhere.
  std::vector<Axis> axes(const YamlNode& map, const std::vector<Parameter>& declared, const std::string& what,
                         const std::vector<std::string>& others = {"name"});

 private:
  struct Level {
    const std::vector<Parameter>& declared;
    std::string what, path;
    std::vector<std::string> others;
  };
  void readMap(const YamlNode& map, const Level& level, std::vector<Axis>& out);
  void readParameter(const YamlNode& node, const Parameter& parameter, const Level& level,
                     std::vector<Axis>& out);
  void readChoice(const YamlNode& node, const Parameter& parameter, const Level& level,
                  std::vector<Axis>& out);
  void readChoices(const YamlNode& list, const Parameter& parameter, const Level& level,
                   std::vector<Axis>& out);
  void readPlain(const YamlNode& node, const Parameter& parameter, const std::string& path,
                 std::vector<Axis>& out);
  bool refuseList(const YamlNode& node, const Parameter& parameter, const Level& level);
  void refuseKey(const YamlNode& key, const Level& level);

  NodeReader& reader_;
  std::string listHint_;
  const std::vector<Parameter>* root_ = nullptr;
};

/// Whether a scalar in place of this choice or group is a number for its shorthand.
bool isShorthand(const YamlNode& node, const Parameter& parameter);
/// The shorthand's declaration: of the default alternative, or of the group.
const Parameter& shorthandOf(const Parameter& parameter);

/// How a descriptor writes a declaration: "budget: {kind: radial, rim: ...}".
std::string spell(const DeclaredAt& at);

}  // namespace limen
