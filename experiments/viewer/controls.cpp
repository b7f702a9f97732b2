// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/controls.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

#include "experiments/base/error.h"

namespace limen::viewer {
namespace {

/// Ranges that span more than this are gone through by ratio.
constexpr double kLogarithmicSpan = 100.0;

/// Text as a format that prints it.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

ImGuiSliderFlags sliderFlags(const Parameter& parameter) {
  ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat;
  const double low = *parameter.minimum, high = *parameter.maximum;
  const bool ratios = low > 0.0 && high / low > kLogarithmicSpan;
  const bool wide = low == 0.0 && high > 10.0 * kLogarithmicSpan;
  if (ratios || wide) flags |= ImGuiSliderFlags_Logarithmic;
  return flags;
}

void tooltip(const Parameter& parameter, const ParameterValue& value) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30.0F);
  ImGui::TextUnformatted((parameter.name + ": " + parameter.description).c_str());
  ImGui::TextDisabled("%s", describeRange(parameter).c_str());
  if (!parameter.required)
    ImGui::TextDisabled("default %s, now %s", toText(parameter.defaultValue).c_str(), toText(value).c_str());
  if (!parameter.source.empty()) ImGui::TextDisabled("%s", parameter.source.c_str());
  if (parameter.type == ParameterType::Integer || parameter.type == ParameterType::Real)
    ImGui::TextDisabled("Ctrl+click to type a value");
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

/// Text that a user edits; taken over with Enter or when the field is left.
bool editText(const char* id, std::string& text) {
  // ImGui keeps the text while it is edited; this is what it starts from.
  std::array<char, 1024> buffer{};
  std::strncpy(buffer.data(), text.c_str(), buffer.size() - 1);
  ImGui::InputText(id, buffer.data(), buffer.size());
  if (!ImGui::IsItemDeactivatedAfterEdit()) return false;
  text = buffer.data();
  return true;
}

/// The control itself; gives the new value where there is one.
bool control(const Parameter& parameter, const ParameterValue& now, ParameterValue& next) {
  const std::string unit = parameter.unit.empty() ? "" : " " + escaped(parameter.unit);
  switch (parameter.type) {
    case ParameterType::Boolean: {
      bool on = std::get<bool>(now);
      if (!ImGui::Checkbox("##value", &on)) return false;
      next = on;
      return true;
    }
    case ParameterType::Integer: {
      int64_t value = std::get<int64_t>(now);
      const auto low = static_cast<int64_t>(*parameter.minimum),
                 high = static_cast<int64_t>(*parameter.maximum);
      if (!ImGui::SliderScalar("##value", ImGuiDataType_S64, &value, &low, &high, ("%lld" + unit).c_str(),
                               sliderFlags(parameter)))
        return false;
      next = value;
      return true;
    }
    case ParameterType::Real: {
      double value = std::get<double>(now);
      const double low = *parameter.minimum, high = *parameter.maximum;
      if (!ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &low, &high, ("%.5g" + unit).c_str(),
                               sliderFlags(parameter)))
        return false;
      next = value;
      return true;
    }
    case ParameterType::Choice: {
      const std::string& chosen = std::get<std::string>(now);
      bool changed = false;
      if (!ImGui::BeginCombo("##value", chosen.c_str())) return false;
      for (const std::string& choice : parameter.choices) {
        if (ImGui::Selectable(choice.c_str(), choice == chosen) && choice != chosen) {
          next = choice;
          changed = true;
        }
        if (choice == chosen) ImGui::SetItemDefaultFocus();
      }
      ImGui::EndCombo();
      return changed;
    }
    case ParameterType::Text:
    case ParameterType::File: {
      std::string text = std::get<std::string>(now);
      if (!editText("##value", text)) return false;
      next = text;
      return true;
    }
    case ParameterType::Group:
      return false;
  }
  return false;
}

