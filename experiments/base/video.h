// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "experiments/base/image.h"

namespace limen {

namespace codec {
class VideoDecoder;
class VideoEncoder;
}  // namespace codec

/// Whether a name ends like a video that Limen reads (.avi, .mkv, .mov, .mp4 and others), in either case.
bool isVideoName(const std::string& path);

/// What a video file is, and what becomes of its colours when it is read.
struct VideoFacts {
  std::string path;
  int width = 0, height = 0;         ///< pixels
  double framesPerSecond = 0.0;      ///< as the file states it; 0 if it does not
  int64_t frames = 0;                ///< that can be decoded
  std::string codec;                 ///< four letters: "MJPG", "FFV1", "avc1"
  std::string decoder;               ///< of OpenCV: "FFMPEG", "CV_MJPEG"
  std::string colour;                ///< how values become R, G and B, as text
  std::vector<std::string> remarks;  ///< what may be wrong with that, for warnings

  /// "8-bit MJPG video, 30 frames/s"
  std::string kind() const;
};

/// Reads a video frame by frame: 3 channels (R, G, B) of 8-bit pixel values scaled to [0, 1], row 0 at the
/// top.
class VideoReader {
 public:
  /// Decodes the file once to count its frames. Throws Error naming the file: no regular file, not a video,
  /// cut off, beyond imageLimits(), a million frames or more.
  explicit VideoReader(const std::string& path);
  ~VideoReader();
  VideoReader(const VideoReader&) = delete;
  VideoReader& operator=(const VideoReader&) = delete;

  const VideoFacts& facts() const { return facts_; }
  /// Frame `index`, from 0. In order they cost one decoding each; the last two are held, and going further
  /// back starts over. Throws Error.
  const Image& frame(int64_t index);

 private:
  void open();

  VideoFacts facts_;
  std::unique_ptr<codec::VideoDecoder> decoder_;
  int64_t next_ = 0;  ///< index that the decoder gives next
  struct Held {
    int64_t index = -1;
    Image image;
  };
  std::array<Held, 2> held_;  ///< by index modulo 2
};

/// Formats of videos that are written, by the ending of their names.
struct VideoFormat {
  const char* ending;
  const char* codec;    ///< four letters
  const char* meaning;  ///< how pixel values are stored
  bool lossless = false;
  bool always = false;    ///< can be written everywhere; the others need FFmpeg behind OpenCV
  bool evenSize = false;  ///< width and height must be even
};
const std::vector<VideoFormat>& videoFormats();
/// Of a file's ending. Throws Error for others, naming those there are.
const VideoFormat& videoFormatOf(const std::string& path, const std::string& option = {});

/// Writes a video. The file appears, complete and read back, when finish() returns.
class VideoWriter {
 public:
  /// Throws Error: an unknown ending, a size that the format does not take, no encoder on this machine, a
  /// place that cannot be written.
  VideoWriter(const std::string& path, int width, int height, double framesPerSecond);
  /// Leaves nothing unless finish() was called.
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// 1 or 3 channels of pixel values in [0, 1], stored as 8 bits, as in PNG. Throws Error.
  void add(const Image& image);
  /// Closes the file, checks that it holds every frame, and puts it in place. Throws Error.
  void finish();
  /// "MJPG video, 30 frames/s, ...": the file and what its values are.
  std::string description() const;

 private:
  struct Files;

  std::unique_ptr<Files> files_;
  std::unique_ptr<codec::VideoEncoder> encoder_;
  int width_, height_;
  double framesPerSecond_;
  int64_t frames_ = 0;
};

}  // namespace limen
