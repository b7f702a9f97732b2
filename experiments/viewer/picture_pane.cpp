// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/picture_pane.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace limen::viewer {
namespace {

constexpr std::array<std::pair<Arrangement, const char*>, 7> kArrangements = {
    {{Arrangement::First, "first"},
     {Arrangement::Second, "second"},
     {Arrangement::SideBySide, "side by side"},
     {Arrangement::Split, "split"},
     {Arrangement::Flicker, "flicker"},
     {Arrangement::ErrorMap, "error"},
     {Arrangement::Overlay, "prediction"}}};

constexpr double kLeastFlickerHz = 0.5, kMostFlickerHz = 30.0;

ImVec2 toIm(glm::vec2 v) { return {v.x, v.y}; }
glm::vec2 fromIm(ImVec2 v) { return {v.x, v.y}; }

std::string secondName(const ViewSetup& setup) {
  return setup.second ? setup.second->name : setup.reference ? setup.reference->name : "";
}

/// "3:1", "1:2.4"
std::string zoomText(float factor) {
  if (factor >= 1.0F) return numberText(std::round(factor)) + ":1";
  return "1:" + numberText(std::round(10.0F / factor) / 10.0F);
}

/// "absolute_error" as words.
std::string wordsOf(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Why there is no prediction yet, or none at all.
std::string textWithoutPrediction(const ViewerState& state) {
  if (state.overlay == Overlay::None) return "choose a prediction on the right";
  const bool second = state.rendered(1) != nullptr;
  if (state.overlay == Overlay::Popping && !second && !state.setup.reference)
    return "popping needs two pictures: choose a second technique or a reference on the left";
  const bool current = state.evaluated && state.evaluated->overlayKind == state.overlay;
  if (current && !state.evaluated->overlayNote.empty()) {
    const std::string& error = state.evaluated->error;
    return state.evaluated->overlayNote + (error.empty() ? "" : "\n" + error);
  }
  std::string out = "the prediction is being computed";
  if (state.overlay == Overlay::Popping && !second) {
    out = "waiting for the reference";
    if (state.evaluated && !state.evaluated->step.empty()) out += ", " + state.evaluated->step;
  }
  return out;
}

}  // namespace

void PicturePane::build(const PaneContext& pane, glm::vec2 leastPx, glm::vec2 mostPx, double secondsPassed) {
  mostPx = glm::max(mostPx, leastPx + 1.0F);
  clockS_ += secondsPassed;
  ImGui::SetNextWindowPos(toIm(leastPx));
  ImGui::SetNextWindowSize(toIm(mostPx - leastPx));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("picture", nullptr,
               kFixedWindow | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  arrangementBar(pane);
  upload(pane.state);
  const glm::vec2 least = fromIm(ImGui::GetCursorScreenPos());
  const glm::vec2 paneMostPx = mostPx;
  if (const std::optional<ColourScale> scale = scaleOf(pane.state)) {
    mostPx.y = std::max(mostPx.y - ColourBar::heightPx(), least.y + 1.0F);
    colourBar_.draw(*scale, {leastPx.x, mostPx.y}, paneMostPx);
    pane.controls.note("colour_bar", {leastPx.x, mostPx.y}, paneMostPx);
  }
  ImGui::PushClipRect(toIm(least), toIm(mostPx), true);
  const Placed where = drawArranged(pane.state, least, mostPx);
  if (!first_.empty())
    shownFactor_ = (where.mostPx.x - where.leastPx.x) / static_cast<float>(first_.sizePx().x);
  ImGui::PopClipRect();
  if (const std::string text = textIfEmpty(pane.state); !text.empty()) {
    const float em = ImGui::GetFontSize();
    ImGui::SetCursorScreenPos({least.x + em, least.y + em});
    ImGui::PushTextWrapPos(mostPx.x - leastPx.x - em);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    pane.controls.note("picture.reason");
  }
  // An item that covers the pane receives the mouse.
  ImGui::SetCursorScreenPos(toIm(least));
  ImGui::InvisibleButton("picture", toIm(glm::max(mostPx - least, 1.0F)),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  pane.controls.note("picture", where.leastPx, where.mostPx);
  handleMouse(pane, where, secondsPassed);
  markPicked(pane.state, where);
  ImGui::End();
  ImGui::PopStyleVar();
}

void PicturePane::arrangementBar(const PaneContext& pane) {
  const float em = ImGui::GetFontSize(), left = 0.4F * em, gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetCursorPos({left, 0.3F * em});
  const float end = ImGui::GetWindowWidth() - left;
  float x = left;  // where the next item begins if it fits
  const auto wrap = [&](float width) {
    if (x > left && x + width <= end)
      ImGui::SameLine(x);
    else if (x > left)
      x = left;
    ImGui::SetCursorPosX(x);
    x += width + gap;
  };
  for (const auto& [arrangement, name] : kArrangements) {
    wrap(ImGui::CalcTextSize(name).x + 2.0F * ImGui::GetStyle().FramePadding.x);
    const bool chosen = pane.state.arrangement == arrangement;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (ImGui::Button(name)) pane.commands.push(command::Arrange{arrangement});
    if (chosen) ImGui::PopStyleColor();
    pane.controls.note(std::string("arrangement.") + name);
  }
  wrap(7.0F * em);
  ImGui::SetNextItemWidth(7.0F * em);
  zoomControl(pane.state);
  pane.controls.note("zoom");
}

void PicturePane::zoomControl(const ViewerState& state) {
  if (state.arrangement == Arrangement::Flicker) {
    ImGui::SliderScalar("##flicker", ImGuiDataType_Double, &flickerHz_, &kLeastFlickerHz, &kMostFlickerHz,
                        "%.1f changes/s", ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    return;
  }
  constexpr std::array<int, 7> kZooms = {0, 1, 2, 3, 4, 8, 16};
  const auto text = [&](int zoom) {
    return zoom == 0 ? "fit, " + zoomText(shownFactor_) : zoomText(static_cast<float>(zoom));
  };
  if (!ImGui::BeginCombo("##zoom", text(zoom_).c_str())) return;
  for (const int zoom : kZooms) {
    if (!ImGui::Selectable(zoom == 0 ? "fit" : text(zoom).c_str(), zoom == zoom_)) continue;
    zoom_ = zoom;
    panPx_ = {0, 0};
  }
  ImGui::EndCombo();
}

void PicturePane::upload(const ViewerState& state) {
  const Rendered* first = state.rendered(0);
  first_.show(first ? first->picture : nullptr);
  second_.show(state.secondPicture());
  std::shared_ptr<const ScreenPicture> map;
  if (state.evaluated)
    if (const auto found = state.evaluated->maps.find(state.errorMap); found != state.evaluated->maps.end())
      map = found->second.picture;
  errorMap_.show(map);
  const bool current = state.evaluated && state.evaluated->overlayKind == state.overlay;
  prediction_.show(current ? state.evaluated->overlay : nullptr);
}

std::optional<ColourScale> PicturePane::scaleOf(const ViewerState& state) const {
  if (shownTexture(state.arrangement).empty()) return {};
  if (state.arrangement == Arrangement::ErrorMap) {
    const ErrorMap& map = state.evaluated->maps.at(state.errorMap);
    return errorScaleOf(wordsOf(state.errorMap), map.white, map.largest);
  }
  if (state.arrangement == Arrangement::Overlay) {
    if (!isThresholds(state.overlay)) return std::nullopt;
    return thresholdScale(state.overlay == Overlay::SingleThresholds ? "single threshold map (cd/m2)"
                                                                     : "threshold, all bands (cd/m2)");
  }
  const Rendered* first = state.rendered(0);
  if (!first || state.arrangement == Arrangement::Second) return {};
  if (first->viewWhite > 0.0) return errorScaleOf(wordsOf(state.debugView), first->viewWhite, 0.0);
  if (first->kind == techniques::ProductKind::Threshold && state.debugView.empty()) return thresholdScale();
  return {};
}

float PicturePane::factorFor(glm::ivec2 sizePx, glm::vec2 roomPx) const {
  if (zoom_ > 0) return static_cast<float>(zoom_);
  const glm::vec2 fitting = roomPx / glm::vec2(glm::max(sizePx, 1));
  const float factor = std::min(fitting.x, fitting.y);
  // Every pixel of an enlarged picture gets the same number of screen pixels.
  return factor >= 1.0F ? std::floor(factor) : factor;
}

PicturePane::Placed PicturePane::place(const UiTexture& texture, glm::vec2 leastPx, glm::vec2 mostPx) const {
  const glm::vec2 room = glm::max(mostPx - leastPx, 1.0F), size(glm::max(texture.sizePx(), 1));
  const glm::vec2 shown = size * factorFor(texture.sizePx(), room);
  const glm::vec2 least =
      glm::round(0.5F * (leastPx + mostPx) - 0.5F * shown + (zoom_ > 0 ? panPx_ : glm::vec2(0.0F)));
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

PicturePane::Placed PicturePane::drawArranged(const ViewerState& state, glm::vec2 leastPx, glm::vec2 mostPx) {
  const std::string firstName = state.setup.technique.name, otherName = secondName(state.setup);
  const Placed where = place(first_, leastPx, mostPx);
  switch (state.arrangement) {
    case Arrangement::First:
      draw(first_, where, 0.0F, 1.0F, "");
      break;
    case Arrangement::Second:
      draw(second_, where, 0.0F, 1.0F, otherName);
      break;
    case Arrangement::SideBySide: {
      const float middle = 0.5F * (leastPx.x + mostPx.x);
      const Placed left = place(first_, leastPx, {middle - 2.0F, mostPx.y});
      const Placed right = place(second_, {middle + 2.0F, leastPx.y}, mostPx);
      draw(first_, left, 0.0F, 1.0F, firstName);
      draw(second_, right, 0.0F, 1.0F, otherName);
      // The mouse may be on either.
      return ImGui::GetIO().MousePos.x >= middle && !ImGui::IsAnyMouseDown() ? right : left;
    }
    case Arrangement::Split: {
      draw(first_, where, 0.0F, splitAt_, firstName);
      draw(second_, where, splitAt_, 1.0F, otherName);
      const float x = where.leastPx.x + splitAt_ * (where.mostPx.x - where.leastPx.x);
      ImGui::GetWindowDrawList()->AddLine({x, where.leastPx.y}, {x, where.mostPx.y},
                                          IM_COL32(255, 255, 255, 200), 1.0F);
      break;
    }
    case Arrangement::Flicker: {
      const bool second = std::fmod(clockS_ * flickerHz_, 2.0) >= 1.0 && !second_.empty();
      draw(second ? second_ : first_, where, 0.0F, 1.0F, second ? otherName : firstName);
      break;
    }
    case Arrangement::ErrorMap:
      draw(errorMap_, where, 0.0F, 1.0F, state.errorMap);
      break;
    case Arrangement::Overlay:
      draw(prediction_, where, 0.0F, 1.0F, "");
      break;
  }
  return where;
}

const UiTexture& PicturePane::shownTexture(Arrangement arrangement) const {
  switch (arrangement) {
    case Arrangement::Second:
      return second_;
    case Arrangement::ErrorMap:
      return errorMap_;
    case Arrangement::Overlay:
      return prediction_;
    default:
      return first_;
  }
}

std::string PicturePane::textIfEmpty(const ViewerState& state) const {
  if (first_.empty()) {
    const Rendered* first = state.rendered(0);
    if (first && !first->error.empty()) return first->error;
    return state.shown && !state.shown->error.empty() ? state.shown->error
                                                      : "the first picture is being rendered";
  }
  if (!shownTexture(state.arrangement).empty()) return {};
  if (state.arrangement == Arrangement::Overlay) return textWithoutPrediction(state);
  if (state.arrangement == Arrangement::Second && secondName(state.setup).empty())
    return "choose a second technique or a reference on the left";
  if (state.arrangement == Arrangement::ErrorMap && !state.setup.reference)
    return "choose a reference on the left";
  if (state.evaluated && !state.evaluated->error.empty()) return state.evaluated->error;
  return "this picture is being rendered";
}

void PicturePane::markPicked(const ViewerState& state, const Placed& where) const {
  if (!state.pickedPx || first_.empty()) return;
  const glm::vec2 texel = (where.mostPx - where.leastPx) / glm::vec2(first_.sizePx());
  const glm::vec2 at = where.leastPx + (glm::vec2(*state.pickedPx) + 0.5F) * texel;
  const float radius = std::max(0.75F * texel.x, 0.5F * ImGui::GetFontSize());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddCircle(toIm(at), radius, IM_COL32(0, 0, 0, 255), 0, 3.0F);
  list.AddCircle(toIm(at), radius, IM_COL32(255, 220, 60, 255), 0, 1.5F);
}

}  // namespace limen::viewer
