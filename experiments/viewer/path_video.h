// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/viewer/setup.h"

namespace limen::viewer {

struct PathVideoOptions {
  std::string file;  ///< .avi, .mkv, .mp4, .mov
  double framesPerSecond = 60.0;
  double seconds = 0.0;  ///< from the scene's chosen time on; 0: to the end of its camera path
};

/// Renders the technique, and the second one beside it if there is one, along the scene's camera path,
/// without the interface. Each frame is what a sweep renders with its `camera.time_s`. Returns a description
/// of the video. Throws Error: a camera that rests and no length, what a scene or a technique throws, a video
/// that cannot be written.
std::string writePathVideo(const ViewSetup& setup, const PathVideoOptions& options);

}  // namespace limen::viewer
