// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/window/ui_window.h"

#include <epoxy/gl.h>
// GLFW after epoxy, which brings the GL header.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

#include "experiments/base/error.h"
#include "renderer/gl/window_context.h"
#include "renderer/window/ui_input.h"

namespace limen::window {

int64_t steadyNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

const char* toText(Device device) {
  return device == Device::Keyboard ? "keyboard" : device == Device::Mouse ? "mouse" : "gamepad";
}

namespace {

// How often a gamepad is polled: this is the resolution of its time stamps.
constexpr double kGamepadPollS = 0.004;

std::atomic<bool> wakeAsked = false;

GLFWmonitor* chooseMonitor(int index) {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  if (index < 0 || index >= count)
    throw Error("there is no monitor " + std::to_string(index), "--monitor",
                count == 0 ? "none is connected" : "connected are 0 to " + std::to_string(count - 1));
  return monitors[index];
}

}  // namespace

struct UiWindow::State {
  std::unique_ptr<gl::WindowContext> context;
  ImGuiContext* imgui = nullptr;  // the surface's
  float scale = 1.0F;
  int64_t events = 0, eventsSeen = 0;  // of any kind
  GLFWmonitor* monitor = nullptr;
  UiMonitor monitorFacts;
  std::vector<Input> inputs;
  GamepadWatch gamepads;
  bool closeRequested = false, contextLost = false, focusLost = false;
  std::string loss;

  // All windows, for events that belong to none: a monitor unplugged, the focus passed between them.
  static std::vector<State*>& all() {
    static std::vector<State*> states;
    return states;
  }
  static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }

  GLFWwindow* window() const { return context->window(); }

  glm::vec2 cursorPx() const {
    double x = 0, y = 0;
    int width = 0, height = 0;
    glfwGetCursorPos(window(), &x, &y);
    glfwGetWindowSize(window(), &width, &height);
    const glm::vec2 size(context->framebufferSizePx());
    return {static_cast<float>(x) * size.x / static_cast<float>(std::max(width, 1)),
            static_cast<float>(y) * size.y / static_cast<float>(std::max(height, 1))};
  }

