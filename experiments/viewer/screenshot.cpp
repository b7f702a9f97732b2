// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/screenshot.h"

#include <chrono>
#include <cstdio>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/printable.h"

namespace limen::viewer {
namespace {

/// Seconds that pass in the interface from one frame to the next, so that a picture does not depend on how
/// fast the machine is.
constexpr double kFrameS = 1.0 / 60.0;

/// Whoever waits is told what for so often.
constexpr std::chrono::seconds kSilence{3};

std::string whatIsAwaited(const ViewerState& state) {
  if (!state.shown || !state.shown->settled) return "rendering " + state.setup.technique.name;
  if (!state.setup.reference) return "timing frames";
  std::string out = "comparing with " + state.setup.reference->name;
  if (state.evaluated && !state.evaluated->step.empty()) out += ", " + state.evaluated->step;
  return out;
}

}  // namespace

void runToRest(window::OffscreenUi& ui, Viewer& viewer, int frames, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto draw = [&] { ui.draw({0.06F, 0.06F, 0.07F}, [&] { viewer.build(kFrameS); }); };
  const auto start = Clock::now(),
             end =
                 start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  auto said = start;
  draw();
  while (!viewer.atRest()) {
    throwIfInterrupted();
    const auto now = Clock::now();
    if (now - said > kSilence) {
      said = now;
      std::fprintf(stderr, "%s: %s (%.0f s)\n", calledName("limen-view").c_str(),
                   printable(whatIsAwaited(viewer.state())).c_str(),
                   std::chrono::duration<double>(now - start).count());
    }
    if (now > end)
      throw Error("the picture is not ready after " + std::to_string(static_cast<int>(seconds)) + " s", {},
                  "choose a cheaper reference or a smaller picture");
    if (viewer.takeResults())
      draw();
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  viewer.takeResults();
  // Table sizes and the like settle after a frame or two.
  for (int i = 0; i < std::max(frames, 3); ++i) draw();
}

void writeScreenshot(window::OffscreenUi& ui, Viewer& viewer, int frames, const std::string& path) {
  runToRest(ui, viewer, frames);
  writePng(path, ui.readBack());
}

}  // namespace limen::viewer
