// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/screenshot.h"

#include <chrono>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"

namespace limen::viewer {
namespace {

/// Seconds that pass in the interface from one frame to the next, so that a picture does not depend on how
/// fast the machine is.
constexpr double kFrameS = 1.0 / 60.0;

}  // namespace

void runToRest(window::OffscreenUi& ui, Viewer& viewer, int frames, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto draw = [&] { ui.draw({0.06F, 0.06F, 0.07F}, [&] { viewer.build(kFrameS); }); };
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  draw();
  while (!viewer.atRest()) {
    throwIfInterrupted();
    if (Clock::now() > end)
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
