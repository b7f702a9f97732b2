// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/window/ui_surface.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <vector>

#include "renderer/gl/context.h"

namespace limen::window {

UiScope::UiScope(ImGuiContext* context) : before_(ImGui::GetCurrentContext()) {
  ImGui::SetCurrentContext(context);
}
UiScope::~UiScope() { ImGui::SetCurrentContext(before_); }

void UiSurface::startUi(float scale, UiDensity density, const UiLettering& lettering) {
  scale_ = scale;
  imgui_ = ImGui::CreateContext();
  const UiScope scope(imgui_);
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
  ImGui_ImplOpenGL3_Init("#version 450 core");
  fonts_ = loadUiFonts(scale, density, lettering);
  styleUi(scale, density);
}

void UiSurface::endUi() {
  ImGui::SetCurrentContext(imgui_);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(imgui_);
  ImGui::SetCurrentContext(nullptr);
  imgui_ = nullptr;
}

void UiSurface::draw(glm::vec3 background, const std::function<void()>& build) {
  bindContext();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  glDisable(GL_SCISSOR_TEST);
  // Colours of the interface are values for the screen already.
  glDisable(GL_FRAMEBUFFER_SRGB);
  glClearColor(background.x, background.y, background.z, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  overlay(build);
}

void UiSurface::overlay(const std::function<void()>& build) {
  bindContext();
  const UiScope scope(imgui_);
  const glm::ivec2 size = sizePx();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  glViewport(0, 0, size.x, size.y);
  glDisable(GL_FRAMEBUFFER_SRGB);
  ImGui_ImplOpenGL3_NewFrame();
  beginUiFrame();
  ImGui::NewFrame();
  build();
  ImGui::Render();
  // Undoes whatever `build` did with GL.
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

Image UiSurface::readBack() const {
  bindContext();
  const glm::ivec2 size = sizePx();
  std::vector<uint8_t> bytes(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * 3);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer());
  glReadBuffer(framebuffer() == 0 ? GL_BACK : GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
  Image image(size.x, size.y, 3);
  const auto row = static_cast<size_t>(size.x) * 3;
  for (size_t y = 0; y < static_cast<size_t>(size.y); ++y)  // row 0 there is the bottom
    for (size_t x = 0; x < row; ++x)
      image.data[y * row + x] =
          static_cast<float>(bytes[(static_cast<size_t>(size.y) - 1 - y) * row + x]) / 255.0F;
  return image;
}

}  // namespace limen::window
