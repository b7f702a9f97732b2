// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/sweep/names.h"
#include "experiments/store/store.h"

namespace limen::analysis {

/// Every parameter of a run as text, by its path with its subject: "technique.samples",
/// "technique.budget.rim", "image.width". A run has the parameters of the alternatives that were chosen, no
/// others.
std::map<std::string, std::string> flatParameters(const store::Run& run);
/// The value of a parameter by its path alone, looked for in technique, scene and image.
std::optional<std::string> findParameter(const store::Run& run, const std::string& path);

/// The value of a measurement by its name; none if the run does not have it.
std::optional<double> measurementOf(const store::Run& run, const std::string& name);

/// Knows which parameters vary: among the runs of one technique, of one scene, and of the image. One that
/// only some of the runs have varies too.
class Grouping {
 public:
  Grouping(const std::vector<const store::Run*>& runs, const Names& names);

  /// The varying parameters, those of techniques first. Two of the same path, in a technique and in a scene,
  /// are named and titled with their subjects ("scene.seed").
  const std::vector<Axis>& columns() const { return columns_; }
  /// Column name -> value for one run; parameters that its technique or scene does not vary, or that it does
  /// not have, are absent.
  std::map<std::string, std::string> varying(const store::Run& run) const;
  /// What varies among the runs of its technique, for a label: "budget radial, rim 25".
  std::string settings(const store::Run& run) const;
  /// What `by` (technique, scene, image or a parameter) is for a run, as a heading: a scene comes with its
  /// own varying parameters and the image's, since another light size is another problem.
  std::string group(const store::Run& run, const std::string& by) const;

 private:
  std::string describe(const store::Run& run, const std::vector<std::string>& paths) const;

  const Names& names_;
  std::map<std::string, std::vector<std::string>> byTechnique_, byScene_;  ///< name -> varying paths
  std::vector<std::string> image_;
  std::vector<Axis> columns_;
  std::map<std::string, std::string> columnOfPath_;
};

}  // namespace limen::analysis
