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

/// True if `camera` matches `sample` within the tolerance.
bool isWithin(const scene::Camera& camera, const scene::Camera& sample, const PathTolerance& tolerance);

/// A path through some of `samples` (strictly ascending times) that is within the tolerance of each of them
/// at its time. No single inner key can be left out.
scene::CameraPath reducedPath(const std::vector<scene::CameraPath::Key>& samples,
                              const PathTolerance& tolerance = {});

/// Samples a moving camera at given intervals.
class PathRecorder {
 public:
  /// `intervalS` > 0: smallest time between samples.
  explicit PathRecorder(double intervalS) : intervalS_(intervalS) {}

  /// The camera at `timeS`, s, on any monotonic clock; called once per frame. Times that do not ascend are
  /// ignored.
  void add(double timeS, const scene::Camera& camera);

  /// The samples and, whatever its time, the last camera; the first sample's time is 0.
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
