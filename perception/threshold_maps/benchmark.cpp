// SPDX-License-Identifier: BSD-3-Clause
// limen-threshold-benchmark: GPU time of threshold maps, CSV on standard output. Table 9.1 of Schwarz 2009
// and larger sizes. Arguments: none; --small for sizes up to 1024 x 768, which a software renderer can
// handle; or one size, 1600x1200, of which only the exact stack in 32 bits is measured.
#include <epoxy/gl.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/program.h"
#include "perception/threshold_maps/reference.h"
#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/threshold_maps/threshold_map_gpu.h"

namespace {

using namespace limen;
using perception::DisplayProfile;
using perception::ThresholdMapGpu;
using perception::ThresholdMapSettings;
using HostClock = std::chrono::steady_clock;

constexpr double kWarmUpS = 0.6;  ///< an idle GPU takes up to a third of a second to raise its clock
constexpr int kFrames = 200;
constexpr int kSoftwareFrames = 3;
constexpr int64_t kMostCheckedPx = 1024 * 768;  ///< beyond this the double-precision reference takes seconds

double seconds(HostClock::duration duration) { return std::chrono::duration<double>(duration).count(); }

struct Times {
  double medianMs = 0.0, leastMs = 0.0, p95Ms = 0.0;
  int frames = 0;
};

Times summarise(std::vector<double> ms) {
  std::sort(ms.begin(), ms.end());
  return {ms[ms.size() / 2], ms.front(), ms[ms.size() * 95 / 100], static_cast<int>(ms.size())};
}

/// Single runs between timestamps. A software renderer's timer queries are wrong: it is timed by the host's
/// clock.
Times measure(const std::function<void()>& run, bool software) {
  std::vector<double> ms;
  if (software) {
    for (int i = 0; i < kSoftwareFrames; ++i) {
      const auto begin = HostClock::now();
      run();
      glFinish();
      ms.push_back(1e3 * seconds(HostClock::now() - begin));
    }
    return summarise(ms);
  }
  const auto start = HostClock::now();
  do {
    for (int i = 0; i < 16; ++i) run();
    glFinish();
  } while (seconds(HostClock::now() - start) < kWarmUpS);
  std::vector<GLuint> queries(2 * kFrames);
  glCreateQueries(GL_TIMESTAMP, static_cast<GLsizei>(queries.size()), queries.data());
  for (size_t i = 0; i < queries.size(); i += 2) {
    glQueryCounter(queries[i], GL_TIMESTAMP);
    run();
    glQueryCounter(queries[i + 1], GL_TIMESTAMP);
  }
  for (size_t i = 0; i < queries.size(); i += 2) {
    GLuint64 begin = 0, end = 0;
    glGetQueryObjectui64v(queries[i], GL_QUERY_RESULT, &begin);
    glGetQueryObjectui64v(queries[i + 1], GL_QUERY_RESULT, &end);
    ms.push_back(1e-6 * static_cast<double>(end - begin));
  }
  glDeleteQueries(static_cast<GLsizei>(queries.size()), queries.data());
  return summarise(ms);
}

/// Mean time of back-to-back runs.
double throughputMs(const std::function<void()>& run) {
  GLuint query = 0;
  glCreateQueries(GL_TIME_ELAPSED, 1, &query);
  glBeginQuery(GL_TIME_ELAPSED, query);
  for (int i = 0; i < kFrames; ++i) run();
  glEndQuery(GL_TIME_ELAPSED);
  GLuint64 elapsed = 0;
  glGetQueryObjectui64v(query, GL_QUERY_RESULT, &elapsed);
  glDeleteQueries(1, &query);
  return 1e-6 * static_cast<double>(elapsed) / kFrames;
}

/// Median times of the passes: levels, evaluate. Timestamps between passes cost a little themselves.
std::pair<double, double> passTimes(ThresholdMapGpu& gpu, const gl::Texture& colour, bool software) {
  gl::PassList passes;
  const auto frame = [&] {
    passes.beginFrame();
    gpu.run(colour, &passes);
    passes.endFrame();
  };
  const int frames = software ? kSoftwareFrames : kFrames;
  frame();
  passes.startRecording(software ? gl::Clock::Wall : gl::Clock::Gpu, frames);
  for (int i = 0; i < frames; ++i) frame();
  std::vector<double> levels, evaluate;
  for (const gl::PassTime& time : passes.finishRecording()) {
    if (time.pass == "threshold_map/levels") levels.push_back(1e-6 * static_cast<double>(time.nanoseconds));
    if (time.pass == "threshold_map/evaluate")
      evaluate.push_back(1e-6 * static_cast<double>(time.nanoseconds));
  }
  return {summarise(std::move(levels)).medianMs, summarise(std::move(evaluate)).medianMs};
}

/// Linear colour with shapes, texture and grain.
Image testImage(glm::ivec2 size) {
  std::mt19937 random(7);
  Image image(size.x, size.y, 4, 1.0F);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const double u = static_cast<double>(x) / size.x, v = static_cast<double>(y) / size.y;
      double value = 0.05 + 0.5 * u;
      if ((x / 37 + y / 53) % 3 == 0) value *= 0.6;
      if (v > 0.5) value *= 1.0 + 0.4 * std::sin(0.21 * x) * std::cos(0.13 * y);
      if (std::hypot(u - 0.7, v - 0.3) < 0.15) value = 0.9;
      value *= 0.95 + 0.1 * static_cast<double>(random() >> 8) * 0x1p-24;
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(value * (1.0 - 0.2 * c * v));
    }
  return image;
}

