// SPDX-License-Identifier: BSD-3-Clause
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "experiments/viewer/controls.h"

namespace limen::viewer {
namespace {

bool contains(const std::string& name, const std::string& part) {
  const auto lower = [](unsigned char c) { return std::tolower(c); };
  return std::search(name.begin(), name.end(), part.begin(), part.end(), [&](char a, char b) {
           return lower(static_cast<unsigned char>(a)) == lower(static_cast<unsigned char>(b));
         }) != name.end();
}

}  // namespace

std::optional<std::string> nameChooser(const std::string& label, const std::vector<std::string>& names,
                                       const std::string& chosen,
                                       const std::function<std::string(const std::string&)>& about,
                                       ControlMap& places) {
  ImGui::SetNextItemWidth(-1.0F);
  const bool open = ImGui::BeginCombo(("##" + label).c_str(), chosen.empty() ? "none" : chosen.c_str(),
                                      ImGuiComboFlags_HeightLarge);
  places.note(label);
  if (!open) {
    if (!chosen.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", about(chosen).c_str());
    return {};
  }
  static std::array<char, 128> filter{};  // one list is open at a time
  if (ImGui::IsWindowAppearing()) {
    filter.fill('\0');
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(-1.0F);
  ImGui::InputTextWithHint("##filter", "filter", filter.data(), filter.size());
  std::optional<std::string> change;
  std::string folder;
  for (const std::string& name : names) {
    if (!contains(name, filter.data())) continue;
    const size_t slash = name.find('/');
    const std::string own = slash == std::string::npos ? "" : name.substr(0, slash);
    if (own != folder && !own.empty()) ImGui::TextDisabled("%s", own.c_str());
    folder = own;
    if (ImGui::Selectable(name.empty() ? "none" : name.c_str(), name == chosen) && name != chosen)
      change = name;
    places.note(label + "/" + name);
    if (!name.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", about(name).c_str());
  }
  ImGui::EndCombo();
  return change;
}

}  // namespace limen::viewer
