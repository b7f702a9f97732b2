// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "experiments/base/video_codec/functions.h"

namespace limen {

/// Of a file's name, in lower case: ".avi".
std::string videoEnding(const std::string& path);

/// Checks of a video before and after OpenCV opens it. Each throws Error naming the file.

/// A regular file that begins as videos do. OpenCV also takes lists of other files and addresses.
void checkVideoFile(const std::string& path);
/// What the file states about its size is within imageLimits().
void checkStatedVideo(const codec::StatedVideo& stated, const std::string& path);
/// It is no shorter than it states. Returns a remark if so little is missing that the file may be whole.
std::string checkVideoLength(const codec::StatedVideo& stated, int64_t frames, double lastS,
                             const std::string& path);

}  // namespace limen
