// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/window_context.h"

#include <epoxy/gl.h>
// GLFW after epoxy, which brings the GL header.
#include <GLFW/glfw3.h>

#include "base/error.h"

namespace limen::gl {
namespace {

std::string glfwReason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "unknown reason";
}

}  // namespace

WindowContext::WindowContext(const std::string& title, glm::ivec2 sizePx, bool visible) {
  if (!glfwInit())
    throw Error("no window system: " + glfwReason(), {},
                "start this from a desktop session (X11 or Wayland)");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_TRUE);
  window_ = glfwCreateWindow(sizePx.x, sizePx.y, title.c_str(), nullptr, nullptr);
  if (!window_)
    throw Error("no window with OpenGL 4.5 core: " + glfwReason(), {}, "update the graphics driver");
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

void WindowContext::makeCurrent() { glfwMakeContextCurrent(window_); }

glm::ivec2 WindowContext::framebufferSizePx() const {
  glm::ivec2 size;
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

void WindowContext::swap(int interval) {
  glfwSwapInterval(interval);
  glfwSwapBuffers(window_);
}

}  // namespace limen::gl
