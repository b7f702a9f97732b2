// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/panes.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "experiments/viewer/viewer.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings;
const ImVec4 kWrong(1.0F, 0.45F, 0.35F, 1.0F);

void wrong(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, kWrong);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

std::string bytesText(int64_t bytes) {
  const double mb = 1e-6 * static_cast<double>(bytes);
  char text[32];
  std::snprintf(text, sizeof text, mb < 10.0 ? "%.2f MB" : "%.0f MB", mb);
  return text;
}

/// A name in the first column, which gives way, and figures in the others, which do not.
bool figureTable(const char* id, int columns) {
  if (!ImGui::BeginTable(id, columns, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return false;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

/// A name that may be too long for its column.
void label(const std::string& text) {
  ImGui::TextUnformatted(text.c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
}

bool heading(const char* text) { return ImGui::CollapsingHeader(text, ImGuiTreeNodeFlags_DefaultOpen); }

/// A number as figures show it: enough digits to compare by eye; copying gives all of them.
std::string figureText(double value) {
  if (std::isnan(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

std::string aboutScene(const std::string& name) {
  const scene::SceneInfo* info = scene::SceneRegistry::instance().find(name);
  return info ? info->summary + (info->source.empty() ? "" : "\n" + info->source) : "";
}

std::string aboutTechnique(const std::string& name, const std::set<std::string>& traits) {
  const techniques::TechniqueInfo* info = techniques::TechniqueRegistry::instance().find(name);
  if (!info) return {};
  std::string out = info->summary + (info->source.empty() ? "" : "\n" + info->source);
  for (const std::string& need : info->needs)
    if (!traits.empty() && !traits.count(need))
      out += "\nneeds a scene with " + need + ", which this one has not";
  return out;
}

}  // namespace

Panes::Panes(Viewer& viewer) : viewer_(viewer) {
  const glm::vec2 size(viewer_.surface_.sizePx());
  const float em = viewer_.surface_.fonts().bodyPx;
  // The picture gets what is left, and at least half of the width.
  leftPx_ = std::min(std::max(0.25F * size.x, 22.0F * em), 0.27F * size.x + 4.0F * em);
  rightPx_ = std::min(std::max(0.24F * size.x, 24.0F * em), 0.26F * size.x + 4.0F * em);
  bottomPx_ = std::round(2.0F * em);
}

void Panes::build() {
  if (!viewer_.panesHidden_) {
    choices();
    figures();
  }
  messages();
}

void Panes::choices() {
  const glm::vec2 size(viewer_.surface_.sizePx());
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({leftPx_, size.y - bottomPx_});
  ImGui::Begin("choices", nullptr, kFixed);
  scene();
  technique("Technique", "technique", false);
  reference();
  technique("Second technique", "second", true);
  camera();
  output();
  ImGui::End();
}

void Panes::scene() {
  if (!heading("Scene")) return;
  Choices& choices = viewer_.choices_;
  std::string name = choices.scene.name;
  if (nameChooser("scene", scene::SceneRegistry::instance().names(), name, aboutScene, viewer_.controls_)) {
    choices.scene = {name, {}};
    viewer_.timeS_ = 0.0;
  }
  parameterControls("scene", sceneParameters(choices.scene.name), choices.scene, viewer_.controls_);
  int side[2] = {choices.sizePx.x, choices.sizePx.y};
  ImGui::SetNextItemWidth(-8.0F * ImGui::GetFontSize());
  ImGui::InputInt2("picture, px", side);
  viewer_.controls_.note("scene.picture");
  if (ImGui::IsItemDeactivatedAfterEdit())
    choices.sizePx = glm::clamp(glm::ivec2(side[0], side[1]), glm::ivec2(1), glm::ivec2(8192));
  if (viewer_.shown_ && !viewer_.shown_->error.empty()) wrong(viewer_.shown_->error);
  if (viewer_.shown_ && viewer_.shown_->error.empty())
    ImGui::TextDisabled("%zu triangles", viewer_.shown_->triangles);
}

void Panes::technique(const std::string& title, const std::string& prefix, bool second) {
  if (!ImGui::CollapsingHeader(title.c_str(), second ? 0 : ImGuiTreeNodeFlags_DefaultOpen)) {
    viewer_.controls_.note(prefix + ".heading");
    return;
  }
  viewer_.controls_.note(prefix + ".heading");
  ImGui::PushID(prefix.c_str());
  Choices& choices = viewer_.choices_;
  const std::set<std::string> traits = viewer_.shown_ ? viewer_.shown_->traits : std::set<std::string>{};
  std::vector<std::string> names =
      second ? comparable(choices.technique.name) : techniques::TechniqueRegistry::instance().names();
  if (second) names.insert(names.begin(), "");
  std::string name = second ? (choices.other ? choices.other->name : "") : choices.technique.name;
  if (nameChooser(
          prefix, names, name, [&](const std::string& of) { return aboutTechnique(of, traits); },
          viewer_.controls_)) {
    viewer_.view_.clear();
    if (second) {
      choices.other = name.empty() ? std::nullopt : std::optional(Chosen{name, {}});
      if (choices.other && viewer_.arrangement == Arrangement::First)
        viewer_.arrangement = Arrangement::Split;
    } else {
      const bool otherKind = comparable(name) != comparable(choices.technique.name);
      choices.technique = {name, {}};
      if (otherKind) choices.reference = usualReference(name), choices.other.reset();
    }
  }
  if (second) {
    if (ImGui::Button("same as the first")) choices.other = choices.technique;
    viewer_.controls_.note("second.copy");
    ImGui::SameLine();
    if (ImGui::Button("swap") && choices.other) std::swap(choices.technique, *choices.other);
    viewer_.controls_.note("second.swap");
  }
  if (!second || choices.other) {
    Chosen& chosen = second ? *choices.other : choices.technique;
    parameterControls(prefix, techniqueParameters(chosen.name), chosen, viewer_.controls_);
    const size_t index = second ? 1 : 0;
    if (viewer_.shown_ && viewer_.shown_->rendered.size() > index) {
      const Rendered& one = viewer_.shown_->rendered[index];
      if (!one.error.empty()) wrong(one.error);
      if (!one.failure.empty()) wrong(one.failure);
      for (const std::string& remark : one.remarks) ImGui::TextWrapped("- %s", remark.c_str());
      if (!second && !one.views.empty()) {
        std::vector<std::string> views = one.views;
        views.insert(views.begin(), "");
        ImGui::TextDisabled("show in place of the product");
        nameChooser(
            "view", views, viewer_.view_,
            [](const std::string&) { return std::string("an image from within the technique"); },
            viewer_.controls_);
        if (one.viewWhite > 0.0) ImGui::TextDisabled("brightest: %s", figureText(one.viewWhite).c_str());
      }
    }
  }
  ImGui::PopID();
}

void Panes::reference() {
  if (!heading("Reference")) return;
  ImGui::PushID("reference");
  Choices& choices = viewer_.choices_;
  std::vector<std::string> names = comparable(choices.technique.name);
  names.insert(names.begin(), "");
  std::string name = choices.reference ? choices.reference->name : "";
  const std::set<std::string> traits = viewer_.shown_ ? viewer_.shown_->traits : std::set<std::string>{};
  if (nameChooser(
          "reference", names, name, [&](const std::string& of) { return aboutTechnique(of, traits); },
          viewer_.controls_))
    choices.reference = name.empty() ? std::nullopt : std::optional(Chosen{name, {}});
  if (choices.reference)
    parameterControls("reference", techniqueParameters(choices.reference->name), *choices.reference,
                      viewer_.controls_);
  if (viewer_.judged_ && !viewer_.judged_->error.empty()) wrong(viewer_.judged_->error);
  ImGui::PopID();
}

void Panes::camera() {
  if (!heading("Camera")) return;
  ImGui::TextDisabled(
      "drag: orbit; right drag with W A S D Q E: fly;\nmiddle drag: pan; wheel: nearer and farther");
  if (ImGui::Button("scene's own (R)")) viewer_.dropCamera();
  viewer_.controls_.note("camera.reset");
  ImGui::SameLine();
  if (ImGui::Button("all in view (F)") && viewer_.shown_)
    viewer_.setCamera(frameAll(viewer_.shown_->camera, viewer_.shown_->bounds, viewer_.aspect()));
  viewer_.controls_.note("camera.all");
  viewer_.views();
  const double duration = viewer_.durationS();
  if (duration <= 0.0) return;
  if (ImGui::Button(viewer_.playing_ ? "pause" : "play")) viewer_.playing_ = !viewer_.playing_;
  viewer_.controls_.note("camera.play");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0F);
  double time = viewer_.timeS_;
  const double zero = 0.0;
  if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &time, &zero, &duration, "%.2f s",
                          ImGuiSliderFlags_AlwaysClamp))
    viewer_.setTime(time);
  viewer_.controls_.note("camera.time");
}

void Panes::output() {
  if (!heading("Keep")) return;
  if (ImGui::Button("descriptor (K)")) viewer_.keepDescriptor();
  viewer_.controls_.note("keep.descriptor");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("what is on screen as a descriptor that limen sweep runs, into %s",
                      viewer_.options_.resultsFolder.c_str());
  ImGui::SameLine();
  if (ImGui::Button("pictures (P)")) viewer_.savePictures();
  viewer_.controls_.note("keep.pictures");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("PNG and EXR of all products");
}

void Panes::figures() {
  const glm::vec2 size(viewer_.surface_.sizePx());
  ImGui::SetNextWindowPos({size.x - rightPx_, 0});
  ImGui::SetNextWindowSize({rightPx_, size.y - bottomPx_});
  ImGui::Begin("figures", nullptr, kFixed);
  times();
  errors();
  costs();
  pixel();
  ImGui::End();
}

void Panes::times() {
  if (!heading("Time and costs")) return;
  ImGui::TextWrapped("%s", viewer_.device_.line().c_str());
  ImGui::Checkbox("measure all the time", &viewer_.continuous_);
  viewer_.controls_.note("times.continuous");
  if (!viewer_.shown_ || viewer_.shown_->rendered.empty()) return;
  const Rendered& first = viewer_.shown_->rendered[0];
  if (first.frameMs >= 0.0) {
    ImGui::Text("%.3f ms %s", first.frameMs, first.onCpu ? "wall" : "GPU");
    for (size_t i = 1; i < viewer_.shown_->rendered.size(); ++i)
      if (viewer_.shown_->rendered[i].frameMs >= 0.0) {
        ImGui::SameLine();
        ImGui::TextDisabled("second %.3f ms", viewer_.shown_->rendered[i].frameMs);
      }
    if (first.onCpu && viewer_.device_.software)
      ImGui::TextDisabled("a CPU renders: compare techniques only");
  }
  const auto history = [&](const std::string& pass, float height) {
    const auto found = viewer_.passMs_.find(pass);
    if (found == viewer_.passMs_.end()) return;
    const std::vector<float> times(found->second.begin(), found->second.end());
    const float most = *std::max_element(times.begin(), times.end());
    ImGui::PlotLines(("##" + pass).c_str(), times.data(), static_cast<int>(times.size()), 0, nullptr, 0.0F,
                     most,
                     {height > 2.0F ? -1.0F : 4.0F * ImGui::GetFontSize(), height * ImGui::GetFontSize()});
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("%s: the last %zu pictures, 0 to %.3g ms", pass.c_str(), times.size(), most);
  };
  history("frame", 3.0F);
  const bool wide = rightPx_ > 22.0F * ImGui::GetFontSize();  // else names are worth more
  if (figureTable("passes", wide ? 4 : 2)) {
    int64_t bytes = 0;
    for (const PassFigure& pass : first.passes) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      label(pass.name);
      ImGui::TableNextColumn();
      if (pass.ms >= 0.0) ImGui::Text("%.3f ms", pass.ms);
      bytes += pass.bytes;
      if (!wide) continue;
      ImGui::TableNextColumn();
      history(pass.name, 1.0F);
      ImGui::TableNextColumn();
      if (pass.bytes > 0) ImGui::TextUnformatted(bytesText(pass.bytes).c_str());
    }
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("held in all");
    ImGui::TableSetColumnIndex(wide ? 3 : 1);
    ImGui::TextDisabled("%s", bytesText(bytes).c_str());
    ImGui::EndTable();
  }
  if (first.prepareMs >= 0.0) ImGui::TextDisabled("prepared in %.2f ms", first.prepareMs);
}

void Panes::costs() {
  if (!viewer_.shown_ || viewer_.shown_->rendered.empty() || viewer_.shown_->rendered[0].counters.empty())
    return;
  if (!heading("Counted")) return;
  const Rendered& first = viewer_.shown_->rendered[0];
  const Rendered* second = viewer_.shown_->rendered.size() > 1 ? &viewer_.shown_->rendered[1] : nullptr;
  if (!figureTable("counters", second ? 3 : 2)) return;
  for (const techniques::Counter& counter : first.counters) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    label(counter.name);
    ImGui::TableNextColumn();
    ImGui::Text("%s %s", figureText(counter.value).c_str(), counter.unit.c_str());
    if (!second) continue;
    ImGui::TableNextColumn();
    for (const techniques::Counter& other : second->counters)
      if (other.name == counter.name) ImGui::TextDisabled("%s", figureText(other.value).c_str());
  }
  ImGui::EndTable();
}

void Panes::errors() {
  if (!heading("Error")) return;
  if (!viewer_.choices_.reference) {
    ImGui::TextDisabled("no reference is chosen");
  } else if (!viewer_.judged_) {
    ImGui::TextDisabled("the reference is being made");
  } else if (viewer_.judged_->error.empty()) {
    const JudgeResult& judged = *viewer_.judged_;
    ImGui::TextDisabled("against %s", viewer_.choices_.reference->name.c_str());
    if (!judged.step.empty()) ImGui::TextColored({1.0F, 0.8F, 0.4F, 1.0F}, "so far: %s", judged.step.c_str());
    if (judged.bound >= 0.0)
      ImGui::TextDisabled("a pixel of it is within %s (99.9 %%)", figureText(judged.bound).c_str());
    const bool two = std::any_of(judged.figures.begin(), judged.figures.end(),
                                 [](const ErrorFigure& figure) { return !std::isnan(figure.other); });
    if (figureTable("errors", two ? 3 : 2)) {
      for (const ErrorFigure& figure : judged.figures) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        label(figure.metric);
        ImGui::TableNextColumn();
        ImGui::Text("%s %s", figureText(figure.value).c_str(), figure.unit.c_str());
        if (!two) continue;
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", figureText(figure.other).c_str());
      }
      ImGui::EndTable();
    }
    if (!judged.maps.empty()) {
      std::vector<std::string> names;
      for (const auto& [name, map] : judged.maps) names.push_back(name);
      if (!judged.maps.count(viewer_.mapName_)) viewer_.mapName_ = names.front();
      ImGui::TextDisabled("map");
      nameChooser(
          "map", names, viewer_.mapName_, [](const std::string&) { return std::string("where errors lie"); },
          viewer_.controls_);
      ImGui::TextDisabled("brightest: %s", figureText(judged.maps.at(viewer_.mapName_).white).c_str());
    }
  }
  int overlay = static_cast<int>(viewer_.overlay_);
  ImGui::SetNextItemWidth(-1.0F);
  if (ImGui::Combo("##overlay", &overlay, "nothing predicted\0threshold map\0popping\0")) {
    viewer_.overlay_ = static_cast<Overlay>(overlay);
    viewer_.arrangement = viewer_.overlay_ == Overlay::None ? Arrangement::First : Arrangement::Overlay;
  }
  viewer_.controls_.note("overlay");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "what a person sees, predicted for the display below:\nluminance increments that stay invisible, or "
        "what "
        "pops when the second picture (else the reference) is replaced");
  if (nameChooser("display", perception::displayPresets(), viewer_.displayName_,
                  &perception::displayPresetReason, viewer_.controls_))
    viewer_.options_.display = perception::displayPreset(viewer_.displayName_);
  if (viewer_.judged_ && !viewer_.judged_->overlayNote.empty())
    ImGui::TextWrapped("%s", viewer_.judged_->overlayNote.c_str());
}

