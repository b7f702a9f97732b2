// SPDX-License-Identifier: BSD-3-Clause
// limen-popping-benchmark: GPU times of the popping predictor by pass, the reference's time on the CPU, and
// the agreement of the two, as CSV on standard output. Arguments: none, or "quick" for one small size.
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
#include "perception/popping/popping_gpu.h"

namespace {

using namespace limen;
using namespace limen::perception;
using HostClock = std::chrono::steady_clock;

constexpr double kWarmUpS = 0.5;  ///< an idle GPU takes up to a third of a second to raise its clock

double seconds(HostClock::duration duration) { return std::chrono::duration<double>(duration).count(); }

float randomValue(std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24F; }

/// Textured ground with discs whose edges have moved by a pixel: a few large and many small regions.
Image scene(glm::ivec2 size, double shiftPx) {
  std::mt19937 random(1);
  Image image(size.x, size.y, 3);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const double inDisc = std::hypot(std::fmod(x + shiftPx, 240.0) - 120.0, y % 240 - 120.0);
      const float texture = 0.06F * randomValue(random);
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) =
            texture + (inDisc < 70.0 ? 0.2F * static_cast<float>(c + 1)
                                     : 0.4F + 0.2F * static_cast<float>(std::sin(0.02 * x + c)));
    }
  return image;
}

Image noise(glm::ivec2 size, int channels, unsigned seed, float low, float high) {
  std::mt19937 random(seed);
  Image image(size.x, size.y, channels);
  for (float& value : image.data) value = low + (high - low) * randomValue(random);
  return image;
}

gl::Texture upload(const Image& image) {
  const int channels = image.channels == 3 ? 4 : image.channels;
  Image padded(image.width, image.height, channels, 1.0F);
  for (size_t p = 0; p < image.pixels(); ++p)
    std::copy_n(&image.data[p * static_cast<size_t>(image.channels)], image.channels,
                &padded.data[p * static_cast<size_t>(channels)]);
  gl::Texture texture(channels == 4   ? gl::Format::RGBA32F
                      : channels == 2 ? gl::Format::RG32F
                                      : gl::Format::R32F,
                      {image.width, image.height});
  texture.write(padded);
  return texture;
}

void printRow(glm::ivec2 size, const std::string& content, const std::string& what, double value, double low,
              double high, const char* unit, size_t count) {
  fmt::print("{},{},{},{},{:.6g},{:.6g},{:.6g},{},{}\n", size.x, size.y, content, what, value, low, high,
             unit, count);
}

/// What of the model is timed, beside its default for lasting pictures.
struct Variant {
  const char* name;
  PoppingSettings settings;
  bool isSwitch = false;
};

std::vector<Variant> variants() {
  std::vector<Variant> out = {{"", {}}, {" switched", {}, true}};
  PoppingSettings settings;
  settings.neighbourhood = ExtendedMasking{};
  out.push_back({" masked by neighbours", settings});
  out.push_back({" masked by neighbours switched", settings, true});
  settings = {};
  settings.bands.weights = FittedWeights{};
  out.push_back({" fitted", settings});
  out.push_back({" fitted switched", settings, true});
  return out;
}

