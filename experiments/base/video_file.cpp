// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/video_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen {
namespace {

namespace fs = std::filesystem;

bool beginsAsVideo(const std::array<char, 16>& head) {
  const auto at = [&](size_t place, const char* word) {
    return std::memcmp(head.data() + place, word, std::strlen(word)) == 0;
  };
  const auto byte = [&](size_t place) { return static_cast<unsigned char>(head[place]); };
  if (at(0, "RIFF") && at(8, "AVI ")) return true;
  for (const char* box : {"ftyp", "moov", "mdat", "free", "skip", "wide", "pnot"})  // MP4, QuickTime
    if (at(4, box)) return true;
  if (at(0, "\x1A\x45\xDF\xA3") || at(0, "OggS") || at(0, "\x30\x26\xB2\x75")) return true;
  return byte(0) == 0 && byte(1) == 0 && byte(2) == 1 && (byte(3) == 0xBA || byte(3) == 0xB3);  // MPEG
}

}  // namespace

std::string videoEnding(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending;
}

void checkVideoFile(const std::string& path) {
  std::error_code code;
  if (!fs::exists(path, code)) throw Error("no such video '" + path + "'", {}, "check the path");
  if (!fs::is_regular_file(path, code))
    throw Error("'" + path + "' is not a file but a folder, a pipe or a device", {}, "name a video file");
  std::array<char, 16> head{};
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), head.size());
  if (in.gcount() < static_cast<std::streamsize>(head.size()))
    throw Error("'" + path + "' is " + (in.gcount() == 0 ? "empty" : "too short for a video"), {},
                "is the file complete?");
  if (!beginsAsVideo(head))
    throw Error("'" + path + "' is named like a video but does not begin like one", {},
                "AVI, Matroska, WebM, MP4, QuickTime, Ogg, MPEG and WMV are known");
}

void checkStatedVideo(const codec::StatedVideo& stated, const std::string& path) {
  if (stated.width < 1 || stated.height < 1) throw Error("'" + path + "' states no size of its pictures");
  std::error_code code;
  const auto bytes = static_cast<double>(fs::file_size(path, code));
  const ImageLimits& limits = imageLimits();
  const double allowed = std::min(
      1e6 * limits.megapixels, 1e6 * limits.alwaysMegapixels + limits.pixelsPerByte * (code ? 0.0 : bytes));
  if (static_cast<double>(stated.width) * stated.height > allowed)
    throw Error(
        fmt::format("'{}' states pictures of {} x {} pixels, which is too large for {} bytes or beyond "
                    "{} megapixels",
                    path, stated.width, stated.height, shortestNumber(bytes), shortestNumber(allowed / 1e6)),
        {}, "if it is right, allow it: limen perceive --max-megapixels N");
}

std::string checkVideoLength(const codec::StatedVideo& stated, int64_t frames, double lastS,
                             const std::string& path) {
  if (frames < 1) throw Error("no frame of '" + path + "' can be decoded", {}, "is the file complete?");
  if (!(stated.frames > 0.0)) return {};
  const double rate = stated.framesPerSecond;
  double lost = stated.frames - static_cast<double>(frames);
  // At a varying rate the number is an estimate, but the last frame's time tells.
  if (rate > 0.0 && lastS > 0.0) lost = std::min(lost, stated.frames - rate * lastS - 1.0);
  // AVI states the number itself. Elsewhere sound may outlast the pictures.
  const double allowed = videoEnding(path) == ".avi" ? 0.5 : std::max(1.5, 0.5 * rate);
  if (lost <= 0.5) return {};
  const std::string words =
      fmt::format("{:.0f} frames, of which {} can be decoded", std::round(stated.frames), frames);
  if (lost > allowed)
    throw Error("'" + path + "' states " + words, {},
                "is the file complete? Otherwise encode it again, or give its frames as images");
  return "the file states " + words;
}

}  // namespace limen