void Panes::pixel() {
  if (!heading("Pixel")) return;
  if (!viewer_.pickedPx_) {
    ImGui::TextDisabled("click into the picture");
    return;
  }
  const glm::ivec2 at = *viewer_.pickedPx_;
  ImGui::Text("x %d, y %d", at.x, at.y);
  const auto row = [](const std::string& name, const std::vector<double>& values) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name.c_str());
    ImGui::TableNextColumn();
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : "  ") + figureText(value);
    ImGui::TextWrapped("%s", text.c_str());
  };
  if (!viewer_.shown_ ||
      !ImGui::BeginTable("pixel", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp))
    return;
  for (size_t i = 0; i < viewer_.shown_->rendered.size(); ++i)
    for (const PickedValues& picked : viewer_.shown_->rendered[i].picked)
      row((i > 0 ? "second " : "") + picked.name, picked.values);
  const auto valuesOf = [&](const Image& image) {
    std::vector<double> values;
    if (at.x < image.width && at.y < image.height)
      for (int c = 0; c < image.channels; ++c) values.push_back(image.at(at.x, at.y, c));
    return values;
  };
  if (viewer_.judged_ && viewer_.judged_->reference) row("reference", valuesOf(*viewer_.judged_->reference));
  if (viewer_.judged_)
    for (const auto& [name, map] : viewer_.judged_->maps) row(name, valuesOf(*map.values));
  ImGui::EndTable();
}