void measure(gl::Context& context, glm::ivec2 size, const std::string& content, const PoppingInput& in,
             const PoppingSettings& settings, bool compare) {
  const gl::Texture actual = upload(in.actual), predicted = upload(in.predicted),
                    moved = upload(in.actualDisplacement), weight = upload(in.disocclusion);
  PoppingGpuInput input;
  input.actual = &actual, input.predicted = &predicted, input.actualDisplacement = &moved;
  input.disocclusion = &weight;
  const DisplayProfile display = displayPreset("schwarz_2009");
  PoppingPredictorGpu predictor(context, size, display, settings, in.isSwitch);
  const bool software = context.device().software;

  gl::PassList passes;
  const auto frame = [&](bool stages) {
    passes.beginFrame();
    predictor.run(input, stages ? &passes : nullptr);
    passes.endFrame();
  };
  frame(true);
  const auto start = HostClock::now();
  do {
    frame(false);
    glFinish();
  } while (seconds(HostClock::now() - start) < kWarmUpS);
  // Once without timestamps between the passes, which keep kernels from overlapping, and once with them.
  for (const bool stages : {false, true}) {
    const int frames = software ? 3 : 200;
    passes.startRecording(software ? gl::Clock::Wall : gl::Clock::Gpu, frames);
    for (int i = 0; i < frames; ++i) frame(stages);
    std::map<std::string, std::vector<double>> times;
    for (const gl::PassTime& time : passes.finishRecording())
      times[time.pass].push_back(1e-6 * static_cast<double>(time.nanoseconds));
    for (auto& [pass, ms] : times) {
      std::sort(ms.begin(), ms.end());
      const std::string name = pass == "frame" ? (stages ? "frame with timestamps" : "frame") : pass;
      printRow(size, content, name, ms[ms.size() / 2], ms.front(), ms[ms.size() * 95 / 100], "ms", ms.size());
    }
  }
  printRow(size, content, "memory", static_cast<double>(predictor.bytesHeld()) / 1048576.0, 0, 0, "MiB", 1);
  if (!compare) return;

  const auto begin = HostClock::now();
  const PoppingResult reference = predictPopping(in, display, settings);
  printRow(size, content, "reference on the CPU", 1e3 * seconds(HostClock::now() - begin), 0, 0, "ms", 1);
  const Image jnd = predictor.jnd().read();
  const RegionMap regions = predictor.readRegions();
  double worst = 0.0;
  size_t compared = 0, otherLabel = 0, atThreshold = 0;
  for (size_t p = 0; p < jnd.data.size(); ++p) {
    const double exact = reference.jndExact[p];
    if (exact >= 0.1) {
      ++compared;
      worst = std::max(worst, std::abs(jnd.data[p] - exact) / exact);
    }
    if ((regions.labels[p] != 0) != (reference.regions.labels[p] != 0)) ++otherLabel;
    if (std::abs(exact - 2.0) < 2e-3) ++atThreshold;
  }
  printRow(size, content, "largest relative error from 0.1 JND on", worst, 0, 0, "1", compared);
  printRow(size, content, "pixels in a region on one side only", static_cast<double>(otherLabel), 0, 0, "px",
           jnd.data.size());
  printRow(size, content, "pixels within 0.001 of the threshold", static_cast<double>(atThreshold), 0, 0,
           "px", jnd.data.size());
  printRow(size, content, "regions", static_cast<double>(regions.regions.size()),
           static_cast<double>(reference.regions.regions.size()), 0, "1", 1);
}

PoppingInput makeInput(glm::ivec2 size, bool isScene) {
  PoppingInput in;
  in.linear = true;
  in.actual = isScene ? scene(size, 0.0) : noise(size, 3, 1, 0.0F, 1.0F);
  in.predicted = isScene ? scene(size, 1.0) : noise(size, 3, 2, 0.0F, 1.0F);
  in.actualDisplacement = noise(size, 2, 3, 0.0F, 4.0F);
  in.disocclusion = noise(size, 1, 4, 0.5F, 1.0F);
  return in;
}

}  // namespace

namespace {

int measureAll(bool quick) {
  try {
    const auto context = gl::createHeadlessContext();
    fmt::print("# {}{}\nwidth,height,content,what,value,least,p95,unit,count\n", context->device().line(),
               context->device().software ? " (wall time on a CPU)" : "");
    const std::vector<glm::ivec2> sizes =
        quick ? std::vector<glm::ivec2>{{480, 270}}
              : std::vector<glm::ivec2>{{1024, 768}, {1920, 1080}, {3840, 2160}};
    for (const glm::ivec2 size : sizes)
      for (const bool isScene : {true, false})
        for (const Variant& variant : variants()) {
          PoppingInput input = makeInput(size, isScene);
          input.isSwitch = variant.isSwitch;
          measure(*context, size, std::string(isScene ? "scene" : "noise") + variant.name, input,
                  variant.settings, size.x <= 1920);
        }
    context->checkDebugMessages();
    return kExitSuccess;
  } catch (const std::exception& error) {
    fmt::print(stderr, "limen-popping-benchmark: {}\n", error.what());
    return kExitFailedRuns;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("GPU time of the popping predictor at several image sizes, and its error, as CSV.",
               "limen-popping-benchmark");
  int exitCode = kExitSuccess;
  std::string what;
  app.add_option("quick", what, "only a small size, to see that it works")->check(CLI::IsMember({"quick"}));
  app.callback([&] { exitCode = measureAll(what == "quick"); });
  return runProgram(app, argc, argv, exitCode);
}
