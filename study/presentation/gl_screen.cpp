// SPDX-License-Identifier: BSD-3-Clause
#include "study/presentation/gl_screen.h"

#include <epoxy/gl.h>
// GLFW after epoxy, which brings the GL header.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "renderer/gl/window_system.h"
#include "study/presentation/screen_bindings.h"
#include "study/stimulus/display_coding.h"

namespace limen::study {
namespace {

enum Shape { kPicture, kFilled, kRing, kArrow };

int64_t nowNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string keyName(int key, int scancode) {
  switch (key) {
    case GLFW_KEY_SPACE:
      return "space";
    case GLFW_KEY_ESCAPE:
      return "escape";
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return "enter";
    case GLFW_KEY_LEFT:
      return "left";
    case GLFW_KEY_RIGHT:
      return "right";
    case GLFW_KEY_UP:
      return "up";
    case GLFW_KEY_DOWN:
      return "down";
    default: {
      const char* name = glfwGetKeyName(key, scancode);
      return name ? name : "";
    }
  }
}

std::vector<ScreenEvent>& queueOf(GLFWwindow* window) {
  return *static_cast<std::vector<ScreenEvent>*>(glfwGetWindowUserPointer(window));
}

void onKey(GLFWwindow* window, int key, int scancode, int action, int) {
  // Held keys repeat while a value is set; an answer ends with its first press.
  if (action != GLFW_RELEASE)
    queueOf(window).push_back({ScreenEvent::Kind::Key, keyName(key, scancode), {}, nowNs()});
}

void onButton(GLFWwindow* window, int button, int action, int) {
  if (action != GLFW_PRESS || button > GLFW_MOUSE_BUTTON_MIDDLE) return;
  static const char* const kNames[] = {"left", "right", "middle"};
  glm::dvec2 at;
  glfwGetCursorPos(window, &at.x, &at.y);
  queueOf(window).push_back({ScreenEvent::Kind::Mouse, kNames[button], at, nowNs()});
}

// Another window may have been opened since this one.
const gl::Program& screenProgram(gl::WindowContext& context) {
  context.makeCurrent();
  return context.programs().get(
      {"study/presentation/screen.vert.glsl", "study/presentation/screen.frag.glsl"});
}

}  // namespace

GlScreen::GlScreen(gl::WindowContext& context, const perception::DisplayProfile& display, bool listens)
    : context_(context),
      sizePx_(context.framebufferSizePx()),
      program_(screenProgram(context)),
      listens_(listens) {
  const CodeThresholds thresholds = codeThresholds(display);
  thresholds_.assign(thresholds.begin(), thresholds.end());
  glCreateVertexArrays(1, &vertexArray_);
  if (!listens_) return;
  glfwSetWindowUserPointer(context_.window(), &events_);
  glfwSetKeyCallback(context_.window(), &onKey);
  glfwSetMouseButtonCallback(context_.window(), &onButton);
}

GlScreen::~GlScreen() {
  context_.makeCurrent();
  glDeleteVertexArrays(1, &vertexArray_);
  if (!listens_) return;
  glfwSetKeyCallback(context_.window(), nullptr);
  glfwSetMouseButtonCallback(context_.window(), nullptr);
  glfwSetWindowUserPointer(context_.window(), nullptr);
}

float GlScreen::value(double light) const {
  const auto code = std::upper_bound(thresholds_.begin(), thresholds_.end(), static_cast<float>(light));
  return static_cast<float>(code - thresholds_.begin()) / 255.0F;
}

void GlScreen::clear(double light) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  // Values are already coded, and every pixel is shown as is.
  for (const GLenum feature :
       {GL_FRAMEBUFFER_SRGB, GL_DITHER, GL_BLEND, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_CULL_FACE})
    glDisable(feature);
  glViewport(0, 0, sizePx_.x, sizePx_.y);
  const float grey = value(light);
  const float colour[4] = {grey, grey, grey, 1.0F};
  glClearBufferfv(GL_COLOR, 0, colour);
}

void GlScreen::shape(int kind, glm::ivec2 topLeftPx, glm::ivec2 sizePx, double light) {
  if (sizePx.x <= 0 || sizePx.y <= 0) return;
  const glm::ivec2 low(topLeftPx.x, sizePx_.y - topLeftPx.y - sizePx.y);
  program_.use();
  program_.set("shape", kind);
  program_.set("lowPx", low);
  program_.set("sizePx", sizePx);
  program_.set("value", value(light));
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glBindVertexArray(vertexArray_);
  glViewport(low.x, low.y, sizePx.x, sizePx.y);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void GlScreen::draw(const Picture& picture, glm::ivec2 topLeftPx, glm::ivec2 sizePx) {
  glBindTextureUnit(kScreenPicturesUnit, picture.texture);
  program_.set("layer", picture.layer);
  shape(kPicture, topLeftPx, sizePx, 0.0);
}

void GlScreen::fill(glm::ivec2 topLeftPx, glm::ivec2 sizePx, double light) {
  shape(kFilled, topLeftPx, sizePx, light);
}

void GlScreen::ring(glm::dvec2 centrePx, double radiusPx, double widthPx, double light) {
  const auto half = static_cast<int>(std::ceil(radiusPx + widthPx));
  program_.set("ringPx", glm::vec2(radiusPx, widthPx));
  shape(kRing, glm::ivec2(glm::round(centrePx)) - half, glm::ivec2(2 * half), light);
}

void GlScreen::arrow(glm::dvec2 tipPx, double lengthPx, double light) {
  const glm::ivec2 size(static_cast<int>(std::lround(0.5 * lengthPx)),
                        static_cast<int>(std::lround(lengthPx)));
  shape(kArrow, glm::ivec2(glm::round(tipPx)) - glm::ivec2(size.x / 2, size.y), size, light);
}

int64_t GlScreen::swap() {
  context_.swap(1);
  // The call may return with the swap still queued, and with drivers that have several back buffers
  // glFinish() does not wait for it. A pixel drawn into the next back buffer cannot be finished before there
  // is one.
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 1, 1);
  const float black[4] = {0.0F, 0.0F, 0.0F, 1.0F};
  glClearBufferfv(GL_COLOR, 0, black);
  glDisable(GL_SCISSOR_TEST);
  glFinish();
  return nowNs();
}

bool GlScreen::lost() const {
  return context_.hidden() || context_.contextLost() || context_.framebufferSizePx() != sizePx_;
}

std::vector<ScreenEvent> GlScreen::poll() {
  glfwPollEvents();
  std::vector<ScreenEvent> out = std::exchange(events_, {});
  const glm::dvec2 scale(context_.framebufferScale());
  for (ScreenEvent& event : out) event.atPx *= scale;
  if (glfwWindowShouldClose(context_.window())) out.push_back({ScreenEvent::Kind::Close, {}, {}, nowNs()});
  return out;
}

std::vector<std::string> objectionsTo(const gl::WindowContext& context) {
  std::vector<std::string> out;
  if (context.device().software) out.push_back("a software renderer draws: " + context.device().renderer);
  if (!(context.refreshHz() > 0.0))
    out.push_back("the system reports no refresh rate: this may not be a real display");
  if (!context.fullScreen()) out.push_back("the window is not full screen");
  const gl::WindowSystem system = gl::windowSystem();
  if (system.compositor)
    out.push_back("a compositor of " + system.name + " controls the screen and decides when frames are seen");
  return out;
}

}  // namespace limen::study
