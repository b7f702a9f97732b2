// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/base/quantity.h"
#include "experiments/store/store.h"

namespace limen::analysis {

/// A quantity on an axis or over a column: a measurement or a parameter, as the store describes it.
struct Axis {
  std::string name;   ///< measurement, or path of a parameter: "budget.rim"
  std::string title;  ///< without the unit
  std::string unit;
  std::string pass;                    ///< frame_time rows that it is the median of; "": none
  std::optional<Direction> direction;  ///< nullopt: the store does not say
  bool parameter = false;

  /// Drawn upside down on a linear axis. Where nothing is better, less is taken to be.
  bool higherIsBetter() const { return direction == Direction::HigherIsBetter; }
  /// "GPU time (ms)"
  std::string label() const;
};

/// A parameter's value, for a reader.
struct Setting {
  std::string path;   ///< with its subject: "technique.budget.rim"
  std::string value;  ///< as text
};

/// What the names of an experiment mean, from the tables of its store. Of an older store that does not say,
/// words of the name stand for a title.
class Names {
 public:
  Names() = default;
  explicit Names(store::Descriptions descriptions) : descriptions_(std::move(descriptions)) {}

  const store::Descriptions& descriptions() const { return descriptions_; }
  /// A measured quantity, else a parameter of techniques, scenes or images, by its path. `software`: times of
  /// frames were taken on a CPU.
  Axis axis(const std::string& name, bool software = false) const;
  /// A parameter by its path with its subject. Where several declare one under that path, the first's title,
  /// and no unit if theirs differ.
  Axis parameter(const std::string& subjectAndPath) const;
  /// "budget radial, rim 25 px": each value after its name, which is the last part of its path where the
  /// owner has just been named, else the whole path.
  std::string describe(const std::vector<Setting>& settings) const;
  /// What groups are made by (technique, scene, image or a parameter), as a heading.
  std::string heading(const std::string& by) const;

 private:
  store::Descriptions descriptions_;
};

}  // namespace limen::analysis
