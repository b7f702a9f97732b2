// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "study/presentation/gl_screen.h"

namespace limen::window {
class UiWindow;
}

namespace limen::study {

/// A window with an interface as the presenter's screen. If buffer swaps do not wait for the display (virtual
/// displays, drivers configured not to), a timer paces them at the profile's rate, and pacedByTimer() is
/// true.
class UiScreen : public GlScreen {
 public:
  /// Measures for a few frames whether swaps wait.
  UiScreen(window::UiWindow& window, const perception::DisplayProfile& display);

  bool pacedByTimer() const { return paced_; }
  /// Called between frames; when it returns false, poll() gives one ScreenEvent::Close.
  void setWatch(std::function<bool()> goOn) { goOn_ = std::move(goOn); }
  /// Called at the next swap, before it.
  void captureNext(std::function<void()> capture) { capture_ = std::move(capture); }

  double refreshHz() const override { return paced_ ? paceHz_ : GlScreen::refreshHz(); }
  int64_t swap() override;
  bool lost() const override;
  std::vector<ScreenEvent> poll() override;

 private:
  window::UiWindow& window_;
  double paceHz_;
  std::function<bool()> goOn_;
  std::function<void()> capture_;
  bool paced_ = false;
  int64_t dueNs_ = 0;
};

}  // namespace limen::study
