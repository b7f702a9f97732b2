// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "experiments/base/video.h"

/// What OpenCV's video input and output does. It pulls in FFmpeg, GStreamer and hundreds of other libraries,
/// which takes a third of a second at start-up, so it is a separate module that a program loads when it first
/// needs a video.
namespace limen::codec {

/// What a file says about itself.
struct StatedVideo {
  int width = 0, height = 0;
  double framesPerSecond = 0.0;
  double frames = 0.0;  ///< may be an estimate from the duration
  std::string codec, pixelFormat, decoder;
  double pixelAspect = 1.0;  ///< width over height of a pixel
};

class VideoDecoder {
 public:
  virtual ~VideoDecoder() = default;
  virtual const StatedVideo& stated() const = 0;
  /// Goes on to the next frame; false at the end, whether or not it is the true one.
  virtual bool advance() = 0;
  /// When that frame is shown, seconds from the start; 0 if unknown.
  virtual double timeS() const = 0;
  /// The frame at which it stands. Throws Error.
  virtual Image picture() = 0;
};

class VideoEncoder {
 public:
  virtual ~VideoEncoder() = default;
  virtual void add(const Image& image) = 0;
  virtual void close() = 0;
};

/// Reads `file`, an absolute name; errors name `path`. Throws Error if nothing here reads it.
std::unique_ptr<VideoDecoder> openVideo(const std::string& file, const std::string& path);
/// Writes to `file`; errors name `path`.
std::unique_ptr<VideoEncoder> createVideo(const std::string& file, const std::string& path,
                                          const VideoFormat& format, int width, int height,
                                          double framesPerSecond);

/// The functions above, as the module exports them.
struct VideoFunctions {
  decltype(&openVideo) open;
  decltype(&createVideo) create;
};
inline constexpr const char* kVideoEntry = "limenVideoCodec";
using VideoEntry = const VideoFunctions* (*)();

/// Loads the module, which is installed beside the program. Throws Error if it is missing.
const VideoFunctions& videoFunctions();

}  // namespace limen::codec
