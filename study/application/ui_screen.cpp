// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/ui_screen.h"

#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "renderer/gl/window_context.h"
#include "study/application/ui_window.h"
#include "study/stimulus/display_coding.h"

namespace limen::study {
namespace {

// Enough swaps for queues of buffers to fill, after which each has to wait for a blank.
constexpr int kProbeSwaps = 12, kProbeWarmUp = 4;

ImU32 grey(float value) { return ImGui::ColorConvertFloat4ToU32({value, value, value, 1.0F}); }

}  // namespace

UiScreen::UiScreen(UiWindow& window, const perception::DisplayProfile& display)
    : window_(window), display_(display) {
  window_.context().makeCurrent();
  glCreateFramebuffers(1, &layerFramebuffer_);
  int64_t first = 0, last = 0;
  for (int i = 0; i < kProbeSwaps; ++i) {
    clear(0.0);
    last = window_.show();
    if (i == kProbeWarmUp) first = last;
  }
  const double meanS = static_cast<double>(last - first) * 1e-9 / (kProbeSwaps - 1 - kProbeWarmUp);
  paced_ = meanS < 0.5 / display_.refreshHz;
}

UiScreen::~UiScreen() {
  window_.context().makeCurrent();
  glDeleteFramebuffers(1, &layerFramebuffer_);
}

float UiScreen::value(double light) const {
  return static_cast<float>(displayCode(display_, light)) / 255.0F;
}

double UiScreen::refreshHz() const { return paced_ ? display_.refreshHz : window_.monitor().refreshHz; }
glm::ivec2 UiScreen::sizePx() const { return window_.sizePx(); }

void UiScreen::clear(double light) {
  const float level = value(light);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glClearColor(level, level, level, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
}

void UiScreen::draw(const Picture& picture, glm::ivec2 topLeftPx, glm::ivec2 pictureSizePx) {
  glNamedFramebufferTextureLayer(layerFramebuffer_, GL_COLOR_ATTACHMENT0, picture.texture, 0, picture.layer);
  // A window's row 0 is its bottom.
  const int top = sizePx().y - topLeftPx.y;
  glBlitNamedFramebuffer(layerFramebuffer_, 0, 0, 0, pictureSizePx.x, pictureSizePx.y, topLeftPx.x, top,
                         topLeftPx.x + pictureSizePx.x, top - pictureSizePx.y, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
}

void UiScreen::fill(glm::ivec2 topLeftPx, glm::ivec2 areaPx, double light) {
  const float level = value(light);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glEnable(GL_SCISSOR_TEST);
  glScissor(topLeftPx.x, sizePx().y - topLeftPx.y - areaPx.y, areaPx.x, areaPx.y);
  glClearColor(level, level, level, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

void UiScreen::ring(glm::dvec2 centrePx, double radiusPx, double widthPx, double light) {
  window_.overlay([&] {
    ImGui::GetBackgroundDrawList()->AddCircle(
        {static_cast<float>(centrePx.x), static_cast<float>(centrePx.y)}, static_cast<float>(radiusPx),
        grey(value(light)), 0, static_cast<float>(widthPx));
  });
}

void UiScreen::arrow(glm::dvec2 tipPx, double lengthPx, double light) {
  window_.overlay([&] {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto x = static_cast<float>(tipPx.x), y = static_cast<float>(tipPx.y);
    const auto length = static_cast<float>(lengthPx), head = 0.35F * length, half = 0.2F * length;
    const float shaft = std::max(0.08F * length, 2.0F);
    list.AddRectFilled({x - shaft / 2, y - length}, {x + shaft / 2, y - head}, grey(value(light)));
    list.AddTriangleFilled({x, y}, {x - half, y - head}, {x + half, y - head}, grey(value(light)));
  });
}

int64_t UiScreen::swap() {
  if (capture_) std::exchange(capture_, {})();
  if (paced_) {
    const auto period = static_cast<int64_t>(std::llround(1e9 / display_.refreshHz));
    const int64_t now = steadyNs();
    // The timer's own blanks: those that passed by meanwhile are missed, as on a display.
    dueNs_ = dueNs_ + period > now ? dueNs_ + period : now + period - (now - dueNs_) % period;
    std::this_thread::sleep_for(std::chrono::nanoseconds(dueNs_ - now));
  }
  return window_.show(paced_ ? 0 : 1);
}

bool UiScreen::lost() const { return window_.contextLost(); }

std::vector<ScreenEvent> UiScreen::poll() {
  if (!goOn_ || goOn_()) return {};
  ScreenEvent event;
  event.kind = ScreenEvent::Kind::Close;
  event.timeNs = steadyNs();
  return {event};
}

}  // namespace limen::study
