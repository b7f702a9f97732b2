// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "experiments/base/avi_encoder.h"
#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/part_file.h"
#include "experiments/base/text.h"
#include "experiments/base/video.h"
#include "experiments/base/video_codec/functions.h"
#include "experiments/base/video_file.h"

namespace limen {
namespace {

namespace fs = std::filesystem;

}  // namespace

const std::vector<VideoFormat>& videoFormats() {
  static const std::vector<VideoFormat> kFormats = {
      {".avi", "MJPG", "JPEG pictures (quality 95): Rec. 601 matrix, full range", false, true, false},
      {".mkv", "FFV1", "lossless RGB, full range", true, false, true},
      {".mp4", "avc1", "H.264, Rec. 601 matrix, studio range, which the file does not declare", false, false,
       true},
      {".mov", "avc1", "H.264, Rec. 601 matrix, studio range, which the file does not declare", false, false,
       true}};
  return kFormats;
}

const VideoFormat& videoFormatOf(const std::string& path, const std::string& option) {
  std::vector<std::string> endings;
  for (const VideoFormat& format : videoFormats()) {
    if (videoEnding(path) == format.ending) return format;
    endings.emplace_back(format.ending);
  }
  throw Error("'" + path + "' does not end in " + join(endings, " or "), option,
              "the ending selects the format; .avi can be written everywhere, .mkv is lossless");
}

/// The encoder's file lies in a hidden folder beside its place, since its ending tells the encoder the
/// format.
struct VideoWriter::Files {
  PartFile part;
  const VideoFormat& format;
  std::string path, folder, file;

  explicit Files(const std::string& target)
      : part(target),
        format(videoFormatOf(target)),
        path(target),
        folder(partNameOf(fs::is_symlink(target) ? resolvedPath(target) : target)) {
    std::error_code code;
    fs::create_directory(folder, code);
    if (code) throw Error("cannot be written: " + code.message(), target, "check the folder");
    file = resolvedPath((fs::path(folder) / ("video" + std::string(format.ending))).string());
  }
  ~Files() {
    std::error_code code;
    fs::remove_all(folder, code);
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
};

VideoWriter::VideoWriter(const std::string& path, int width, int height, double framesPerSecond)
    : width_(width), height_(height), framesPerSecond_(framesPerSecond) {
  const VideoFormat& format = videoFormatOf(path);
  if (!(framesPerSecond >= 0.1 && framesPerSecond <= 1000.0))
    throw Error(shortestNumber(framesPerSecond) + " frames/s", path, "allowed: 0.1 to 1000");
  if (format.evenSize && (width % 2 != 0 || height % 2 != 0))
    throw Error(fmt::format("{} takes pictures with even sides only, these are {} x {}", format.ending, width,
                            height),
                path, "write .avi, or PNG images");
  const fs::path folder = fs::path(path).parent_path();
  std::error_code code;
  if (!folder.empty()) fs::create_directories(folder, code);
  files_ = std::make_unique<Files>(path);
  if (format.always) {
    encoder_ = std::make_unique<AviEncoder>(files_->file, path, width, height, framesPerSecond);
    return;
  }
  encoder_ = codec::videoFunctions().create(files_->file, path, format, width, height, framesPerSecond);
}

VideoWriter::~VideoWriter() {
  // The encoder's file goes before its folder.
  encoder_.reset();
}

void VideoWriter::add(const Image& image) {
  if (image.width != width_ || image.height != height_ || (image.channels != 1 && image.channels != 3))
    throw Error(fmt::format("a frame has {} x {} pixels and {} channels, the video {} x {} and 3",
                            image.width, image.height, image.channels, width_, height_),
                files_->path);
  encoder_->add(image);
  ++frames_;
}

void VideoWriter::finish() {
  encoder_->close();
  encoder_.reset();
  const std::string hint = "check the space left on the disk";
  try {
    // Encoders do not say when a disk is full.
    const VideoReader written(files_->file);
    if (written.facts().frames != frames_ || written.facts().width != width_ ||
        written.facts().height != height_)
      throw Error("it holds " + std::to_string(written.facts().frames) + " frames of " +
                  std::to_string(frames_));
  } catch (const Error&) {
    throw Error("'" + files_->path + "' is not complete after writing", {}, hint);
  }
  std::ifstream in(files_->file, std::ios::binary);
  std::vector<char> block(size_t{1} << 20);
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    files_->part.write({block.data(), static_cast<size_t>(in.gcount())});
  }
  if (!in.eof()) throw Error("'" + files_->path + "' cannot be read back", {}, hint);
  files_->part.putInPlace();
}

std::string VideoWriter::description() const {
  return fmt::format("{} frame{} at {:.6g}/s, {} x {}, {}", frames_, frames_ == 1 ? "" : "s",
                     framesPerSecond_, width_, height_, files_->format.meaning);
}

}  // namespace limen
