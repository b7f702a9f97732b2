// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/controls.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "experiments/base/error.h"

namespace limen::viewer {
namespace {

/// Wider ranges get a logarithmic slider.
constexpr double kLogarithmicSpan = 100.0;

/// Text as a format string that prints it.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

ImGuiSliderFlags sliderFlags(const Parameter& parameter) {
  ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat;
  const double low = *parameter.minimum, high = *parameter.maximum;
  const bool ratios = low > 0.0 && high / low > kLogarithmicSpan;
  // From zero: by its extent, or by a default that a linear slider could not tell from zero.
  const auto* usual = std::get_if<double>(&parameter.defaultValue);
  const bool wide = low == 0.0 && (high > 10.0 * kLogarithmicSpan ||
                                   (usual && *usual > 0.0 && high > kLogarithmicSpan * *usual));
  if (ratios || wide) flags |= ImGuiSliderFlags_Logarithmic;
  return flags;
}

/// "one of a, b", or a line for each alternative that says what it is.
void describeAllowed(const Parameter& parameter) {
  const bool described =
      std::any_of(parameter.alternatives.begin(), parameter.alternatives.end(),
                  [](const Alternative& alternative) { return !alternative.description.empty(); });
  if (!described) return ImGui::TextDisabled("%s", describeRange(parameter).c_str());
  for (const Alternative& alternative : parameter.alternatives)
    ImGui::TextDisabled("%s%s%s", alternative.name.c_str(), alternative.description.empty() ? "" : ": ",
                        alternative.description.c_str());
}

/// `value`: null for a group.
void tooltip(const std::string& path, const Parameter& parameter, const ParameterValue* value) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30.0F);
  ImGui::TextUnformatted((path + ": " + parameter.description).c_str());
  if (value) {
    describeAllowed(parameter);
    if (!parameter.required)
      ImGui::TextDisabled("default %s, now %s", toText(parameter.defaultValue).c_str(),
                          toText(*value).c_str());
  }
  if (!parameter.source.empty()) ImGui::TextDisabled("%s", parameter.source.c_str());
  if (parameter.minimum && parameter.allowed.empty()) ImGui::TextDisabled("Ctrl+click to type a value");
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

/// Text that a user edits; applied with Enter or when the field loses focus.
bool editText(const char* id, std::string& text) {
  // ImGui keeps the text while it is edited; this is what it starts from.
  std::array<char, 1024> buffer{};
  std::strncpy(buffer.data(), text.c_str(), buffer.size() - 1);
  ImGui::InputText(id, buffer.data(), buffer.size());
  if (!ImGui::IsItemDeactivatedAfterEdit()) return false;
  text = buffer.data();
  return true;
}

/// One of `items`, shown as textOf() gives it; returns the item if another one was chosen.
template <class Item>
std::optional<ParameterValue> itemChooser(const std::vector<Item>& items, const Item& now,
                                          const std::function<std::string(const Item&)>& textOf,
                                          const std::function<std::string(const Item&)>& about,
                                          const std::function<void(const Item&)>& noteItem) {
  std::optional<ParameterValue> next;
  if (!ImGui::BeginCombo("##value", textOf(now).c_str(), ImGuiComboFlags_HeightLarge)) return next;
  for (const Item& item : items) {
    if (ImGui::Selectable(textOf(item).c_str(), item == now) && item != now) next = item;
    noteItem(item);
    if (const std::string text = about(item); !text.empty() && ImGui::IsItemHovered())
      ImGui::SetTooltip("%s", text.c_str());
    if (item == now) ImGui::SetItemDefaultFocus();
  }
  ImGui::EndCombo();
  return next;
}

/// A slider over the declared range; `format` of printf for one number.
template <class Number>
std::optional<ParameterValue> slider(const Parameter& parameter, ImGuiDataType type, Number value,
                                     const std::string& format) {
  const auto low = static_cast<Number>(*parameter.minimum), high = static_cast<Number>(*parameter.maximum);
  if (!ImGui::SliderScalar("##value", type, &value, &low, &high, format.c_str(), sliderFlags(parameter)))
    return {};
  return value;
}

/// The control itself; returns the new value if the user changed it. Items of an open list are recorded as
/// "NAME/ITEM".
std::optional<ParameterValue> control(const Parameter& parameter, const ParameterValue& now,
                                      const std::string& name, ControlMap& places) {
  const std::string unit = parameter.unit.empty() ? "" : " " + parameter.unit;
  switch (parameter.type) {
    case ParameterType::Boolean: {
      bool on = std::get<bool>(now);
      return ImGui::Checkbox("##value", &on) ? std::optional<ParameterValue>(on) : std::nullopt;
    }
    case ParameterType::Integer:
      if (!parameter.allowed.empty())
        return itemChooser<int64_t>(
            parameter.allowed, std::get<int64_t>(now),
            [&](const int64_t& number) { return std::to_string(number) + unit; },
            [](const int64_t&) { return std::string(); },
            [&](const int64_t& number) { places.note(name + "/" + std::to_string(number)); });
      return slider<int64_t>(parameter, ImGuiDataType_S64, std::get<int64_t>(now), "%lld" + escaped(unit));
    case ParameterType::Real:
      return slider<double>(parameter, ImGuiDataType_Double, std::get<double>(now), "%.5g" + escaped(unit));
    case ParameterType::Choice:
      return itemChooser<std::string>(
          parameter.choices, std::get<std::string>(now), [](const std::string& item) { return item; },
          [&](const std::string& item) {
            const Alternative* alternative = findAlternative(parameter, item);
            return alternative ? alternative->description : std::string();
          },
          [&](const std::string& item) { places.note(name + "/" + item); });
    case ParameterType::Text:
    case ParameterType::File: {
      std::string text = std::get<std::string>(now);
      return editText("##value", text) ? std::optional<ParameterValue>(text) : std::nullopt;
    }
    case ParameterType::Group:
      break;
  }
  return {};
}

/// The rows of a table, one for each parameter that exists.
class ParameterRows {
 public:
  ParameterRows(const std::string& prefix, const Entry& entry, ControlMap& places)
      : prefix_(prefix), entry_(entry), places_(places) {}

