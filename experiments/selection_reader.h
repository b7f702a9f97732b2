// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/catalogue.h"
#include "experiments/base/node_reader.h"
#include "experiments/descriptor.h"

namespace limen::experiments {

/// Base of the readers of statements about a descriptor's own runs: names and parameter values are checked
/// against those of the descriptor; unknown ones become problems.
class SelectionReader {
 protected:
  /// `descriptor`: scenes, techniques and metrics have been read.
  SelectionReader(const Descriptor& descriptor, const Catalogue& catalogue, Problems& problems);

  /// The name under `key`, one of `known`; "" if there is none. `what`: its kind, "technique".
  std::string readName(const YamlNode& map, const char* key, const std::vector<std::string>& known,
                       const char* what);
  /// The map under `where`, of runs of `technique` in `scene` ("": any). Parameters inside of choices are
  /// named by path or written as in the entry: `{budget.rim: 25}`, `{budget: {kind: radial, rim: 25}}`.
  Selection readWhere(const YamlNode& map, const std::string& technique, const std::string& scene);

  Problems& problems_;
  FileFinder files_;
  NodeReader reader_;
  std::vector<std::string> techniques_, scenes_;
  std::vector<std::string> quantities_;  ///< names of all measurements that the runs may have

 private:
  /// All declarations of runs of `technique` (any if empty) in `scene`, most specific first.
  std::vector<DeclaredAt> declarations(const std::string& technique, const std::string& scene) const;
  void readCondition(const std::string& path, const YamlNode& key, const YamlNode& value,
                     const std::vector<DeclaredAt>& declared, Selection& out);

  const Catalogue& catalogue_;
  std::vector<Parameter> imageParameters_;
};

}  // namespace limen::experiments