/// GB/s of a copy of a 4096 x 4096 RGBA32F image by a compute shader, reading and writing counted.
double copyGbS(gl::Context& context) {
  const bool software = context.device().software;
  const glm::ivec2 size(software ? 512 : 4096);
  gl::Texture source(gl::Format::RGBA32F, size), target(gl::Format::RGBA32F, size);
  source.clear(glm::vec4(0.5F));
  const gl::Program& copy = context.programs().compute("perception/threshold_maps/copy.comp.glsl");
  const Times times = measure(
      [&] {
        source.bindTexture(perception::kCopySourceUnit);
        target.bindImage(perception::kCopyImage, gl::Access::Write);
        copy.dispatch(size, {perception::kCopyGroupX, perception::kCopyGroupY});
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
      },
      software);
  return 1e-6 * 2.0 * static_cast<double>(source.bytes()) / times.medianMs;
}

double largestError(const Image& map, const perception::Plane& exact) {
  double largest = 0.0;
  for (size_t i = 0; i < map.data.size(); ++i)
    largest = std::max(largest, std::abs(map.data[i] / exact.data[i] - 1.0));
  return largest;
}

void measureSize(gl::Context& context, glm::ivec2 size, const DisplayProfile& display, double copy,
                 bool oneForm) {
  const bool software = context.device().software;
  const Image image = testImage(size);
  gl::Texture colour(gl::Format::RGBA32F, size);
  colour.write(image);
  const bool checked = int64_t{size.x} * size.y <= kMostCheckedPx;
  for (const bool nineFetch : {false, true})
    for (const bool stack : {false, true})
      for (const auto& [half, finest] : {std::pair(true, perception::FinestStored::Band),
                                         {false, perception::FinestStored::Band},
                                         {false, perception::FinestStored::Luminance}}) {
        if (oneForm && (nineFetch || !stack || half)) continue;
        if (finest == perception::FinestStored::Luminance && (nineFetch || half)) continue;
        ThresholdMapSettings settings;
        if (!stack) settings.decomposition = perception::SampledPyramid{};
        if (nineFetch) settings.downsample = perception::NineFetchKernel{};
        ThresholdMapGpu gpu(context, size, display, settings,
                            {.precision = half ? 16 : 32, .finest = finest});
        const auto run = [&] { gpu.run(colour); };
        const Times times = measure(run, software);
        const double back = software ? times.medianMs : throughputMs(run);
        const auto [levelsMs, evaluateMs] = passTimes(gpu, colour, software);
        const double gbS = 1e-6 * static_cast<double>(gpu.bytesMoved(colour)) / times.medianMs;
        std::string error = "";
        if (checked) {
          const perception::ThresholdMap exact = perception::computeThresholdMap(
              perception::luminancePlane(image, display), display.pixelsPerDegree(), settings);
          error = fmt::format("{:.3g}", largestError(gpu.map().read(), exact.thresholdCdM2));
        }
        fmt::print(
            "{},{},{},{},{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{},{:.2f},{:.1f},{:.1f},{:.3f},{}\n",
            size.x, size.y, nineFetch ? "nine_fetch" : "exact", stack ? "stack" : "pyramid", half ? 16 : 32,
            toText(finest), times.medianMs, times.leastMs, times.p95Ms, levelsMs, evaluateMs, back,
            times.frames, 1e-6 * static_cast<double>(gpu.bytesMoved(colour)), gbS, copy, gbS / copy, error);
        std::fflush(stdout);
      }
}

}  // namespace

namespace {

int measureAll(bool small, glm::ivec2 only) {
  try {
    const auto context = gl::createHeadlessContext();
    const DisplayProfile display = perception::displayPreset("schwarz_2009");
    fmt::print("# {}{}\n# 7 levels; input RGBA32F; {}\n", context->device().line(),
               context->device().software ? " (wall time on a CPU)" : "", display.line());
    const double copy = copyGbS(*context);
    fmt::print(
        "width_px,height_px,downsample,decomposition,precision_bits,finest,median_ms,least_ms,p95_ms,levels_"
        "ms,"
        "evaluate_ms,"
        "back_to_back_ms,"
        "frames,moved_mb,moved_gb_s,copy_gb_s,share_of_copy,largest_relative_error\n");
    std::vector<glm::ivec2> sizes = {{512, 512}, {1024, 768}};
    if (!small)
      for (const glm::ivec2 size :
           {glm::ivec2(1024, 1024), {1600, 1200}, {1920, 1080}, {3840, 2160}, {7680, 4320}})
        sizes.push_back(size);
    if (only.x > 0) sizes = {only};
    for (const glm::ivec2 size : sizes) measureSize(*context, size, display, copy, only.x > 0);
    context->checkDebugMessages();
    return kExitSuccess;
  } catch (const std::exception& error) {
    fmt::print(stderr, "limen-threshold-benchmark: {}\n", error.what());
    return kExitFailedRuns;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("GPU time of threshold maps for all variants and sizes, as CSV.", "limen-threshold-benchmark");
  int exitCode = kExitSuccess;
  bool small = false;
  glm::ivec2 only(0);
  app.add_flag("--small", small, "only the two smallest sizes");
  app.add_option_function<std::string>(
         "SIZE",
         [&](const std::string& text) {
           if (std::sscanf(text.c_str(), "%dx%d", &only.x, &only.y) != 2 || only.x < 1 || only.y < 1)
             throw Error("'" + text + "' is no size", {}, "give WIDTHxHEIGHT: 1920x1080");
         },
         "only this size, WIDTHxHEIGHT in pixels")
      ->excludes("--small");
  app.callback([&] { exitCode = measureAll(small, only); });
  return runProgram(app, argc, argv, exitCode);
}