bool contains(const std::string& name, const std::string& part) {
  const auto lower = [](unsigned char c) { return std::tolower(c); };
  return std::search(name.begin(), name.end(), part.begin(), part.end(), [&](char a, char b) {
           return lower(static_cast<unsigned char>(a)) == lower(static_cast<unsigned char>(b));
         }) != name.end();
}

}  // namespace

void ControlMap::note(const std::string& name) {
  const ImVec2 least = ImGui::GetItemRectMin(), most = ImGui::GetItemRectMax();
  note(name, {least.x, least.y}, {most.x, most.y});
}

void ControlMap::note(const std::string& name, glm::vec2 leastPx, glm::vec2 mostPx) {
  places_[name] = {leastPx, mostPx};
}

const ControlMap::Place* ControlMap::find(const std::string& name) const {
  const auto place = places_.find(name);
  return place == places_.end() ? nullptr : &place->second;
}

bool parameterControls(const std::string& prefix, const std::vector<Parameter>& declared, Chosen& chosen,
                       ControlMap& places) {
  bool changed = false;
  if (!ImGui::BeginTable((prefix + "##parameters").c_str(), 3, ImGuiTableFlags_SizingStretchProp))
    return false;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.42F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.58F);
  ImGui::TableSetupColumn("back", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFrameHeight());
  for (const Parameter& parameter : declared) {
    ImGui::PushID(parameter.name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    const ParameterValue now = shown(chosen, parameter);
    const bool given = chosen.given.count(parameter.name) != 0;
    if (given)
      ImGui::TextUnformatted(parameter.name.c_str());
    else
      ImGui::TextDisabled("%s", parameter.name.c_str());
    tooltip(parameter, now);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1.0F);
    ParameterValue next;
    if (control(parameter, now, next)) {
      try {
        give(chosen, parameter, next);
        changed = true;
      } catch (const Error&) {
        // Typed text that is no value: the old one stays, its range is in the tooltip.
      }
    }
    places.note(prefix + "." + parameter.name);
    tooltip(parameter, now);
    ImGui::TableNextColumn();
    if (given && !parameter.required) {
      if (ImGui::Button("x", {ImGui::GetFrameHeight(), 0.0F})) {
        chosen.given.erase(parameter.name);
        changed = true;
      }
      places.note(prefix + "." + parameter.name + ".default");
      if (ImGui::IsItemHovered())
        ImGui::SetTooltip("back to the default, %s", toText(parameter.defaultValue).c_str());
    }
    ImGui::PopID();
  }
  ImGui::EndTable();
  return changed;
}

bool nameChooser(const std::string& label, const std::vector<std::string>& names, std::string& chosen,
                 const std::function<std::string(const std::string&)>& about, ControlMap& places) {
  bool changed = false;
  ImGui::SetNextItemWidth(-1.0F);
  const bool open = ImGui::BeginCombo(("##" + label).c_str(), chosen.empty() ? "none" : chosen.c_str(),
                                      ImGuiComboFlags_HeightLarge);
  places.note(label);
  if (!open) {
    if (!chosen.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", about(chosen).c_str());
    return false;
  }
  static std::array<char, 128> filter{};
  if (ImGui::IsWindowAppearing()) {
    filter.fill('\0');
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(-1.0F);
  ImGui::InputTextWithHint("##filter", "filter", filter.data(), filter.size());
  std::string folder;
  for (const std::string& name : names) {
    if (!contains(name, filter.data())) continue;
    const size_t slash = name.find('/');
    const std::string own = slash == std::string::npos ? "" : name.substr(0, slash);
    if (own != folder && !own.empty()) ImGui::TextDisabled("%s", own.c_str());
    folder = own;
    if (ImGui::Selectable(name.empty() ? "none" : name.c_str(), name == chosen) && name != chosen) {
      chosen = name;
      changed = true;
    }
    places.note(label + "/" + name);
    if (!name.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", about(name).c_str());
  }
  ImGui::EndCombo();
  return changed;
}

}  // namespace limen::viewer
