// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/video.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/input_files.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/text.h"
#include "experiments/base/video_codec/functions.h"
#include "experiments/base/video_file.h"

namespace limen {
namespace {

constexpr int64_t kMostFrames = 1'000'000;

/// What OpenCV does with colours: FFmpeg's default conversion, whatever the file says.
void describeColour(const codec::StatedVideo& stated, VideoFacts& facts) {
  const std::string& layout = stated.pixelFormat;
  if (stated.decoder == "GSTREAMER") {
    facts.colour = "converted by GStreamer as the file declares";
  } else if (stated.codec == "MJPG") {
    facts.colour = "JPEG's Rec. 601 matrix, full range";
  } else if (layout.rfind("RGB", 0) == 0 || layout.rfind("BGR", 0) == 0 || layout.rfind("G3", 0) == 0) {
    facts.colour = "RGB as stored";
  } else {
    facts.colour = "Rec. 601 matrix, studio range";
    facts.remarks.push_back(
        "colours are decoded with the Rec. 601 matrix and studio range unless the codec fixes another, "
        "whatever the file declares; if it means Rec. 709, saturated colours are off");
  }
}

std::string rateText(double framesPerSecond) {
  return framesPerSecond > 0.0 ? fmt::format("{:.6g} frames/s", framesPerSecond) : "no frame rate";
}

}  // namespace

bool isVideoName(const std::string& path) {
  const std::string ending = videoEnding(path);
  static const std::vector<std::string> kEndings = {".avi", ".m4v",  ".mkv", ".mov",  ".mp4",
                                                    ".mpg", ".mpeg", ".ogv", ".webm", ".wmv"};
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

std::string VideoFacts::kind() const {
  return fmt::format("8-bit {} video, {}", codec.empty() ? "unnamed" : codec, rateText(framesPerSecond));
}

VideoReader::VideoReader(const std::string& path) {
  protectInput(path);
  facts_.path = path;
  namingFile(path, [&] {
    checkVideoFile(path);
    open();
    const codec::StatedVideo stated = decoder_->stated();
    checkStatedVideo(stated, path);
    facts_.width = stated.width, facts_.height = stated.height;
    facts_.framesPerSecond = stated.framesPerSecond;
    facts_.codec = stated.codec, facts_.decoder = stated.decoder;
    describeColour(stated, facts_);
    if (std::abs(stated.pixelAspect - 1.0) > 1e-3)
      facts_.remarks.push_back(fmt::format(
          "pixels are {:.4g} times as wide as high; they are taken as square", stated.pixelAspect));
    double lastS = 0.0;
    while (decoder_->advance()) {
      throwIfInterrupted();
      if (++facts_.frames >= kMostFrames)
        throw Error("'" + path + "' has a million frames or more", {}, "cut it");
      lastS = decoder_->timeS();
    }
    const std::string remark = checkVideoLength(stated, facts_.frames, lastS, path);
    if (!remark.empty()) facts_.remarks.push_back(remark);
    decoder_.reset();
  });
}

VideoReader::~VideoReader() = default;

void VideoReader::open() {
  decoder_ = codec::videoFunctions().open(resolvedPath(facts_.path), facts_.path);
  next_ = 0;
}

const Image& VideoReader::frame(int64_t index) {
  Held& held = held_[static_cast<size_t>(index) % 2];
  if (held.index == index) return held.image;
  namingFile(facts_.path, [&] {
    if (!decoder_ || index < next_) open();
    for (; next_ <= index; ++next_) {
      throwIfInterrupted();
      if (!decoder_->advance())
        throw Error(fmt::format("'{}' ends before frame {}", facts_.path, index + 1), {},
                    "did the file change meanwhile?");
    }
    held.index = -1;
    held.image = decoder_->picture();
    held.index = index;
  });
  return held.image;
}

}  // namespace limen
