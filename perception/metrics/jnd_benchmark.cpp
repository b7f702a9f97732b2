// SPDX-License-Identifier: BSD-3-Clause
// limen-jnd-benchmark: GPU times of the metrics jnd and jnd_change, from the products to their figures, as
// CSV on standard output. Arguments: none, or "quick" for one small size.
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
#include "perception/metrics/jnd/jnd_gpu.h"
#include "perception/metrics/metric_texture.h"

namespace {

using namespace limen;
using namespace limen::perception;
using HostClock = std::chrono::steady_clock;

constexpr int kIterations = 200;
constexpr double kWarmUpS = 0.5;  ///< an idle GPU takes up to a third of a second to raise its clock

double seconds(HostClock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// Soft edges of many shadows, moved by a part of a pixel and in levels: a product with errors everywhere.
Image visibility(glm::ivec2 size, double shiftPx, double levels) {
  Image image(size.x, size.y, 1);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const double value = 0.5 + 0.7 * std::sin(0.05 * (x + shiftPx)) * std::cos(0.04 * y);
      image.at(x, y) = static_cast<float>(std::floor(std::clamp(value, 0.0, 1.0) * levels + 0.5) / levels);
    }
  return image;
}

Image noise(glm::ivec2 size, int channels, float low, float high) {
  std::mt19937 random(1);
  Image image(size.x, size.y, channels);
  for (float& value : image.data) value = low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24F;
  return image;
}

/// Sorted times of single runs, ms. A software renderer's timer queries are wrong: it is timed by the host's
/// clock.
std::vector<double> measure(const std::function<void()>& run, bool software) {
  const auto start = HostClock::now();
  do {
    run();
    glFinish();
  } while (seconds(HostClock::now() - start) < kWarmUpS);
  std::vector<double> times;
  if (software) {
    for (int i = 0; i < 5; ++i) {
      const auto begin = HostClock::now();
      run();
      glFinish();
      times.push_back(1e3 * seconds(HostClock::now() - begin));
    }
  } else {
    std::vector<GLuint> queries(2 * kIterations);
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
      times.push_back(1e-6 * static_cast<double>(end - begin));
    }
    glDeleteQueries(static_cast<GLsizei>(queries.size()), queries.data());
  }
  std::sort(times.begin(), times.end());
  return times;
}

void print(glm::ivec2 size, const std::string& what, const std::vector<double>& ms) {
  fmt::print("{},{},{},{:.6g},{:.6g},{:.6g},ms,{}\n", size.x, size.y, what, ms[ms.size() / 2], ms.front(),
             ms[ms.size() * 95 / 100], ms.size());
}

void measureSize(gl::Context& context, glm::ivec2 size) {
  const bool software = context.device().software;
  const gl::Texture test = metricTexture(visibility(size, 0.3, 16.0)),
                    later = metricTexture(visibility(size, 1.3, 16.0)),
                    reference = metricTexture(visibility(size, 0.0, 1e6)),
                    albedo = metricTexture(noise(size, 4, 0.2F, 0.9F)),
                    direct = metricTexture(noise(size, 4, 0.1F, 0.7F)),
                    depth = metricTexture(Image(size.x, size.y, 1, 1.0F));
  gl::Texture moved(gl::Format::RG32F, size);
  moved.write(noise(size, 2, 0.5F, 1.5F));
  PathFrame before{&test, &reference, nullptr, {&albedo, &direct}, &moved, &depth, &depth};
  PathFrame now = before;
  now.test = &later;
  JndGpu jnd(context, size, JndSettings{});
  print(size, "jnd", measure([&] { jnd.run(before, Depicts::ShareOfLight); }, software));
  JndFigures figures = jnd.figures();
  fmt::print("{},{},jnd_p95,{:.6g},,,JND,1\n", size.x, size.y, figures.p95Jnd);
  print(size, "jnd_change step", measure([&] { jnd.runStep(before, now, Depicts::ShareOfLight); }, software));
  figures = jnd.figures();
  fmt::print("{},{},jnd_change_p95,{:.6g},,,JND,1\n", size.x, size.y, figures.p95Jnd);
  fmt::print("{},{},memory,{},,,byte,1\n", size.x, size.y, jnd.bytesHeld());
}

int measureAll(bool quick) {
  try {
    const auto context = gl::createHeadlessContext();
    fmt::print("# {}{}\nwidth,height,what,value,least,p95,unit,count\n", context->device().line(),
               context->device().software ? " (wall time on a CPU)" : "");
    const std::vector<glm::ivec2> sizes =
        quick ? std::vector<glm::ivec2>{{320, 240}}
              : std::vector<glm::ivec2>{{1024, 768}, {1920, 1080}, {3840, 2160}};
    for (const glm::ivec2 size : sizes) measureSize(*context, size);
    context->checkDebugMessages();
    return kExitSuccess;
  } catch (const std::exception& error) {
    fmt::print(stderr, "limen-jnd-benchmark: {}\n", error.what());
    return kExitFailedRuns;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("GPU times of the metrics jnd and jnd_change, as CSV.", "limen-jnd-benchmark");
  std::string size;
  app.add_option("SIZE", size, "quick: one small size")->check(CLI::IsMember({"quick"}));
  int exitCode = kExitSuccess;
  app.callback([&] { exitCode = measureAll(size == "quick"); });
  return runProgram(app, argc, argv, exitCode);
}
