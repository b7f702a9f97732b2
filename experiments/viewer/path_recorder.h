// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace limen::viewer {

/// How far a recorded path may be from the camera that was recorded, at the times of its samples.
struct PathTolerance {
  double position = 1e-3;  ///< of eye and target, share of their distance
  double up = 1e-3;        ///< of `up`, share of its length
  double fovDeg = 1e-2;
};

/// True if `camera` stands for `sample` within the tolerance.
bool isWithin(const scene::Camera& camera, const scene::Camera& sample, const PathTolerance& tolerance);

/// A path through some of `samples` (ascending times, none twice) that is within the tolerance of each of
/// them at its time. No inner key can be left out alone.
scene::CameraPath reducedPath(const std::vector<scene::CameraPath::Key>& samples,
                              const PathTolerance& tolerance = {});

/// Takes a camera at given intervals while it moves.
class PathRecorder {
 public:
  /// `intervalS` > 0: samples are at least so far apart.
  explicit PathRecorder(double intervalS) : intervalS_(intervalS) {}

  /// The camera at `timeS`, s, on any ascending clock; called once a frame. Times that do not ascend are left
  /// out.
  void add(double timeS, const scene::Camera& camera);

  /// The samples, and the last camera whenever it was; the first sample's time is 0.
  std::vector<scene::CameraPath::Key> samples() const;

  /// The samples as a path. Empty if nothing was added.
  scene::CameraPath path(const PathTolerance& tolerance = {}) const {
    return reducedPath(samples(), tolerance);
  }

 private:
  double intervalS_;
  std::vector<scene::CameraPath::Key> samples_;
  scene::CameraPath::Key last_;
};

}  // namespace limen::viewer
