// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/picture_pane.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/viewer/camera_control.h"
#include "experiments/viewer/viewer.h"

namespace limen::viewer {
namespace {

constexpr std::array<std::pair<Arrangement, const char*>, 7> kArrangements = {
    {{Arrangement::First, "first"},
     {Arrangement::Second, "second"},
     {Arrangement::SideBySide, "side by side"},
     {Arrangement::Split, "split"},
     {Arrangement::Flicker, "flicker"},
     {Arrangement::ErrorMap, "error"},
     {Arrangement::Overlay, "predicted"}}};

constexpr double kLeastFlickerHz = 0.5, kMostFlickerHz = 30.0;
/// A press that moves no farther than this picks a pixel; others drag the camera.
constexpr float kClickPx = 3.0F;

ImVec2 toIm(glm::vec2 v) { return {v.x, v.y}; }
glm::vec2 fromIm(ImVec2 v) { return {v.x, v.y}; }

}  // namespace

PicturePane::PicturePane(Viewer& viewer, glm::vec2 leastPx, glm::vec2 mostPx)
    : viewer_(viewer), leastPx_(leastPx), mostPx_(glm::max(mostPx, leastPx + 1.0F)) {}

void PicturePane::build(double secondsPassed) {
  ImGui::SetNextWindowPos(toIm(leastPx_));
  ImGui::SetNextWindowSize(toIm(mostPx_ - leastPx_));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("picture", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollbar |
                   ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBringToFrontOnFocus);
  arrangementBar();
  show(secondsPassed);
  ImGui::End();
  ImGui::PopStyleVar();
}

void PicturePane::arrangementBar() {
  const float em = ImGui::GetFontSize();
  ImGui::SetCursorPos({0.4F * em, 0.3F * em});
  for (const auto& [arrangement, name] : kArrangements) {
    const bool chosen = viewer_.arrangement == arrangement;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (ImGui::Button(name)) viewer_.arrangement = arrangement;
    if (chosen) ImGui::PopStyleColor();
    viewer_.controls_.note(std::string("arrangement.") + name);
    ImGui::SameLine();
  }
  if (ImGui::GetContentRegionAvail().x < 7.0F * em) {
    ImGui::NewLine();
    ImGui::SetCursorPosX(0.4F * em);
  }
  ImGui::SetNextItemWidth(7.0F * em);
  if (viewer_.arrangement == Arrangement::Flicker) {
    ImGui::SliderScalar("##flicker", ImGuiDataType_Double, &viewer_.flickerHz_, &kLeastFlickerHz,
                        &kMostFlickerHz, "%.1f changes/s",
                        ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  } else {
    int size = viewer_.zoom_ <= 0.0   ? 0
               : viewer_.zoom_ <= 1.0 ? 1
               : viewer_.zoom_ <= 2.0 ? 2
               : viewer_.zoom_ <= 4.0 ? 3
                                      : 4;
    constexpr std::array<double, 5> kZooms = {0.0, 1.0, 2.0, 4.0, 8.0};
    if (ImGui::Combo("##zoom", &size,
                     "as fits\0"
                     "1:1\0"
                     "2:1\0"
                     "4:1\0"
                     "8:1\0")) {
      viewer_.zoom_ = kZooms[static_cast<size_t>(size)];
      viewer_.panPx_ = {0, 0};
    }
  }
  viewer_.controls_.note("zoom");
  ImGui::NewLine();
}

PicturePane::Placed PicturePane::place(const UiTexture& texture, glm::vec2 leastPx, glm::vec2 mostPx) const {
  const glm::vec2 room = glm::max(mostPx - leastPx, 1.0F), size(glm::max(texture.sizePx(), 1));
  const auto zoom = static_cast<float>(viewer_.zoom_);
  const float factor = zoom > 0.0F ? zoom : std::min(room.x / size.x, room.y / size.y);
  const glm::vec2 shown = size * factor;
  const glm::vec2 least =
      glm::round(0.5F * (leastPx + mostPx) - 0.5F * shown + (zoom > 0.0F ? viewer_.panPx_ : glm::vec2(0.0F)));
  return {least, least + shown};
}

void PicturePane::draw(const UiTexture& texture, const Placed& where, float fromX, float toX,
                       const std::string& name) {
  if (texture.empty()) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const glm::vec2 size = where.mostPx - where.leastPx;
  list.AddImage(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(texture.id())),
                {where.leastPx.x + fromX * size.x, where.leastPx.y},
                {where.leastPx.x + toX * size.x, where.mostPx.y}, {fromX, 0.0F}, {toX, 1.0F});
  if (name.empty()) return;
  const float em = ImGui::GetFontSize();
  const ImVec2 text = ImGui::CalcTextSize(name.c_str());
  // Left half of a split: its name at the left; right half: at the right.
  const float x = fromX > 0.0F ? where.mostPx.x - text.x - 0.5F * em : where.leastPx.x + 0.5F * em;
  const float y = where.leastPx.y + 0.4F * em;
  list.AddRectFilled({x - 0.3F * em, y - 0.15F * em}, {x + text.x + 0.3F * em, y + text.y + 0.15F * em},
                     IM_COL32(0, 0, 0, 160), 3.0F);
  list.AddText({x, y}, IM_COL32(255, 255, 255, 255), name.c_str());
}

void PicturePane::show(double secondsPassed) {
  const glm::vec2 least = fromIm(ImGui::GetCursorScreenPos());
  const glm::vec2 most = mostPx_;
  const Rendered* first =
      viewer_.shown_ && !viewer_.shown_->rendered.empty() ? &viewer_.shown_->rendered[0] : nullptr;
  viewer_.first_.show(first ? first->picture : nullptr);
  viewer_.second_.show(viewer_.secondPicture());
  const ErrorMap* map = nullptr;
  if (viewer_.judged_)
    if (const auto found = viewer_.judged_->maps.find(viewer_.mapName_); found != viewer_.judged_->maps.end())
      map = &found->second;
  viewer_.map_.show(map ? map->picture : nullptr);
  viewer_.painted_.show(viewer_.judged_ ? viewer_.judged_->overlay : nullptr);
  const std::string firstName = viewer_.choices_.technique.name;
  const std::string secondName = viewer_.choices_.other       ? viewer_.choices_.other->name
                                 : viewer_.choices_.reference ? viewer_.choices_.reference->name
                                                              : "";

  ImGui::PushClipRect(toIm(least), toIm(most), true);
  Placed where = place(viewer_.first_, least, most);
  const UiTexture* shown = &viewer_.first_;
  switch (viewer_.arrangement) {
    case Arrangement::First:
      draw(viewer_.first_, where, 0.0F, 1.0F, "");
      break;
    case Arrangement::Second:
      shown = &viewer_.second_;
      draw(viewer_.second_, where, 0.0F, 1.0F, secondName);
      break;
    case Arrangement::SideBySide: {
      const float middle = 0.5F * (least.x + most.x);
      where = place(viewer_.first_, least, {middle - 2.0F, most.y});
      const Placed other = place(viewer_.second_, {middle + 2.0F, least.y}, most);
      draw(viewer_.first_, where, 0.0F, 1.0F, firstName);
      draw(viewer_.second_, other, 0.0F, 1.0F, secondName);
      // The hand may be on either.
      if (ImGui::GetIO().MousePos.x >= middle && !ImGui::IsAnyMouseDown()) where = other;
      break;
    }
    case Arrangement::Split: {
      draw(viewer_.first_, where, 0.0F, viewer_.splitAt_, firstName);
      draw(viewer_.second_, where, viewer_.splitAt_, 1.0F, secondName);
      const float x = where.leastPx.x + viewer_.splitAt_ * (where.mostPx.x - where.leastPx.x);
      ImGui::GetWindowDrawList()->AddLine({x, where.leastPx.y}, {x, where.mostPx.y},
                                          IM_COL32(255, 255, 255, 200), 1.0F);
      break;
    }
    case Arrangement::Flicker: {
      const bool second =
          std::fmod(viewer_.clockS_ * viewer_.flickerHz_, 2.0) >= 1.0 && !viewer_.second_.empty();
      draw(second ? viewer_.second_ : viewer_.first_, where, 0.0F, 1.0F, second ? secondName : firstName);
      break;
    }
    case Arrangement::ErrorMap:
      shown = &viewer_.map_;
      draw(viewer_.map_, where, 0.0F, 1.0F, viewer_.mapName_);
      break;
    case Arrangement::Overlay:
      shown = &viewer_.painted_;
      draw(viewer_.painted_, where, 0.0F, 1.0F, "");
      break;
  }
  ImGui::PopClipRect();
  const float em = ImGui::GetFontSize();
  std::string empty;
  if (viewer_.first_.empty())
    empty = first && !first->error.empty()                     ? first->error
            : viewer_.shown_ && !viewer_.shown_->error.empty() ? viewer_.shown_->error
                                                               : "the first picture is being made";
  else if (shown->empty())
    empty = viewer_.arrangement == Arrangement::Overlay && viewer_.overlay_ == Overlay::None
                ? "choose what is to be predicted, on the right"
            : viewer_.arrangement == Arrangement::Second && secondName.empty()
                ? "choose a second technique or a reference, on the left"
                : "this picture is being made";
  if (!empty.empty()) {
    ImGui::SetCursorScreenPos({least.x + em, least.y + em});
    ImGui::PushTextWrapPos(mostPx_.x - leastPx_.x - em);
    ImGui::TextUnformatted(empty.c_str());
    ImGui::PopTextWrapPos();
  }
  // An item over all of it takes the mouse.
  ImGui::SetCursorScreenPos(toIm(least));
  ImGui::InvisibleButton("hand", toIm(glm::max(most - least, 1.0F)),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  viewer_.controls_.note("picture", where.leastPx, where.mostPx);
  hand(where, secondsPassed);
  if (viewer_.pickedPx_ && !viewer_.first_.empty()) {
    const glm::vec2 texel = (where.mostPx - where.leastPx) / glm::vec2(viewer_.first_.sizePx());
    const glm::vec2 at = where.leastPx + (glm::vec2(*viewer_.pickedPx_) + 0.5F) * texel;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircle(toIm(at), std::max(0.75F * texel.x, 0.5F * em), IM_COL32(0, 0, 0, 255), 0, 3.0F);
    list.AddCircle(toIm(at), std::max(0.75F * texel.x, 0.5F * em), IM_COL32(255, 220, 60, 255), 0, 1.5F);
  }
}

void PicturePane::hand(const Placed& where, double secondsPassed) {
  viewer_.flying_ = false;
  if (!viewer_.shown_ || !viewer_.shown_->error.empty()) return;
  const ImGuiIO& io = ImGui::GetIO();
  const bool hovered = ImGui::IsItemHovered(), held = ImGui::IsItemActive();
  const glm::vec2 mouse = fromIm(io.MousePos), size = where.mostPx - where.leastPx;
  const double diagonal = viewer_.shown_->bounds.diagonal();
  // What the hand holds is what it sees: the camera of the last picture, or the one asked for since.
  const scene::Camera now = viewer_.cameraNow();

  if (ImGui::IsItemActivated()) {
    viewer_.dragFrom_ = now;
    viewer_.dragStartPx_ = mouse;
    viewer_.splitHeld_ =
        viewer_.arrangement == Arrangement::Split &&
        std::abs(mouse.x - (where.leastPx.x + viewer_.splitAt_ * size.x)) < 0.6F * ImGui::GetFontSize();
    viewer_.panFrom_ = viewer_.panPx_;
  }
  const glm::vec2 dragPx = mouse - viewer_.dragStartPx_;
  const bool dragged = held && glm::length(dragPx) > kClickPx;
  const glm::dvec2 drag = glm::dvec2(dragPx) / static_cast<double>(std::max(size.y, 1.0F));
  if (held && viewer_.splitHeld_) {
    viewer_.splitAt_ = std::clamp((mouse.x - where.leastPx.x) / size.x, 0.02F, 0.98F);
  } else if (dragged && io.KeyCtrl && viewer_.zoom_ > 0.0) {
    viewer_.panPx_ = viewer_.panFrom_ + dragPx;
  } else if (dragged && ImGui::IsMouseDown(ImGuiMouseButton_Left) && !io.KeyShift) {
    viewer_.moveTo(orbit(viewer_.dragFrom_, drag));
  } else if (dragged &&
             (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || ImGui::IsMouseDown(ImGuiMouseButton_Left))) {
    viewer_.moveTo(pan(viewer_.dragFrom_, drag));
  } else if (held && ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
    scene::Camera camera = dragged ? look(viewer_.dragFrom_, drag) : now;
    const auto axis = [](int plus, int minus) {
      return (ImGui::IsKeyDown(plus) ? 1.0 : 0.0) - (ImGui::IsKeyDown(minus) ? 1.0 : 0.0);
    };
    const FlyKeys keys{axis('W', 'S'), axis('D', 'A'), axis('E', 'Q')};
    if (keys.forward != 0.0 || keys.right != 0.0 || keys.up != 0.0) {
      camera = fly(camera, keys, secondsPassed, diagonal);
      // Flying moves the place from which the drag turns.
      const glm::dvec3 step = camera.eye - (dragged ? viewer_.dragFrom_.eye : now.eye);
      viewer_.dragFrom_.eye += step;
      viewer_.dragFrom_.target += step;
      viewer_.flying_ = true;
    }
    if (dragged || viewer_.flying_) viewer_.moveTo(camera);
  }
  if (ImGui::IsItemDeactivated() && !viewer_.splitHeld_ && glm::length(dragPx) <= kClickPx &&
      ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !viewer_.first_.empty()) {
    const glm::ivec2 pixel =
        glm::ivec2(glm::floor((mouse - where.leastPx) / size * glm::vec2(viewer_.first_.sizePx())));
    if (glm::all(glm::greaterThanEqual(pixel, glm::ivec2(0))) &&
        glm::all(glm::lessThan(pixel, viewer_.first_.sizePx())))
      viewer_.pickedPx_ = pixel;
    else
      viewer_.pickedPx_.reset();
  }
  if (hovered && io.MouseWheel != 0.0F) viewer_.moveTo(dolly(now, io.MouseWheel, diagonal));
}

}  // namespace limen::viewer
