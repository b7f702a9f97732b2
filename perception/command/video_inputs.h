// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "experiments/base/video.h"

namespace limen::perception {

/// The reader of a video that this call reads. One for each file, whichever arguments name it, so that frames
/// are decoded once in order. Throws Error like VideoReader.
VideoReader& videoInput(const std::string& path);
/// Of the file, computed once.
const std::string& videoSha256(const std::string& path);
/// "a.avi: 8-bit MJPG video, 30 frames/s, 640 x 480, 120 frames; JPEG's Rec. 601 matrix, full range; decoded
/// by FFMPEG"
std::string videoLine(const VideoFacts& facts);

}  // namespace limen::perception
