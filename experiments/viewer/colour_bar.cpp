// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/colour_bar.h"

#include <algorithm>
#include <cmath>

#include "experiments/base/text.h"
#include "experiments/viewer/number_text.h"
#include "perception/metrics/error_map.h"

namespace limen::viewer {
namespace {

constexpr int kColours = 256;

/// `valueAt` for shares from 0 to 1.
template <class ValueAt>
Image ramp(ValueAt valueAt) {
  Image out(kColours, 1, 1);
  for (int x = 0; x < kColours; ++x) out.at(x, 0) = static_cast<float>(valueAt(double(x) / (kColours - 1)));
  return out;
}

std::shared_ptr<const ScreenPicture> errorStrip() {
  static const auto kStrip = std::make_shared<const ScreenPicture>(
      screenPicture(perception::errorPicture(ramp([](double share) { return share; }), 1.0)));
  return kStrip;
}

}  // namespace

ColourScale errorScaleOf(const std::string& title, double white, double largest) {
  ColourScale out{errorStrip(), {}, title};
  for (const float share : {0.0F, 0.5F, 1.0F}) out.ticks.emplace_back(share, numberText(share * white));
  if (largest > white) out.ticks.back().second = ">= " + out.ticks.back().second;
  return out;
}

ColourScale thresholdScale(const std::string& title) {
  const double black = perception::kThresholdPictureBlack, white = perception::kThresholdPictureWhite;
  static const auto kStrip = std::make_shared<const ScreenPicture>(screenPicture(perception::thresholdPicture(
      ramp([&](double share) { return black * std::pow(white / black, share); }))));
  ColourScale out{kStrip, {}, title};
  const double decades = std::log10(white / black);
  for (int i = 0; i <= static_cast<int>(std::lround(decades)); ++i)
    out.ticks.emplace_back(static_cast<float>(i / decades), shortestNumber(black * std::pow(10.0, i)));
  return out;
}

void ColourBar::draw(const ColourScale& scale, glm::vec2 leastPx, glm::vec2 mostPx) {
  strip_.show(scale.strip);
  if (strip_.empty()) return;
  const float em = ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  const ImVec2 title = ImGui::CalcTextSize(scale.title.c_str());
  // The title stands at the left if there is room for it.
  const bool titled = mostPx.x - leastPx.x > title.x + 16.0F * em;
  const float left = leastPx.x + 1.5F * em + (titled ? title.x : 0.0F);
  const float right = std::min(mostPx.x - 2.0F * em, left + 28.0F * em);
  if (right <= left) return;
  const float top = leastPx.y + 0.4F * em, bottom = top + 0.8F * em;
  if (titled) list.AddText({leastPx.x + 0.7F * em, top - 0.1F * em}, ink, scale.title.c_str());
  list.AddImage(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(strip_.id())), {left, top},
                {right, bottom});
  list.AddRect({left, top}, {right, bottom}, ImGui::GetColorU32(ImGuiCol_TextDisabled));
  float free = leastPx.x;
  for (const auto& [share, text] : scale.ticks) {
    const float x = left + share * (right - left), width = ImGui::CalcTextSize(text.c_str()).x;
    list.AddLine({x, bottom}, {x, bottom + 0.2F * em}, ink);
    const float textX = std::clamp(x - 0.5F * width, leastPx.x, std::max(mostPx.x - width, leastPx.x));
    if (textX < free) continue;
    list.AddText({textX, bottom + 0.2F * em}, ink, text.c_str());
    free = textX + width + 0.5F * em;
  }
}

}  // namespace limen::viewer
