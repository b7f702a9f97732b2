// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/ui_screen.h"

#include <chrono>
#include <cmath>
#include <thread>

#include "renderer/window/ui_window.h"

namespace limen::study {
namespace {

// Enough swaps for buffer queues to fill, after which each has to wait for a blank.
constexpr int kProbeSwaps = 12, kProbeWarmUp = 4;

}  // namespace

UiScreen::UiScreen(window::UiWindow& window, const perception::DisplayProfile& display)
    : GlScreen(window.context(), display, false), window_(window), paceHz_(display.refreshHz) {
  int64_t first = 0, last = 0;
  for (int i = 0; i < kProbeSwaps; ++i) {
    clear(0.0);
    last = window_.show();
    if (i == kProbeWarmUp) first = last;
  }
  const double meanS = static_cast<double>(last - first) * 1e-9 / (kProbeSwaps - 1 - kProbeWarmUp);
  paced_ = meanS < 0.5 / paceHz_;
}

int64_t UiScreen::swap() {
  if (capture_) std::exchange(capture_, {})();
  if (paced_) {
    const auto period = static_cast<int64_t>(std::llround(1e9 / paceHz_));
    const int64_t now = window::steadyNs();
    // The timer's own blanks: those that have passed meanwhile are missed, as on a display.
    dueNs_ = dueNs_ + period > now ? dueNs_ + period : now + period - (now - dueNs_) % period;
    std::this_thread::sleep_for(std::chrono::nanoseconds(dueNs_ - now));
  }
  return window_.show(paced_ ? 0 : 1);
}

bool UiScreen::lost() const { return window_.contextLost() || GlScreen::lost(); }

std::vector<ScreenEvent> UiScreen::poll() {
  if (!goOn_ || goOn_()) return {};
  ScreenEvent event;
  event.kind = ScreenEvent::Kind::Close;
  event.timeNs = window::steadyNs();
  return {event};
}

}  // namespace limen::study
