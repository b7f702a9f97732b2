// SPDX-License-Identifier: BSD-3-Clause
// limen-flip-benchmark: GPU time of FLIP for a pair of 1920 x 1080 images.
#include <epoxy/gl.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <random>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/program.h"
#include "perception/metrics/flip/flip_gpu.h"

namespace {

using limen::perception::FlipGpu;
using HostClock = std::chrono::steady_clock;

constexpr glm::ivec2 kSizePx{1920, 1080};
constexpr int kIterations = 200;
constexpr double kWarmUpS = 0.5;  ///< an idle GPU takes up to a third of a second to raise its clock

limen::Image noise(unsigned seed) {
  std::mt19937 random(seed);
  limen::Image image(kSizePx.x, kSizePx.y, 4);
  for (float& value : image.data) value = static_cast<float>(random() >> 8) * 0x1p-24F;
  return image;
}

double seconds(HostClock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// Sorted times of single runs, ms. A software renderer's timer queries are wrong: it is timed by the host's
/// clock.
std::vector<double> measure(FlipGpu& flip, const limen::gl::Texture& test,
                            const limen::gl::Texture& reference, bool software) {
  const auto start = HostClock::now();
  do {
    flip.run(test, reference);
    glFinish();
  } while (seconds(HostClock::now() - start) < kWarmUpS);

  std::vector<double> times;
  if (software) {
    for (int i = 0; i < 5; ++i) {
      const auto begin = HostClock::now();
      flip.run(test, reference);
      glFinish();
      times.push_back(1e3 * seconds(HostClock::now() - begin));
    }
  } else {
    std::vector<GLuint> queries(2 * kIterations);
    glCreateQueries(GL_TIMESTAMP, static_cast<GLsizei>(queries.size()), queries.data());
    for (size_t i = 0; i < queries.size(); i += 2) {
      glQueryCounter(queries[i], GL_TIMESTAMP);
      flip.run(test, reference);
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

}  // namespace

namespace {

int measureFlip() {
  try {
    const auto context = limen::gl::createHeadlessContext();
    const limen::gl::DeviceInfo& device = context->device();
    limen::gl::Texture test(limen::gl::Format::RGBA32F, kSizePx),
        reference(limen::gl::Format::RGBA32F, kSizePx);
    test.write(noise(1));
    reference.write(noise(2));
    FlipGpu flip(*context, kSizePx);
    const std::vector<double> ms = measure(flip, test, reference, device.software);
    fmt::print(
        "{}\nFLIP {} x {}, RGBA32F: {:.4f} ms median, {:.4f} least, {:.4f} p95, {} runs{}\nmean {:.6f}, "
        "{:.1f} MiB held\n",
        device.line(), kSizePx.x, kSizePx.y, ms[ms.size() / 2], ms.front(), ms[ms.size() * 95 / 100],
        ms.size(), device.software ? " (wall time on a CPU)" : "", flip.mean(),
        static_cast<double>(flip.bytesHeld()) / 1048576.0);
    context->checkDebugMessages();
    return limen::kExitSuccess;
  } catch (const std::exception& error) {
    fmt::print(stderr, "limen-flip-benchmark: {}\n", error.what());
    return limen::kExitFailedRuns;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("GPU time of FLIP for a pair of 1920 x 1080 images.", "limen-flip-benchmark");
  int exitCode = limen::kExitSuccess;
  app.callback([&] { exitCode = measureFlip(); });
  return limen::runProgram(app, argc, argv, exitCode);
}
