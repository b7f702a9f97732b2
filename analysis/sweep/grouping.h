// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/store/store.h"

namespace limen::analysis {

/// Every parameter of a run as text, by dotted path: "technique.samples", "image.width".
std::map<std::string, std::string> flatParameters(const store::Run& run);
/// The value of a parameter by its bare name, looked for in technique, scene and image.
std::optional<std::string> findParameter(const store::Run& run, const std::string& name);

/// Knows which parameters vary: among the runs of one technique, of one scene, and of the image.
class Grouping {
 public:
  explicit Grouping(const std::vector<const store::Run*>& runs);

  /// Names of the varying parameters, those of techniques first. A name that both a technique and a scene
  /// vary keeps its path ("scene.seed").
  const std::vector<std::string>& columns() const { return columns_; }
  /// Column -> value for one run; parameters that its technique or scene does not vary are absent.
  std::map<std::string, std::string> varying(const store::Run& run) const;
  /// What `by` (technique, scene, image or a parameter) is for a run, as a heading: a scene comes with its
  /// own varying parameters and the image's, since another light size is another problem.
  std::string group(const store::Run& run, const std::string& by) const;

 private:
  std::map<std::string, std::vector<std::string>> byTechnique_, byScene_;  ///< name -> varying paths
  std::vector<std::string> image_, columns_;
  std::map<std::string, std::string> columnOfPath_;
};

}  // namespace limen::analysis
