// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/window/ui_input.h"

#include <GLFW/glfw3.h>

#include <array>
#include <cctype>

namespace limen::window {
namespace {

struct PadButton {
  int button;
  int key;
};
constexpr std::array<PadButton, 9> kPadButtons = {{{GLFW_GAMEPAD_BUTTON_DPAD_LEFT, kPadLeft},
                                                   {GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, kPadRight},
                                                   {GLFW_GAMEPAD_BUTTON_DPAD_UP, kPadUp},
                                                   {GLFW_GAMEPAD_BUTTON_DPAD_DOWN, kPadDown},
                                                   {GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, kPadLeft},
                                                   {GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, kPadRight},
                                                   {GLFW_GAMEPAD_BUTTON_A, kPadAccept},
                                                   {GLFW_GAMEPAD_BUTTON_B, kPadBack},
                                                   {GLFW_GAMEPAD_BUTTON_START, kPadStart}}};
// A worn stick rests off centre by a tenth or so; it counts only when it is clearly pushed.
constexpr float kStickPushed = 0.6F;

std::vector<bool> heldKeys(const GLFWgamepadstate& state) {
  std::vector<bool> held;
  for (const PadButton& button : kPadButtons) held.push_back(state.buttons[button.button] == GLFW_PRESS);
  held.push_back(state.axes[GLFW_GAMEPAD_AXIS_LEFT_X] < -kStickPushed);
  held.push_back(state.axes[GLFW_GAMEPAD_AXIS_LEFT_X] > kStickPushed);
  held.push_back(state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y] < -kStickPushed);
  held.push_back(state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y] > kStickPushed);
  return held;
}

int keyAt(size_t index) {
  constexpr std::array<int, 4> kStick = {kPadLeft, kPadRight, kPadUp, kPadDown};
  return index < kPadButtons.size() ? kPadButtons[index].key : kStick[index - kPadButtons.size()];
}

}  // namespace

int translateKey(int glfwKey, int scancode) {
  switch (glfwKey) {
    case GLFW_KEY_LEFT:
      return kKeyLeft;
    case GLFW_KEY_RIGHT:
      return kKeyRight;
    case GLFW_KEY_UP:
      return kKeyUp;
    case GLFW_KEY_DOWN:
      return kKeyDown;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return kKeyEnter;
    case GLFW_KEY_SPACE:
      return kKeySpace;
    case GLFW_KEY_ESCAPE:
      return kKeyEscape;
    case GLFW_KEY_BACKSPACE:
      return kKeyBackspace;
    default:
      break;
  }
  if (glfwKey >= GLFW_KEY_0 && glfwKey <= GLFW_KEY_9) return '0' + (glfwKey - GLFW_KEY_0);
  if (glfwKey >= GLFW_KEY_KP_0 && glfwKey <= GLFW_KEY_KP_9) return '0' + (glfwKey - GLFW_KEY_KP_0);
  const char* name = glfwGetKeyName(glfwKey, scancode);
  if (!name || name[0] == '\0' || name[1] != '\0') return kKeyNone;
  const auto character = static_cast<unsigned char>(name[0]);
  return std::isalnum(character) ? std::tolower(character) : kKeyNone;
}

void GamepadWatch::poll(std::vector<Input>& inputs) {
  present_ = false;
  for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick) {
    GLFWgamepadstate state;
    if (!glfwJoystickIsGamepad(joystick) || !glfwGetGamepadState(joystick, &state)) {
      held_.erase(joystick);
      continue;
    }
    present_ = true;
    const std::vector<bool> held = heldKeys(state);
    std::vector<bool>& before = held_.try_emplace(joystick, held).first->second;
    for (size_t i = 0; i < held.size(); ++i)
      if (held[i] && !before[i]) inputs.push_back({Device::Gamepad, keyAt(i), 0, 0, steadyNs()});
    before = held;
  }
}

}  // namespace limen::window
