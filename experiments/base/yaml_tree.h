// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limen {

/// Position in a file, both from 1.
struct Mark {
  int line = 1, column = 1;
};

/// "FILE:LINE:COLUMN", as compilers print it.
std::string location(const std::string& file, Mark mark);

struct YamlMember;

/// YAML as descriptors use it: maps, lists and scalars. Unlike a general YAML reader it refuses what hides
/// meaning or could be a mistake (duplicate keys, anchors and aliases, tags, several documents, tabs as
/// indentation) and records whether a scalar was quoted.
struct YamlNode {
  enum class Kind { Null, Scalar, List, Map };
  Kind kind = Kind::Null;
  Mark mark;
  std::string text;                 ///< Scalar only
  bool quoted = false;              ///< Scalar only: always text, never a number or boolean
  std::vector<YamlNode> items;      ///< List only
  std::vector<YamlMember> members;  ///< Map only; keys are scalars, in order of writing
  std::string origin =
      {};  ///< what a calculated value was derived from, for messages; "": it was written literally

  const YamlNode* find(std::string_view key) const;
  /// "a list", "a map", "nothing", "'text'": for messages.
  std::string describe() const;
};

struct YamlMember {
  YamlNode key, value;
};

/// Throws Error naming file, line and column.
YamlNode parseYaml(const std::string& text, const std::string& file);

/// The whole file. Throws Error on a folder, a missing or unreadable file and on one too large to be
/// intended.
std::string readTextFile(const std::string& path);

}  // namespace limen
