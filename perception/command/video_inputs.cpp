// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/video_inputs.h"

#include <fmt/format.h>

#include <map>
#include <memory>

#include "experiments/base/hash.h"
#include "experiments/base/input_files.h"

namespace limen::perception {
namespace {

struct OpenVideo {
  std::unique_ptr<VideoReader> reader;
  std::string sha256;
};

OpenVideo& openVideoOf(const std::string& path) {
  static std::map<std::string, OpenVideo> all;
  OpenVideo& video = all[resolvedPath(path)];
  if (!video.reader) video.reader = std::make_unique<VideoReader>(path);
  return video;
}

}  // namespace

VideoReader& videoInput(const std::string& path) { return *openVideoOf(path).reader; }

const std::string& videoSha256(const std::string& path) {
  OpenVideo& video = openVideoOf(path);
  if (video.sha256.empty()) video.sha256 = sha256File(path);
  return video.sha256;
}

std::string videoLine(const VideoFacts& facts) {
  return fmt::format("{}: {}, {} x {}, {} frame{}; {}; decoded by {}", facts.path, facts.kind(), facts.width,
                     facts.height, facts.frames, facts.frames == 1 ? "" : "s", facts.colour, facts.decoder);
}

}  // namespace limen::perception
