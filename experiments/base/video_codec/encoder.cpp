// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "experiments/base/error.h"
#include "experiments/base/video_codec/functions.h"

namespace limen::codec {
namespace {

class OpenCvEncoder : public VideoEncoder {
 public:
  OpenCvEncoder(cv::VideoWriter writer, std::string path)
      : writer_(std::move(writer)), path_(std::move(path)) {}

  void add(const Image& image) override {
    cv::Mat frame(image.height, image.width, CV_8UC3);
    const auto channels = static_cast<size_t>(image.channels);
    const float* from = image.data.data();
    for (int y = 0; y < image.height; ++y) {
      unsigned char* to = frame.ptr(y);
      for (int x = 0; x < image.width; ++x, from += channels, to += 3)
        for (size_t c = 0; c < 3; ++c) {
          const float value = from[channels < 3 ? 0 : c];
          to[2 - c] =
              static_cast<unsigned char>(std::lround(255.0F * (value > 0.0F ? std::min(value, 1.0F) : 0.0F)));
        }
    }
    attempt([&] { writer_.write(frame); });
  }

  void close() override {
    attempt([&] { writer_.release(); });
  }

 private:
  template <class Work>
  void attempt(Work&& work) const {
    try {
      work();
    } catch (const std::exception& error) {
      throw Error("'" + path_ + "' cannot be encoded: " + error.what());
    }
  }

  cv::VideoWriter writer_;
  std::string path_;
};

}  // namespace

std::unique_ptr<VideoEncoder> createVideo(const std::string& file, const std::string& path,
                                          const VideoFormat& format, int width, int height,
                                          double framesPerSecond) {
  const char* letters = format.codec;
  const int code = cv::VideoWriter::fourcc(letters[0], letters[1], letters[2], letters[3]);
  std::string reason = "no encoder for " + std::string(letters) + " behind OpenCV on this machine";
  try {
    cv::VideoWriter writer(file, cv::CAP_FFMPEG, code, framesPerSecond, {width, height});
    if (writer.isOpened()) return std::make_unique<OpenCvEncoder>(std::move(writer), path);
  } catch (const std::exception& error) {
    reason = error.what();
  }
  throw Error("'" + path + "' cannot be written: " + reason, {},
              "write .avi, which needs none, or PNG images");
}

}  // namespace limen::codec
