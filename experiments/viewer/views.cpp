// SPDX-License-Identifier: BSD-3-Clause
// Where the camera was worth keeping: named views and recorded paths.
#include <imgui.h>

#include <array>
#include <cstring>
#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/viewer/saved_views.h"
#include "experiments/viewer/viewer.h"
#include "renderer/scene/camera_path_file.h"
#include "renderer/scene/placement.h"
#include "renderer/scene/camera_text.h"

namespace limen::viewer {
namespace {

/// Samples of a recorded path are so far apart.
constexpr double kRecordIntervalS = 1.0 / 30.0;

}  // namespace

std::string Viewer::viewsFile() const { return options_.resultsFolder + "/views.yaml"; }

void Viewer::readViews() {
  try {
    views_ = readSavedViews(viewsFile());
  } catch (const std::exception& error) {
    say(error.what());
  }
}

void Viewer::saveViewNow(const std::string& name) {
  try {
    std::filesystem::create_directories(options_.resultsFolder);
    saveView(viewsFile(), {name, choices_.scene.name, scene::toText(cameraNow())});
    readViews();
    say("view '" + name + "' saved in " + viewsFile());
  } catch (const std::exception& error) {
    say(error.what());
  }
}

void Viewer::goTo(const SavedView& view) {
  if (view.scene != choices_.scene.name) choices_.scene = {view.scene, {}};
  setCamera(scene::parseCamera(view.camera));
}

void Viewer::toggleRecording() {
  if (!recorder_) {
    recorder_.emplace(kRecordIntervalS);
    recordedS_ = 0.0;
    say("recording the camera; press again to end");
    return;
  }
  try {
    recorder_->add(recordedS_, cameraNow());
    const scene::CameraPath path = recorder_->path();
    recorder_.reset();
    if (path.keys.size() < 2) throw Error("the camera did not move while it was recorded");
    std::filesystem::create_directories(options_.resultsFolder);
    std::filesystem::path file;
    for (int number = 1; file.empty() || std::filesystem::exists(file); ++number)
      file = std::filesystem::absolute(options_.resultsFolder) / ("path_" + std::to_string(number) + ".yaml");
    scene::writeCameraPath(file.string(), path);
    dropCamera();
    scene::setCamera(choices_.scene.given, scene::RecordedPath{{file.string()}});
    say("a path of " + std::to_string(path.keys.size()) + " keys recorded in " + file.string());
  } catch (const std::exception& error) {
    recorder_.reset();
    say(error.what());
  }
}

void Viewer::record(double secondsPassed) {
  if (!recorder_) return;
  recordedS_ += secondsPassed;
  recorder_->add(recordedS_, cameraNow());
}

void Viewer::views() {
  if (ImGui::Button(recorder_ ? "end the recording" : "record a path")) toggleRecording();
  controls_.note("camera.record");
  ImGui::SetNextItemWidth(-6.0F * ImGui::GetFontSize());
  ImGui::InputTextWithHint("##view name", "name of this view", viewName_.data(), viewName_.size());
  controls_.note("camera.view_name");
  ImGui::SameLine();
  const bool named = viewName_[0] != '\0';
  if (ImGui::Button("save view") && named) saveViewNow(viewName_.data());
  controls_.note("camera.save_view");
  for (size_t i = 0; i < views_.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::SmallButton(views_[i].name.c_str())) {
      try {
        goTo(views_[i]);
      } catch (const std::exception& error) {
        say(error.what());
      }
    }
    controls_.note("camera.view." + views_[i].name);
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("%s\n%s", views_[i].scene.c_str(), views_[i].camera.c_str());
    ImGui::SameLine();
    const bool remove = ImGui::SmallButton("x");
    ImGui::PopID();
    if (!remove) continue;
    try {
      removeView(viewsFile(), views_[i].name);
    } catch (const std::exception& error) {
      say(error.what());
    }
    readViews();
    break;
  }
}

}  // namespace limen::viewer
