// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/window/offscreen_ui.h"

#include <epoxy/gl.h>
// GLFW after epoxy, which brings the GL header; for key numbers only.
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <array>
#include <utility>

namespace limen::window {
namespace {

constexpr std::array<std::pair<ImGuiKey, int>, 21> kKeyNumbers = {{{ImGuiKey_Tab, GLFW_KEY_TAB},
                                                                   {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                                                   {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                                                   {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                                                   {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                                                   {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                                                   {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                                                   {ImGuiKey_Home, GLFW_KEY_HOME},
                                                                   {ImGuiKey_End, GLFW_KEY_END},
                                                                   {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                                                   {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                                                   {ImGuiKey_Space, GLFW_KEY_SPACE},
                                                                   {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                                                   {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                                                   {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                                                   {ImGuiKey_A, GLFW_KEY_A},
                                                                   {ImGuiKey_C, GLFW_KEY_C},
                                                                   {ImGuiKey_V, GLFW_KEY_V},
                                                                   {ImGuiKey_X, GLFW_KEY_X},
                                                                   {ImGuiKey_Y, GLFW_KEY_Y},
                                                                   {ImGuiKey_Z, GLFW_KEY_Z}}};

}  // namespace

OffscreenUi::OffscreenUi(glm::ivec2 sizePx, float scale, UiDensity density)
    : context_(gl::createHeadlessContext()), sizePx_(sizePx) {
  makeTarget();
  startUi(scale, density);
  const UiScope scope(imgui_);
  for (const auto& [imgui, number] : kKeyNumbers) ImGui::GetIO().KeyMap[imgui] = number;
}

OffscreenUi::~OffscreenUi() {
  context_->makeCurrent();
  endUi();
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &colour_);
}

void OffscreenUi::makeTarget() {
  context_->makeCurrent();
  if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
  if (colour_ != 0) glDeleteTextures(1, &colour_);
  glCreateTextures(GL_TEXTURE_2D, 1, &colour_);
  glTextureStorage2D(colour_, 1, GL_RGBA8, sizePx_.x, sizePx_.y);
  glCreateFramebuffers(1, &framebuffer_);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, colour_, 0);
}

void OffscreenUi::resize(glm::ivec2 sizePx) {
  sizePx_ = sizePx;
  makeTarget();
}

void OffscreenUi::finish() {
  context_->makeCurrent();
  glFinish();
}

void OffscreenUi::key(int key, bool down) {
  const UiScope scope(imgui_);
  ImGuiIO& io = ImGui::GetIO();
  io.KeysDown[key] = down;
  io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
  io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
}

void OffscreenUi::type(const std::string& utf8) {
  const UiScope scope(imgui_);
  ImGui::GetIO().AddInputCharactersUTF8(utf8.c_str());
}

void OffscreenUi::beginUiFrame() {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(sizePx_.x), static_cast<float>(sizePx_.y)};
  io.DeltaTime = 1.0F / 60.0F;  // the same at every call: pictures must not depend on the machine's speed
  io.MousePos = {mousePx_.x, mousePx_.y};
  for (int i = 0; i < 3; ++i) io.MouseDown[i] = buttons_[i];
  io.MouseWheel += std::exchange(scrolled_, 0.0F);
}

}  // namespace limen::window
