// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/problems.h"
#include "experiments/base/value_reader.h"
#include "experiments/catalogue.h"
#include "experiments/descriptor.h"

namespace limen::experiments {

/// Base of the readers of what a descriptor says about its own runs: names and parameter values are checked
/// against what the descriptor has; what it has not becomes a problem.
class SelectionReader {
 protected:
  /// `descriptor`: scenes, techniques and metrics are read already. `imageParameters`: `width` and `height`.
  SelectionReader(const Descriptor& descriptor, const Catalogue& catalogue,
                  const std::vector<Parameter>& imageParameters, Problems& problems);

  /// `what` has the keys: "an expectation".
  void checkKeys(const YamlNode& map, const char* what, const std::vector<std::string>& known);
  /// The name under `key`, one of `known`; "" if there is none. `what` it is: "technique".
  std::string readName(const YamlNode& map, const char* key, const std::vector<std::string>& known,
                       const char* what);
  /// The map under `where`, of runs of `technique` in `scene` ("": any).
  Selection readWhere(const YamlNode& map, const std::string& technique, const std::string& scene);

  Problems& problems_;
  FileFinder files_;
  ValueReader values_;
  std::vector<std::string> techniques_, scenes_;
  std::vector<std::string> quantities_;  ///< names of all measurements that the runs may have

 private:
  /// Declarations that `name` may mean for runs of `technique` (any if empty) in `scene`, nearest meaning
  /// first.
  std::vector<const Parameter*> declarations(const std::string& technique, const std::string& scene,
                                             const std::string& name, std::vector<std::string>& known) const;

  const Catalogue& catalogue_;
  const std::vector<Parameter>& imageParameters_;
};

}  // namespace limen::experiments