void Panes::messages() {
  const glm::vec2 size(viewer_.surface_.sizePx());
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({0, size.y - bottomPx_});
  ImGui::SetNextWindowSize({size.x, bottomPx_});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.5F * em, 0.3F * em});
  ImGui::Begin("messages", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
  if (!viewer_.atRest()) {
    ImGui::TextColored({1.0F, 0.8F, 0.4F, 1.0F}, "working");
    ImGui::SameLine();
  }
  if (!viewer_.messages_.empty()) ImGui::TextUnformatted(viewer_.messages_.back().c_str());
  if (viewer_.messages_.empty())
    ImGui::TextDisabled(
        "K descriptor, P pictures, R scene's camera, F all in view, Space play, 1 to 7 arrangement, Tab "
        "panes");
  if (ImGui::IsWindowHovered() && viewer_.messages_.size() > 1) {
    ImGui::BeginTooltip();
    for (const std::string& message : viewer_.messages_) ImGui::TextUnformatted(message.c_str());
    ImGui::EndTooltip();
  }
  ImGui::End();
  ImGui::PopStyleVar();
  if (viewer_.shaderFailure_.empty()) return;
  ImGui::SetNextWindowPos({leftPx_ + em, em}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({std::max(size.x - leftPx_ - rightPx_ - 2.0F * em, 20.0F * em), 0.0F});
  ImGui::Begin("shader failure", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  wrong("A changed shader was refused; the one before it goes on running.");
  ImGui::TextWrapped("%s", viewer_.shaderFailure_.c_str());
  if (ImGui::Button("close")) viewer_.shaderFailure_.clear();
  ImGui::End();
}

}  // namespace limen::viewer
