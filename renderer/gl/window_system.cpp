// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/window_system.h"

#include <GLFW/glfw3.h>
#include <X11/Xlib.h>

#include <cstdlib>
#include <memory>

#include "experiments/base/error.h"
#include "renderer/gl/window_library.h"

namespace limen::gl {
namespace {

bool isSet(const char* name) {
  const char* value = std::getenv(name);
  return value && *value;
}

/// A compositing manager owns the selection _NET_WM_CM_Sn of its screen (Extended Window Manager Hints).
bool hasCompositingManager() {
  const std::unique_ptr<Display, int (*)(Display*)> display(XOpenDisplay(nullptr), &XCloseDisplay);
  if (!display) return false;
  const std::string selection = "_NET_WM_CM_S" + std::to_string(DefaultScreen(display.get()));
  return XGetSelectionOwner(display.get(), XInternAtom(display.get(), selection.c_str(), False)) != None;
}

}  // namespace

void startWindowLibrary() {
  if (glfwInit()) return;
  const char* reason = nullptr;
  glfwGetError(&reason);
  throw Error(std::string("no window system: ") + (reason ? reason : "unknown reason"), {},
              "start this from a desktop session (X11 or Wayland)");
}

std::vector<Monitor> monitors() {
  startWindowLibrary();
  std::vector<Monitor> out;
  int count = 0;
  GLFWmonitor** all = glfwGetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    const GLFWvidmode* mode = glfwGetVideoMode(all[i]);
    if (!mode) continue;
    const char* name = glfwGetMonitorName(all[i]);
    Monitor monitor{
        name ? name : "", {mode->width, mode->height}, {}, static_cast<double>(mode->refreshRate)};
    glfwGetMonitorPhysicalSize(all[i], &monitor.sizeMm.x, &monitor.sizeMm.y);
    out.push_back(monitor);
  }
  return out;
}

WindowSystem windowSystem() {
  startWindowLibrary();
  // An X11 program on a Wayland desktop is composited like any other.
  if (isSet("WAYLAND_DISPLAY")) return {isSet("DISPLAY") ? "X11 on Wayland" : "Wayland", true};
  return {"X11", hasCompositingManager()};
}

}  // namespace limen::gl
