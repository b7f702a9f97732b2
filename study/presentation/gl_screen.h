// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "perception/vision/display.h"
#include "renderer/gl/window_context.h"
#include "study/presentation/screen_device.h"

namespace limen::study {

/// A window's framebuffer as a screen: double-buffered, swapped with the vertical blank, waiting for the
/// driver to complete each swap.
class GlScreen : public ScreenDevice {
 public:
  /// `display`: whose transfer curve codes greys. With `listens` keys and buttons of the window become
  /// events; otherwise the window's callbacks are left to others and only its closing is noticed.
  GlScreen(gl::WindowContext& context, const perception::DisplayProfile& display, bool listens = true);
  ~GlScreen() override;
  GlScreen(const GlScreen&) = delete;
  GlScreen& operator=(const GlScreen&) = delete;

  double refreshHz() const override { return context_.refreshHz(); }
  glm::ivec2 sizePx() const override { return sizePx_; }
  void clear(double light) override;
  void draw(const Picture& picture, glm::ivec2 topLeftPx, glm::ivec2 sizePx) override;
  void fill(glm::ivec2 topLeftPx, glm::ivec2 sizePx, double light) override;
  void ring(glm::dvec2 centrePx, double radiusPx, double widthPx, double light) override;
  void arrow(glm::dvec2 tipPx, double lengthPx, double light) override;
  int64_t swap() override;
  bool lost() const override;
  std::vector<ScreenEvent> poll() override;

 private:
  void shape(int kind, glm::ivec2 topLeftPx, glm::ivec2 sizePx, double light);
  float value(double light) const;

  gl::WindowContext& context_;
  glm::ivec2 sizePx_;
  const gl::Program& program_;
  std::vector<float> thresholds_;
  uint32_t vertexArray_ = 0;
  bool listens_;
  std::vector<ScreenEvent> events_;
};

/// Why frame times of a window are not fit for a lab, one line each: a software renderer, a compositor, not
/// full screen, no reported refresh rate. Empty if there are no objections.
std::vector<std::string> objectionsTo(const gl::WindowContext& context);

}  // namespace limen::study
