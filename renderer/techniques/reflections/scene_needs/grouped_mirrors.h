// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/gl/program.h"
#include "renderer/techniques/scene_needs/candidate.h"

namespace limen::techniques {

/// Mirrors that are shown by one technique.
struct MirrorGroup {
  Candidate candidate;
  std::vector<size_t> parts;       ///< of Scene::parts
  std::vector<std::string> names;  ///< theirs, for records
};

/// Shows each group of mirrors by its own technique, whose picture is taken where pixels see the group.
/// Surfaces that pixels see, their light and whatever else does not depend on which mirrors are shown are
/// made once.
class GroupedMirrors : public Technique {
 public:
  /// One group at least, each with a part at least.
  explicit GroupedMirrors(std::vector<MirrorGroup> groups) : groups_(std::move(groups)) {}

  void prepare(frame::Frame& frame) override;
  void render(frame::Frame& frame) override;
  const gl::Texture& product() const override { return *picture_; }
  /// Of all techniques, one after another: names repeat.
  std::vector<Counter> count(frame::Frame& frame) override;

 private:
  struct Shown {
    std::unique_ptr<frame::Frame> frame;
    std::unique_ptr<Technique> technique;
  };
  std::vector<MirrorGroup> groups_;
  std::vector<Shown> shown_;
  const gl::Program* join_ = nullptr;
  std::optional<gl::Texture> picture_;
};

/// GroupedMirrors as a candidate, or the technique itself where there is only one group.
Candidate candidateOf(const std::vector<MirrorGroup>& groups);

}  // namespace limen::techniques
