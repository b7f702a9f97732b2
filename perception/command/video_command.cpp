// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive video: images, sequences and videos side by side as one video.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/video.h"
#include "perception/command/frame_report.h"
#include "perception/command/image_commands.h"
#include "perception/command/image_input.h"
#include "perception/command/image_sequence.h"
#include "perception/command/video_inputs.h"
#include "perception/metrics/error_map.h"
#include "perception/vision/display.h"

namespace limen::perception {
namespace {

struct VideoOptions {
  std::vector<std::string> inputs;
  std::string output;
  double framesPerSecond = 0.0;
  int gapPx = 0;
};

/// Side by side on black, from the left, at the top.
Image sideBySide(const std::vector<Image>& pictures, int gapPx, bool evenSize) {
  int width = -gapPx, height = 0;
  for (const Image& picture : pictures)
    width += picture.width + gapPx, height = std::max(height, picture.height);
  if (evenSize) width += width % 2, height += height % 2;
  Image canvas(width, height, 3);
  int left = 0;
  for (const Image& picture : pictures) {
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        for (int c = 0; c < 3; ++c)
          canvas.at(left + x, y, c) = picture.at(x, y, picture.channels == 1 ? 0 : c);
    left += picture.width + gapPx;
  }
  return canvas;
}

/// The rate of the videos among the inputs.
double rateOf(const VideoOptions& options, const std::vector<VideoFacts>& videos) {
  if (options.framesPerSecond > 0.0) return options.framesPerSecond;
  double rate = 0.0;
  for (const VideoFacts& facts : videos) {
    if (!(facts.framesPerSecond > 0.0)) continue;
    if (rate > 0.0 && facts.framesPerSecond != rate)
      throw Error(fmt::format("the videos have {:.6g} and {:.6g} frames/s", rate, facts.framesPerSecond),
                  "--fps", "say which the result shall have");
    rate = facts.framesPerSecond;
  }
  constexpr double kUsual = 60.0;
  return rate > 0.0 ? rate : kUsual;
}

/// Pixel values as stored; light (EXR, HDR) is coded by the sRGB curve.
Image pictureOf(const FrameSet& frame, size_t argument, const DisplayProfile& display) {
  InputImage input = readInput(frame, argument, display, {inputParameters(), {}, "video"});
  if (input.coded && !input.values.data.empty()) return std::move(input.values);
  return displayPicture(input.shown());
}

int writeVideo(const VideoOptions& options) {
  if (options.inputs.empty())
    throw Error("there are no images", "video", "give some: limen-perceive video 'frames/*.png' -o out.avi");
  if (options.output.empty())
    throw Error("no file to write is named", "video", "add -o out.avi (.mkv is lossless, .mp4 small)");
  const VideoFormat& format = videoFormatOf(options.output, "--output");
  const DisplayProfile display = displayPreset("desktop_24");
  std::vector<ImageSequence> sequences;
  for (const std::string& input : options.inputs) sequences.push_back(expandImages(input));
  const std::vector<FrameSet> frames = alignSequences(sequences);
  for (const FrameSet& frame : frames)
    for (const std::string& path : frame.paths) protectInput(path);
  requireNoInput(options.output, "--output");
  const double rate = rateOf(options, videosOf(sequences));

  std::unique_ptr<VideoWriter> writer;
  for (const FrameSet& frame : frames) {
    std::vector<Image> pictures;
    for (size_t i = 0; i < sequences.size(); ++i) pictures.push_back(pictureOf(frame, i, display));
    const Image canvas = sideBySide(pictures, options.gapPx, format.evenSize);
    if (!writer) writer = std::make_unique<VideoWriter>(options.output, canvas.width, canvas.height, rate);
    writer->add(canvas);
  }
  writer->finish();
  std::printf("%s: %s; values are pixel values of the display\n", options.output.c_str(),
              writer->description().c_str());
  return kExitSuccess;
}

}  // namespace

void addVideoCommand(CLI::App& app, int& exitCode) {
  const auto options = std::make_shared<VideoOptions>();
  CLI::App* const command = app.add_subcommand(
      "video", "Writes images, sequences and videos as a video; several are shown side by side");
  command
      ->add_option(
          "FRAMES", options->inputs,
          "Sequences (frame_%04d.png, frame_####.png, 'frames/*.png'), videos, or images that stay; all of "
          "the same number of frames")
      ->type_name("");
  command
      ->add_option(
          "-o,--output", options->output,
          "Video: .avi (JPEG pictures; can be written everywhere), .mkv (lossless), .mp4 or .mov (H.264)")
      ->type_name("FILE");
  command
      ->add_option("--fps", options->framesPerSecond,
                   "Frames per second (default: those of the videos given, otherwise 60)")
      ->type_name("RATE")
      ->check(CLI::Range(0.1, 1000.0));
  command->add_option("--gap", options->gapPx, "Black pixels between pictures that are side by side")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  command->callback([options, &exitCode] { exitCode = writeVideo(*options); });
}

}  // namespace limen::perception
