// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace limen::frame {

/// A choice among a scene's mirrors.
class ShownMirrors {
 public:
  /// All.
  ShownMirrors() = default;
  /// Those among `parts`, numbers in Scene::parts, alone.
  explicit ShownMirrors(const std::vector<size_t>& parts) : all_(false) {
    for (const size_t part : parts) {
      if (part >= shown_.size()) shown_.resize(part + 1, false);
      shown_[part] = true;
    }
  }

  bool all() const { return all_; }
  bool has(size_t part) const { return all_ || (part < shown_.size() && shown_[part]); }

 private:
  bool all_ = true;
  std::vector<bool> shown_;
};

}  // namespace limen::frame
