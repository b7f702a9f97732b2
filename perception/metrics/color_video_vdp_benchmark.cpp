// SPDX-License-Identifier: BSD-3-Clause
// limen-color-video-vdp-benchmark: GPU times of ColorVideoVDP by pass, the memory it holds and its distance
// from the version in double precision, as CSV on standard output. Arguments: none, or "quick" for one small
// size.
#include <epoxy/gl.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/program.h"
#include "perception/metrics/color_video_vdp/color_video_vdp_gpu.h"
#include "perception/metrics/color_video_vdp/reference.h"

namespace {

using namespace limen;
using namespace limen::perception;
using cvvdp::ColorVideoVdpGpu;
using HostClock = std::chrono::steady_clock;

constexpr double kWarmUpS = 0.5;  ///< an idle GPU takes up to a third of a second to raise its clock
constexpr int kStored = 4;        ///< frames of each video, shown in turn

double seconds(HostClock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// Moving colour waves; the test has noise.
Image frame(glm::ivec2 size, int index, double noise) {
  std::mt19937 random(static_cast<unsigned>(index));
  Image out(size.x, size.y, 4, 1.0F);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      for (int c = 0; c < 3; ++c) {
        const double value = 0.45 + 0.3 * std::sin(0.021 * x + 0.013 * y + 0.4 * index + c) +
                             noise * ((random() >> 8) * 0x1p-24 - 0.5);
        out.at(x, y, c) = static_cast<float>(std::round(255.0 * std::clamp(value, 0.0, 1.0)) / 255.0);
      }
  return out;
}

struct Videos {
  std::vector<gl::Texture> test, reference;
};

Videos upload(glm::ivec2 size, gl::Format format) {
  Videos out;
  for (int i = 0; i < kStored; ++i)
    for (auto* video : {&out.test, &out.reference}) {
      video->emplace_back(format, size).write(frame(size, i, video == &out.test ? 0.1 : 0.0));
    }
  return out;
}

void printRow(glm::ivec2 size, const std::string& content, const std::string& what, double value, double low,
              double high, const char* unit, size_t count) {
  fmt::print("{},{},{},{},{:.6g},{:.6g},{:.6g},{},{}\n", size.x, size.y, content, what, value, low, high,
             unit, count);
}

void measure(gl::Context& context, glm::ivec2 size, double framesPerSecond, gl::Format format, bool map) {
  const bool video = framesPerSecond > 0.0, software = context.device().software;
  const std::string content =
      fmt::format("{} {}{}", video ? fmt::format("video {:g} fps", framesPerSecond) : "image",
                  format == gl::Format::RGBA8 ? "RGBA8" : "RGBA32F", map ? " with map" : "");
  cvvdp::Options options;
  options.display = cvvdp::readDisplay("standard_fhd");
  options.framesPerSecond = framesPerSecond;
  options.map = map;
  const Videos videos = upload(size, format);
  ColorVideoVdpGpu metric(context, size, options, video);
  gl::PassList passes;
  int shown = 0;
  const auto add = [&](bool stages) {
    const auto at = static_cast<size_t>(shown++ % kStored);
    passes.beginFrame();
    metric.add(videos.test[at], videos.reference[at], stages ? &passes : nullptr);
    passes.endFrame();
  };
  add(true);
  const auto start = HostClock::now();
  do {
    add(false);
    glFinish();
  } while (seconds(HostClock::now() - start) < kWarmUpS);
  // Once without timestamps between the passes, which keep kernels from overlapping, and once with them.
  for (const bool stages : {false, true}) {
    const int frames = software ? 3 : 200;
    metric.begin(frames);
    for (int i = 0; video && !software && i < 32; ++i) add(false);  // fills the ring
    passes.startRecording(software ? gl::Clock::Wall : gl::Clock::Gpu, frames);
    for (int i = 0; i < frames; ++i) add(stages);
    std::map<std::string, std::vector<double>> times;
    for (const gl::PassTime& time : passes.finishRecording())
      times[time.pass].push_back(1e-6 * static_cast<double>(time.nanoseconds));
    for (auto& [pass, ms] : times) {
      std::sort(ms.begin(), ms.end());
      const std::string name = pass == "frame" ? (stages ? "frame with timestamps" : "frame") : pass;
      printRow(size, content, name, ms[ms.size() / 2], ms.front(), ms[ms.size() * 95 / 100], "ms", ms.size());
    }
  }
  if (video) {
    // Frames as fast as they go, without timestamps: what a long video costs.
    const int frames = software ? 3 : 300;
    glFinish();
    const auto begin = HostClock::now();
    for (int i = 0; i < frames; ++i)
      metric.add(videos.test[static_cast<size_t>(i % kStored)],
                 videos.reference[static_cast<size_t>(i % kStored)]);
    glFinish();
    printRow(size, content, "wall time a frame, back to back",
             1e3 * seconds(HostClock::now() - begin) / frames, 0, 0, "ms", static_cast<size_t>(frames));
  }
  printRow(size, content, "memory", static_cast<double>(metric.bytesHeld()) / 1048576.0, 0, 0, "MiB", 1);
}

void compare(gl::Context& context, glm::ivec2 size, double framesPerSecond, int frames) {
  cvvdp::Options options;
  options.display = cvvdp::readDisplay("standard_fhd");
  options.framesPerSecond = framesPerSecond;
  const cvvdp::Pair pair = {size.x, size.y, frames, [&](int i) { return frame(size, i, 0.1); },
                            [&](int i) { return frame(size, i, 0.0); }};
  const double expected = cvvdp::evaluate(pair, options).score.jod;
  const double actual = cvvdp::evaluateOnGpu(context, pair, options).jod;
  printRow(size, fmt::format("{} frames", frames), "JOD, error against double precision", actual,
           actual - expected, 0, "JOD", 1);
}

int measureAll(bool quick) {
  try {
    const auto context = gl::createHeadlessContext();
    fmt::print("# {}{}\nwidth,height,content,what,value,least,p95,unit,count\n", context->device().line(),
               context->device().software ? " (wall time on a CPU)" : "");
    const glm::ivec2 size = quick ? glm::ivec2(320, 180) : glm::ivec2(1920, 1080);
    for (const double framesPerSecond : {0.0, 30.0, 60.0})
      for (const gl::Format format : {gl::Format::RGBA8, gl::Format::RGBA32F})
        measure(*context, size, framesPerSecond, format, false);
    measure(*context, size, 30.0, gl::Format::RGBA8, true);
    compare(*context, size, 0.0, 1);
    compare(*context, glm::ivec2(320, 180), 60.0, 20);
    context->checkDebugMessages();
    return kExitSuccess;
  } catch (const std::exception& error) {
    fmt::print(stderr, "limen-color-video-vdp-benchmark: {}\n", error.what());
    return kExitFailedRuns;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("GPU time of ColorVideoVDP for images and videos of 1920 x 1080, and its error, as CSV.",
               "limen-color-video-vdp-benchmark");
  int exitCode = kExitSuccess;
  std::string what;
  app.add_option("quick", what, "only a small size, to see that it works")->check(CLI::IsMember({"quick"}));
  app.callback([&] { exitCode = measureAll(what == "quick"); });
  return runProgram(app, argc, argv, exitCode);
}
