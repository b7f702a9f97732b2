// SPDX-License-Identifier: BSD-3-Clause
// The mouse on the picture: it moves the camera, the split or an enlarged picture, and picks pixels.
#include <algorithm>
#include <cmath>

#include "experiments/viewer/camera_control.h"
#include "experiments/viewer/picture_pane.h"

namespace limen::viewer {
namespace {

/// A press that moves no farther than this picks a pixel; others drag the camera.
constexpr float kClickPx = 3.0F;

glm::vec2 mousePx() { return {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y}; }

FlyKeys flyKeys() {
  const auto axis = [](int plus, int minus) {
    return (ImGui::IsKeyDown(plus) ? 1.0 : 0.0) - (ImGui::IsKeyDown(minus) ? 1.0 : 0.0);
  };
  return {axis('W', 'S'), axis('D', 'A'), axis('E', 'Q')};
}

}  // namespace

void PicturePane::handleMouse(const PaneContext& pane, const Placed& where, double secondsPassed) {
  const ViewerState& state = pane.state;
  if (!state.shown || !state.shown->error.empty()) return;
  const float width = where.mostPx.x - where.leastPx.x;
  if (ImGui::IsItemActivated()) {
    dragFrom_ = state.camera;
    dragStartPx_ = mousePx();
    splitHeld_ = state.arrangement == Arrangement::Split &&
                 std::abs(mousePx().x - (where.leastPx.x + splitAt_ * width)) < 0.6F * ImGui::GetFontSize();
    panFrom_ = panPx_;
  }
  const glm::vec2 dragPx = mousePx() - dragStartPx_;
  if (ImGui::IsItemActive() && splitHeld_)
    splitAt_ = std::clamp((mousePx().x - where.leastPx.x) / width, 0.02F, 0.98F);
  else if (ImGui::IsItemActive() && ImGui::GetIO().KeyCtrl && zoom_ > 0 && glm::length(dragPx) > kClickPx)
    panPx_ = panFrom_ + dragPx;
  else if (ImGui::IsItemActive())
    moveCamera(pane, where, secondsPassed);
  if (ImGui::IsItemDeactivated() && !splitHeld_ && glm::length(dragPx) <= kClickPx &&
      ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !first_.empty())
    pick(pane, where);
  if (const float steps = ImGui::GetIO().MouseWheel; ImGui::IsItemHovered() && steps != 0.0F)
    pane.commands.push(
        command::MoveCamera{dolly(state.camera, steps, state.shown->bounds.diagonal()), false});
}

void PicturePane::moveCamera(const PaneContext& pane, const Placed& where, double secondsPassed) {
  const glm::vec2 dragPx = mousePx() - dragStartPx_;
  const bool dragged = glm::length(dragPx) > kClickPx;
  const glm::dvec2 drag =
      glm::dvec2(dragPx) / static_cast<double>(std::max(where.mostPx.y - where.leastPx.y, 1.0F));
  const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (dragged && left && !ImGui::GetIO().KeyShift) {
    pane.commands.push(command::MoveCamera{orbit(dragFrom_, drag), false});
  } else if (dragged && (left || ImGui::IsMouseDown(ImGuiMouseButton_Middle))) {
    pane.commands.push(command::MoveCamera{pan(dragFrom_, drag), false});
  } else if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
    const scene::Camera from = dragged ? look(dragFrom_, drag) : pane.state.camera;
    const FlyKeys keys = flyKeys();
    const bool flying = keys.forward != 0.0 || keys.right != 0.0 || keys.up != 0.0;
    if (!dragged && !flying) return;
    scene::Camera camera = from;
    if (flying) {
      camera = fly(from, keys, secondsPassed, pane.state.shown->bounds.diagonal());
      // Flying moves the point from which the drag turns.
      const glm::dvec3 step = camera.eye - (dragged ? dragFrom_.eye : pane.state.camera.eye);
      dragFrom_.eye += step;
      dragFrom_.target += step;
    }
    pane.commands.push(command::MoveCamera{camera, flying});
  }
}

void PicturePane::pick(const PaneContext& pane, const Placed& where) {
  const glm::vec2 size = where.mostPx - where.leastPx;
  const glm::ivec2 pixel(glm::floor((mousePx() - where.leastPx) / size * glm::vec2(first_.sizePx())));
  const bool inside = glm::all(glm::greaterThanEqual(pixel, glm::ivec2(0))) &&
                      glm::all(glm::lessThan(pixel, first_.sizePx()));
  pane.commands.push(command::PickPixel{inside ? std::optional(pixel) : std::nullopt});
}

}  // namespace limen::viewer
