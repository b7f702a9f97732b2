// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/export/export.h"

namespace limen::study {

/// Which clips of a store are written, and how.
struct ClipRequest {
  ExportRequest sessions;                               ///< store, protocol and codes count
  std::string folder;                                   ///< to fill
  std::vector<std::string> formats = {".mkv", ".exr"};  ///< endings of videos; .exr: pictures of light
  std::function<void(size_t, size_t)> progress;         ///< clips done, clips there are
};

struct WrittenClips {
  size_t clips = 0, trials = 0;
  std::vector<std::string> files;  ///< the tables, relative to the folder
};

/// Writes what the participants saw: every stimulus once for each display and window that it was shown on,
/// frame for frame, and beside each clip with a change the same clip without it, which metrics take as
/// reference. Tables: clips.csv (one row per clip, by store::clipName()) and clip_trials.csv (which clip was
/// in which trial and interval). All of it or nothing. Throws Error, also as StimulusRenderer and VideoWriter
/// do.
WrittenClips writeClips(const ClipRequest& request);

}  // namespace limen::study
