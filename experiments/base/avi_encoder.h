// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "experiments/base/video_codec/functions.h"

namespace limen {

/// JPEG pictures in an AVI file, which every player and OpenCV's own reader take. OpenCV's built-in writer of
/// the same format damages the last block of about one picture in fifty (4.6) and rounds the frame rate to
/// whole numbers, so the pictures come from the image library and the container is written here: RIFF AVI 1.0
/// with an index, up to 4 GiB.
class AviEncoder : public codec::VideoEncoder {
 public:
  /// Writes to `file`; errors name `path`. Throws Error.
  AviEncoder(const std::string& file, std::string path, int width, int height, double framesPerSecond);
  ~AviEncoder() override;
  AviEncoder(const AviEncoder&) = delete;
  AviEncoder& operator=(const AviEncoder&) = delete;

  void add(const Image& image) override;
  void close() override;

 private:
  struct Chunk {
    uint32_t offset = 0, bytes = 0;
  };

  void append(const std::string& bytes);
  std::string header() const;

  std::string path_;
  int file_ = -1, width_, height_;
  uint32_t scale_ = 1, rate_ = 1;  ///< rate / scale frames a second
  uint64_t size_ = 0;
  std::vector<Chunk> chunks_;
};

}  // namespace limen