  void build(const std::vector<Parameter>& declared, const std::string& above) {
    for (const Parameter& parameter : declared) {
      const std::string path = joinPath(above, parameter.name);
      ImGui::PushID(parameter.name.c_str());
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::AlignTextToFramePadding();
      if (parameter.type == ParameterType::Group)
        group(parameter, path);
      else
        valueRow(parameter, path);
      ImGui::PopID();
    }
  }
  const std::optional<ParameterChange>& change() const { return change_; }

 private:
  bool anyGivenBelow(const std::string& path) const {
    return std::any_of(entry_.given.begin(), entry_.given.end(),
                       [&](const auto& given) { return given.first.rfind(path + ".", 0) == 0; });
  }

  /// Groups and choices within others, and longer lists of details, are rarely needed, unless something in
  /// them is not at its default.
  bool startsOpen(const Parameter& parameter, const std::string& path, size_t parameters) const {
    constexpr size_t kFewDetails = 2;
    const bool within = path.find('.') != std::string::npos;
    const bool few = parameter.type == ParameterType::Group || parameters <= kFewDetails;
    return (!within && few) || entry_.given.count(path) != 0 || anyGivenBelow(path);
  }

  void group(const Parameter& parameter, const std::string& path) {
    ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanFullWidth;
    if (startsOpen(parameter, path, parameter.alternatives.at(0).parameters.size()))
      flags |= ImGuiTreeNodeFlags_DefaultOpen;
    const bool open = ImGui::TreeNodeEx(parameter.name.c_str(), flags);
    places_.note(joinPath(prefix_, path));
    tooltip(path, parameter, nullptr);
    if (!open) return;
    build(parameter.alternatives.at(0).parameters, path);
    ImGui::TreePop();
  }

  /// The name, dimmed at the default; with an arrow that folds the details of what was chosen. True if these
  /// are open.
  bool nameOf(const Parameter& parameter, const std::string& path, const Alternative* chosen) {
    const ImGuiCol colour = entry_.given.count(path) != 0 ? ImGuiCol_Text : ImGuiCol_TextDisabled;
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(colour));
    bool open = true;
    if (!chosen) {
      ImGui::TextUnformatted(parameter.name.c_str());
    } else {
      // Each alternative opens and closes by itself.
      ImGui::PushID(chosen->name.c_str());
      ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_NoTreePushOnOpen;
      if (startsOpen(parameter, path, chosen->parameters.size())) flags |= ImGuiTreeNodeFlags_DefaultOpen;
      open = ImGui::TreeNodeEx(parameter.name.c_str(), flags);
      places_.note(joinPath(prefix_, path) + ".fold");
      ImGui::PopID();
    }
    ImGui::PopStyleColor();
    return open;
  }

  void valueRow(const Parameter& parameter, const std::string& path) {
    const std::string name = joinPath(prefix_, path);
    const ParameterValue& now = valueAt(entry_, path, parameter);
    const bool given = entry_.given.count(path) != 0;
    const Alternative* chosen = parameter.type == ParameterType::Choice
                                    ? findAlternative(parameter, std::get<std::string>(now))
                                    : nullptr;
    const bool hasDetails = chosen && !chosen->parameters.empty();
    const bool open = nameOf(parameter, path, hasDetails ? chosen : nullptr);
    tooltip(path, parameter, &now);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1.0F);
    if (const std::optional<ParameterValue> next = control(parameter, now, name, places_)) {
      try {
        change_ = {path, validate(parameter, *next, name)};
      } catch (const Error&) {
        // Typed text that is not a value: the old value stays, the range is in the tooltip.
      }
    }
    places_.note(name);
    tooltip(path, parameter, &now);
    ImGui::TableNextColumn();
    if (given && !parameter.required) {
      if (ImGui::Button("x", {ImGui::GetFrameHeight(), 0.0F})) change_ = {path, std::nullopt};
      places_.note(name + ".default");
      if (ImGui::IsItemHovered())
        ImGui::SetTooltip("back to the default, %s", toText(parameter.defaultValue).c_str());
    }
    if (!hasDetails || !open) return;
    ImGui::Indent();
    build(chosen->parameters, path);
    ImGui::Unindent();
  }

  const std::string& prefix_;
  const Entry& entry_;
  ControlMap& places_;
  std::optional<ParameterChange> change_;
};

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

std::optional<ParameterChange> parameterControls(const std::string& prefix,
                                                 const std::vector<Parameter>& declared, const Entry& entry,
                                                 ControlMap& places) {
  ParameterRows rows(prefix, entry, places);
  ImGui::PushStyleVar(ImGuiStyleVar_IndentSpacing, 0.8F * ImGui::GetFontSize());
  if (ImGui::BeginTable((prefix + "##parameters").c_str(), 3, ImGuiTableFlags_SizingStretchProp)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.42F);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.58F);
    ImGui::TableSetupColumn("back", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFrameHeight());
    rows.build(declared, {});
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  return rows.change();
}

}  // namespace limen::viewer
