// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "perception/vision/display.h"
#include "study/presentation/screen_device.h"

namespace limen::study {

class UiWindow;

/// A window as the presenter's screen. Where buffer swaps do not wait for the display (virtual displays,
/// drivers told not to), a timer paces them at the profile's rate, and pacedByTimer() says so.
class UiScreen : public ScreenDevice {
 public:
  /// Measures for a few frames whether swaps wait.
  UiScreen(UiWindow& window, const perception::DisplayProfile& display);
  ~UiScreen() override;
  UiScreen(const UiScreen&) = delete;
  UiScreen& operator=(const UiScreen&) = delete;

  bool pacedByTimer() const { return paced_; }
  /// Asked between frames; as it says no, poll() gives one ScreenEvent::Close.
  void setWatch(std::function<bool()> goOn) { goOn_ = std::move(goOn); }
  /// Called at the next swap, before it.
  void captureNext(std::function<void()> capture) { capture_ = std::move(capture); }

  double refreshHz() const override;
  glm::ivec2 sizePx() const override;
  void clear(double light) override;
  void draw(const Picture& picture, glm::ivec2 topLeftPx, glm::ivec2 sizePx) override;
  void fill(glm::ivec2 topLeftPx, glm::ivec2 sizePx, double light) override;
  void ring(glm::dvec2 centrePx, double radiusPx, double widthPx, double light) override;
  void arrow(glm::dvec2 tipPx, double lengthPx, double light) override;
  int64_t swap() override;
  bool lost() const override;
  std::vector<ScreenEvent> poll() override;

 private:
  float value(double light) const;
  UiWindow& window_;
  perception::DisplayProfile display_;
  std::function<bool()> goOn_;
  std::function<void()> capture_;
  uint32_t layerFramebuffer_ = 0;
  bool paced_ = false;
  int64_t dueNs_ = 0;
};

}  // namespace limen::study