  void place(const UiWindowOptions& options) {
    monitor = chooseMonitor(options.monitor);
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    if (options.fullScreen) {
      glfwSetWindowMonitor(window(), monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    } else {
      int x = 0, y = 0, width = 0, height = 0;
      glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
      glfwSetWindowPos(window(), x + std::max((width - options.sizePx.x) / 2, 0),
                       y + std::max((height - options.sizePx.y) / 2, 0));
    }
    glfwSetWindowAttrib(window(), GLFW_RESIZABLE, options.resizable ? GLFW_TRUE : GLFW_FALSE);
    // A click in the experimenter's window must not minimise the participant's.
    glfwSetWindowAttrib(window(), GLFW_AUTO_ICONIFY, GLFW_FALSE);
    glfwSetWindowAttrib(window(), GLFW_FOCUS_ON_SHOW, options.takesFocus ? GLFW_TRUE : GLFW_FALSE);
    glfwShowWindow(window());
    if (options.takesFocus) glfwFocusWindow(window());
    const char* name = glfwGetMonitorName(monitor);
    glm::vec2 contentScale(1.0F);
    glfwGetWindowContentScale(window(), &contentScale.x, &contentScale.y);
    monitorFacts = {name ? name : "",
                    {mode->width, mode->height},
                    static_cast<double>(mode->refreshRate),
                    std::max(contentScale.x, 1.0F)};
    scale = options.scale > 0 ? options.scale : monitorFacts.contentScale;
  }

  void installCallbacks();
};

void UiWindow::State::installCallbacks() {
  glfwSetWindowUserPointer(window(), this);
  glfwSetKeyCallback(window(), [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    ++of(w).events;
    const int64_t now = steadyNs();
    State& state = of(w);
    const int translated = translateKey(key, scancode);
    if (action == GLFW_PRESS && translated != kKeyNone)
      state.inputs.push_back({Device::Keyboard, translated, 0, 0, now});
    const UiScope scope(state.imgui);
    ImGui_ImplGlfw_KeyCallback(w, key, scancode, action, mods);
  });
  glfwSetMouseButtonCallback(window(), [](GLFWwindow* w, int button, int action, int mods) {
    ++of(w).events;
    const int64_t now = steadyNs();
    State& state = of(w);
    if (action == GLFW_PRESS && button == GLFW_MOUSE_BUTTON_LEFT) {
      const glm::vec2 at = state.cursorPx();
      state.inputs.push_back({Device::Mouse, kKeyNone, at.x, at.y, now});
    }
    const UiScope scope(state.imgui);
    ImGui_ImplGlfw_MouseButtonCallback(w, button, action, mods);
  });
  glfwSetScrollCallback(window(), [](GLFWwindow* w, double x, double y) {
    ++of(w).events;
    const UiScope scope(of(w).imgui);
    ImGui_ImplGlfw_ScrollCallback(w, x, y);
  });
  glfwSetCharCallback(window(), [](GLFWwindow* w, unsigned int character) {
    ++of(w).events;
    const UiScope scope(of(w).imgui);
    ImGui_ImplGlfw_CharCallback(w, character);
  });
  glfwSetCursorEnterCallback(window(), [](GLFWwindow* w, int entered) {
    ++of(w).events;
    const UiScope scope(of(w).imgui);
    ImGui_ImplGlfw_CursorEnterCallback(w, entered);
  });
  glfwSetWindowFocusCallback(window(), [](GLFWwindow* w, int focused) {
    ++of(w).events;
    State& state = of(w);
    state.focusLost = !focused;
    const UiScope scope(state.imgui);
    ImGui_ImplGlfw_WindowFocusCallback(w, focused);
  });
  glfwSetWindowIconifyCallback(window(), [](GLFWwindow* w, int iconified) {
    ++of(w).events;
    if (iconified) of(w).loss = "the window was minimised";
  });
  glfwSetFramebufferSizeCallback(window(), [](GLFWwindow* w, int, int) {
    ++of(w).events;
    of(w).loss = "the window changed size";
  });
  glfwSetCursorPosCallback(window(), [](GLFWwindow* w, double, double) { ++of(w).events; });
  glfwSetWindowRefreshCallback(window(), [](GLFWwindow* w) { ++of(w).events; });
  glfwSetWindowCloseCallback(window(), [](GLFWwindow* w) {
    ++of(w).events;
    of(w).closeRequested = true;
    glfwSetWindowShouldClose(w, GLFW_FALSE);
  });
  glfwSetMonitorCallback([](GLFWmonitor* gone, int event) {
    if (event != GLFW_DISCONNECTED) return;
    for (State* state : all())
      if (state->monitor == gone) {
        state->loss = "the display was unplugged";
        state->monitor = nullptr;
      }
  });
}

UiWindow::UiWindow(const UiWindowOptions& options) : state_(std::make_unique<State>()) {
  State& state = *state_;
  // Hidden until it is in place, so that nobody sees it move.
  state.context = std::make_unique<gl::WindowContext>(options.title, options.sizePx, false);
  state.place(options);
  startUi(state.scale, options.density, options.lettering);
  state.imgui = imgui_;
  {
    const UiScope scope(imgui_);
    ImGui_ImplGlfw_InitForOpenGL(state.window(), false);
  }
  state.installCallbacks();
  State::all().push_back(&state);
  glfwPollEvents();
  state.loss.clear();  // it was resized just now
}

UiWindow::~UiWindow() {
  std::vector<State*>& all = State::all();
  all.erase(std::remove(all.begin(), all.end(), state_.get()), all.end());
  state_->context->makeCurrent();
  {
    const UiScope scope(imgui_);
    ImGui_ImplGlfw_Shutdown();
  }
  endUi();
}

gl::WindowContext& UiWindow::context() { return *state_->context; }
glm::ivec2 UiWindow::sizePx() const { return state_->context->framebufferSizePx(); }
UiMonitor UiWindow::monitor() const { return state_->monitorFacts; }
glm::vec2 UiWindow::cursorPx() const { return state_->cursorPx(); }
bool UiWindow::gamepadPresent() const { return state_->gamepads.present(); }
bool UiWindow::contextLost() const { return state_->contextLost; }
bool UiWindow::takeCloseRequest() { return std::exchange(state_->closeRequested, false); }

std::string UiWindow::windowSystem() const { return std::string("GLFW ") + glfwGetVersionString(); }

void UiWindow::poll(double seconds) {
  const int64_t end = steadyNs() + static_cast<int64_t>(seconds * 1e9);
  glfwPollEvents();
  state_->gamepads.poll(state_->inputs);
  while (state_->inputs.empty() && !state_->closeRequested) {
    const double left = static_cast<double>(end - steadyNs()) * 1e-9;
    if (left <= 0) break;
    if (!state_->gamepads.present()) {
      glfwWaitEventsTimeout(left);
      break;
    }
    glfwWaitEventsTimeout(std::min(left, kGamepadPollS));
    state_->gamepads.poll(state_->inputs);
  }
}

bool UiWindow::waitForAnything(double seconds) {
  glfwPollEvents();
  if (state_->events == state_->eventsSeen && seconds > 0.0) glfwWaitEventsTimeout(seconds);
  const bool woken = wakeAsked.exchange(false);
  state_->inputs.clear();  // callers that wait like this rely on ImGui's events
  return std::exchange(state_->eventsSeen, state_->events) != state_->events || woken;
}

void UiWindow::wake() {
  wakeAsked = true;
  glfwPostEmptyEvent();
}

std::vector<Input> UiWindow::takeInputs() { return std::exchange(state_->inputs, {}); }

std::string UiWindow::takeLoss() {
  if (std::exchange(state_->focusLost, false)) {
    const bool passedOn = std::any_of(State::all().begin(), State::all().end(), [](const State* other) {
      return glfwGetWindowAttrib(other->window(), GLFW_FOCUSED);
    });
    if (!passedOn && state_->loss.empty()) state_->loss = "another window is in front";
  }
  return std::exchange(state_->loss, {});
}

void UiWindow::hideCursor(bool hide) {
  glfwSetInputMode(state_->window(), GLFW_CURSOR, hide ? GLFW_CURSOR_HIDDEN : GLFW_CURSOR_NORMAL);
}

void UiWindow::bindContext() const { state_->context->makeCurrent(); }

void UiWindow::beginUiFrame() {
  ImGui_ImplGlfw_NewFrame();
  // Everything in framebuffer pixels, so that lettering is as sharp as the screen allows.
  const glm::ivec2 size = sizePx();
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos.x *= io.DisplayFramebufferScale.x;
  io.MousePos.y *= io.DisplayFramebufferScale.y;
  io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
  io.DisplayFramebufferScale = {1, 1};
}

int64_t UiWindow::show(int interval) {
  state_->context->makeCurrent();
  state_->context->swap(interval);
  if (glfwGetError(nullptr) != GLFW_NO_ERROR) state_->loss = "could not show the window";
  glFinish();
  const int64_t now = steadyNs();
  if (glGetGraphicsResetStatus() != GL_NO_ERROR) {
    state_->contextLost = true;
    state_->loss = "the graphics driver was reset";
  }
  return now;
}

}  // namespace limen::window
