// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/video_codec/quiet.h"

#include <cstdint>
#include <cstdlib>
#include <opencv2/core/utils/logger.hpp>

namespace limen::codec {

void quietLibraries() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  // Read by OpenCV whenever it opens a file. -8 is AV_LOG_QUIET.
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  ::setenv("OPENCV_FFMPEG_CAPTURE_OPTIONS", "protocol_whitelist;file", 1);
}

std::string lettersOf(double code) {
  const auto value = static_cast<uint32_t>(static_cast<int64_t>(code));
  std::string letters;
  for (int i = 0; i < 4; ++i) {
    const char letter = static_cast<char>((value >> (8 * i)) & 0xFFU);
    if (letter > ' ' && letter <= '~') letters += letter;
  }
  return letters;
}

}  // namespace limen::codec
