// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/window_context.h"

#include <epoxy/gl.h>
// GLFW after epoxy, which brings the GL header.
#include <GLFW/glfw3.h>

#include <algorithm>

#include "experiments/base/error.h"
#include "renderer/gl/fills.h"
#include "renderer/gl/window_library.h"

namespace limen::gl {
namespace {

std::string glfwReason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "unknown reason";
}

GLFWmonitor* monitorNumber(int number) {
  int count = 0;
  GLFWmonitor** all = glfwGetMonitors(&count);
  if (number >= 0 && number < count) return all[number];
  throw Error("no monitor " + std::to_string(number), {},
              count > 0 ? "connected are 0 to " + std::to_string(count - 1) : "connect a display");
}

/// Monitor of a full-screen window, otherwise the one that shows most of the window.
GLFWmonitor* monitorOf(GLFWwindow* window) {
  if (GLFWmonitor* own = glfwGetWindowMonitor(window)) return own;
  glm::ivec2 low, size;
  glfwGetWindowPos(window, &low.x, &low.y);
  glfwGetWindowSize(window, &size.x, &size.y);
  int count = 0;
  GLFWmonitor** all = glfwGetMonitors(&count);
  GLFWmonitor* best = nullptr;
  int largest = -1;
  for (int i = 0; i < count; ++i) {
    const GLFWvidmode* mode = glfwGetVideoMode(all[i]);
    glm::ivec2 at;
    glfwGetMonitorPos(all[i], &at.x, &at.y);
    if (!mode) continue;
    const glm::ivec2 common =
        glm::min(low + size, at + glm::ivec2(mode->width, mode->height)) - glm::max(low, at);
    const int area = std::max(common.x, 0) * std::max(common.y, 0);
    if (area > largest) largest = area, best = all[i];
  }
  return best;
}

}  // namespace

WindowContext::WindowContext(const std::string& title, glm::ivec2 sizePx, bool visible)
    : WindowContext(WindowSetting{title, sizePx, visible, false, 0}) {}

WindowContext::WindowContext(const WindowSetting& setting) {
  startWindowLibrary();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
  // Without it a driver does not report a reset.
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  glfwWindowHint(GLFW_VISIBLE, setting.visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_TRUE);
  glm::ivec2 sizePx = setting.sizePx;
  GLFWmonitor* monitor = nullptr;
  if (setting.fullScreen) {
    monitor = monitorNumber(setting.monitor);
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    // The window uses the current mode: another one would not match the display's profile.
    glfwWindowHint(GLFW_RED_BITS, mode->redBits);
    glfwWindowHint(GLFW_GREEN_BITS, mode->greenBits);
    glfwWindowHint(GLFW_BLUE_BITS, mode->blueBits);
    glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate > 0 ? mode->refreshRate : GLFW_DONT_CARE);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    sizePx = {mode->width, mode->height};
  }
  window_ = glfwCreateWindow(sizePx.x, sizePx.y, setting.title.c_str(), monitor, nullptr);
  const std::string reason = window_ ? "" : glfwReason();
  glfwDefaultWindowHints();
  if (!window_) throw Error("no window with OpenGL 4.5 core: " + reason, {}, "update the graphics driver");
  glfwMakeContextCurrent(window_);
  try {
    initialize("GLFW window");
  } catch (...) {
    glfwDestroyWindow(window_);
    throw;
  }
}

WindowContext::~WindowContext() {
  deleteObjects();
  glfwDestroyWindow(window_);
}

void WindowContext::makeCurrent() {
  glfwMakeContextCurrent(window_);
  Fills::madeCurrent(*this);
}

glm::ivec2 WindowContext::framebufferSizePx() const {
  glm::ivec2 size;
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

glm::vec2 WindowContext::framebufferScale() const {
  glm::ivec2 size;
  glfwGetWindowSize(window_, &size.x, &size.y);
  return glm::vec2(framebufferSizePx()) / glm::vec2(glm::max(size, 1));
}

bool WindowContext::fullScreen() const { return glfwGetWindowMonitor(window_) != nullptr; }

double WindowContext::refreshHz() const {
  GLFWmonitor* monitor = monitorOf(window_);
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  return mode ? static_cast<double>(mode->refreshRate) : 0.0;
}

bool WindowContext::contextLost() const { return glGetGraphicsResetStatus() != GL_NO_ERROR; }

bool WindowContext::hidden() const {
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) || !glfwGetWindowAttrib(window_, GLFW_VISIBLE) ||
         glfwWindowShouldClose(window_);
}

void WindowContext::swap(int interval) {
  // Set once: with some drivers every call takes time.
  if (interval != interval_) glfwSwapInterval(interval_ = interval);
  glfwSwapBuffers(window_);
}

}  // namespace limen::gl
