// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>

#include "experiments/base/image.h"
#include "renderer/window/ui_fonts.h"

struct ImGuiContext;

namespace limen::gl {
class Context;
}

namespace limen::window {

/// Makes an ImGui context current for its own lifetime: ImGui and its back ends use the current one, and a
/// process may have several.
class UiScope {
 public:
  explicit UiScope(ImGuiContext* context);
  ~UiScope();
  UiScope(const UiScope&) = delete;
  UiScope& operator=(const UiScope&) = delete;

 private:
  ImGuiContext* before_;
};

/// Something that Dear ImGui draws on: a window or a picture in memory. Knows nothing about the content.
class UiSurface {
 public:
  virtual ~UiSurface() = default;
  UiSurface(const UiSurface&) = delete;
  UiSurface& operator=(const UiSurface&) = delete;

  virtual gl::Context& context() = 0;
  virtual glm::ivec2 sizePx() const = 0;  ///< of the framebuffer
  float scale() const { return scale_; }  ///< of fonts and targets
  const UiFonts& fonts() const { return fonts_; }

  /// Draws an interface over `background` (values as they go to the screen): `build` makes its calls to
  /// ImGui.
  void draw(glm::vec3 background, const std::function<void()>& build);
  /// The same over the current content.
  void overlay(const std::function<void()>& build);
  /// What was drawn, 3 channels, row 0 at the top.
  Image readBack() const;

 protected:
  UiSurface() = default;
  /// Called by subclasses once the context is current: creates the interface's own context, fonts and style.
  void startUi(float scale, UiDensity density, const UiLettering& lettering = {});
  /// Called by destructors of subclasses while the context exists, after their own back end has ended.
  void endUi();

  virtual uint32_t framebuffer() const { return 0; }
  virtual void bindContext() const = 0;
  /// Size, time and input of a new frame for ImGui.
  virtual void beginUiFrame() = 0;

  ImGuiContext* imgui_ = nullptr;

 private:
  UiFonts fonts_;
  float scale_ = 1.0F;
};

}  // namespace limen::window
