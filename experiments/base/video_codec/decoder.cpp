// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <opencv2/videoio/registry.hpp>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/video_codec/functions.h"
#include "experiments/base/video_codec/quiet.h"

namespace limen::codec {
namespace {

/// As readImageFile() scales 8 bits, to the last digit.
constexpr float kCode = 1.0F / 255.0F;

class OpenCvDecoder : public VideoDecoder {
 public:
  OpenCvDecoder(cv::VideoCapture capture, std::string path)
      : capture_(std::move(capture)), path_(std::move(path)) {
    const auto stated = [&](int property) {
      const double value = capture_.get(property);
      return std::isfinite(value) ? value : 0.0;
    };
    stated_.width = static_cast<int>(stated(cv::CAP_PROP_FRAME_WIDTH));
    stated_.height = static_cast<int>(stated(cv::CAP_PROP_FRAME_HEIGHT));
    stated_.framesPerSecond = std::max(stated(cv::CAP_PROP_FPS), 0.0);
    stated_.frames = stated(cv::CAP_PROP_FRAME_COUNT);
    stated_.codec = lettersOf(stated(cv::CAP_PROP_FOURCC));
    stated_.pixelFormat = lettersOf(stated(cv::CAP_PROP_CODEC_PIXEL_FORMAT));
    stated_.decoder = capture_.getBackendName();
    const double across = stated(cv::CAP_PROP_SAR_NUM), down = stated(cv::CAP_PROP_SAR_DEN);
    if (across > 0.0 && down > 0.0) stated_.pixelAspect = across / down;
  }

  const StatedVideo& stated() const override { return stated_; }

  bool advance() override {
    try {
      return capture_.grab();
    } catch (const std::exception&) {  // of OpenCV and whatever is behind it
      return false;
    }
  }

  double timeS() const override {
    const double time = capture_.get(cv::CAP_PROP_POS_MSEC) / 1000.0;
    return std::isfinite(time) ? time : 0.0;
  }

  Image picture() override {
    cv::Mat frame;
    bool good = false;
    try {
      good = capture_.retrieve(frame);
    } catch (const std::exception&) {
    }
    if (!good || frame.depth() != CV_8U || frame.channels() != 3)
      throw Error("a frame of '" + path_ + "' cannot be decoded", {}, "is the file complete?");
    if (frame.cols != stated_.width || frame.rows != stated_.height)
      throw Error("'" + path_ + "' changes its size on the way, to " + std::to_string(frame.cols) + " x " +
                      std::to_string(frame.rows),
                  {}, "cut it where the size changes");
    Image image(frame.cols, frame.rows, 3);
    float* to = image.data.data();
    for (int y = 0; y < frame.rows; ++y) {
      const unsigned char* from = frame.ptr(y);
      for (int x = 0; x < frame.cols; ++x, from += 3)
        for (int c = 0; c < 3; ++c) *to++ = static_cast<float>(from[2 - c]) * kCode;
    }
    return image;
  }

 private:
  cv::VideoCapture capture_;
  std::string path_;
  StatedVideo stated_;
};

}  // namespace

std::unique_ptr<VideoDecoder> openVideo(const std::string& file, const std::string& path) {
  // Not CAP_ANY: it would also take cameras, and names as patterns of images. The built-in reader of Motion
  // JPEG prints messages of its own and is the last resort.
  std::vector<int> backends;
  for (const int backend : {cv::CAP_FFMPEG, cv::CAP_GSTREAMER})
    if (cv::videoio_registry::hasBackend(static_cast<cv::VideoCaptureAPIs>(backend)))
      backends.push_back(backend);
  if (backends.empty()) backends.push_back(cv::CAP_OPENCV_MJPEG);
  for (const int backend : backends) {
    try {
      cv::VideoCapture capture(file, backend);
      if (capture.isOpened()) return std::make_unique<OpenCvDecoder>(std::move(capture), path);
    } catch (const std::exception&) {  // the next one may read it
    }
  }
  throw Error("cannot read video '" + path + "': none of OpenCV's decoders here takes it", {},
              "is the file complete? Otherwise convert it, or give its frames as images: frame_%04d.png");
}

}  // namespace limen::codec
