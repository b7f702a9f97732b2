// SPDX-License-Identifier: BSD-3-Clause
// Camera commands: position, path, recording, saved views.
#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/viewer/camera_control.h"
#include "experiments/viewer/viewer.h"
#include "renderer/scene/camera_path_file.h"
#include "renderer/scene/camera_text.h"
#include "renderer/scene/placement.h"

namespace limen::viewer {
namespace {

/// Between samples of a recorded path.
constexpr double kRecordIntervalS = 1.0 / 30.0;

}  // namespace

void Viewer::setCamera(const scene::Camera& camera) {
  scene::setCamera(state_.setup.scene.given, scene::StillView{scene::toText(camera)});
}

scene::Camera Viewer::currentCamera() const {
  const auto given = state_.setup.scene.given.find("camera.text");
  if (given != state_.setup.scene.given.end()) {
    try {
      return scene::parseCamera(std::get<std::string>(given->second));
    } catch (const Error&) {
      // Typed text that is not a camera: the scene reports it.
    }
  }
  return state_.shown ? state_.shown->path.at(state_.timeS) : scene::Camera{};
}

void Viewer::setTime(double timeS) {
  state_.timeS = timeS;
  std::map<std::string, ParameterValue>& given = state_.setup.scene.given;
  if (given.count("camera.text")) scene::clearCamera(given);
  if (timeS == 0.0)
    given.erase("camera.time_s");
  else
    given["camera.time_s"] = timeS;
}

void Viewer::play(double secondsPassed) {
  if (!state_.playing) return;
  const double duration = state_.durationS();
  if (duration <= 0.0) {
    state_.playing = false;
    return;
  }
  const double timeS = state_.timeS + secondsPassed;
  setTime(timeS > duration ? 0.0 : timeS);
}

void Viewer::record(double secondsPassed) {
  if (!recorder_) return;
  recordedS_ += secondsPassed;
  recorder_->add(recordedS_, currentCamera());
}

std::string Viewer::viewsFile() const { return state_.resultsFolder + "/views.yaml"; }

void Viewer::readViews() {
  try {
    state_.views = readSavedViews(viewsFile());
  } catch (const std::exception& error) {
    say(error.what());
  }
}

void Viewer::run(const command::MoveCamera& command) {
  setCamera(command.camera);
  state_.playing = false;
  moving_ = true;
  flying_ = flying_ || command.flying;
}

void Viewer::run(const command::ResetCamera&) {
  scene::clearCamera(state_.setup.scene.given);
  state_.timeS = 0.0;
}

void Viewer::run(const command::FrameScene&) {
  if (state_.shown) setCamera(frameAll(state_.shown->camera, state_.shown->bounds, state_.aspect()));
}

void Viewer::run(const command::SaveView& command) {
  std::filesystem::create_directories(state_.resultsFolder);
  saveView(viewsFile(), {command.name, state_.setup.scene.name, scene::toText(currentCamera())});
  readViews();
  say("view '" + command.name + "' saved in " + viewsFile());
}

void Viewer::run(const command::RecallView& command) {
  const scene::Camera camera = scene::parseCamera(command.view.camera);
  if (command.view.scene != state_.setup.scene.name)
    run(command::ChooseEntry{Slot::Scene, command.view.scene});
  setCamera(camera);
}

void Viewer::run(const command::RemoveView& command) {
  removeView(viewsFile(), command.name);
  readViews();
}

void Viewer::run(const command::TogglePlayback&) {
  state_.playing = !state_.playing && state_.durationS() > 0.0;
}

void Viewer::run(const command::SetTime& command) { setTime(command.timeS); }

void Viewer::run(const command::ToggleRecording&) {
  state_.recording = !state_.recording;
  if (state_.recording) {
    recorder_.emplace(kRecordIntervalS);
    recordedS_ = 0.0;
    say("recording the camera; press again to stop");
    return;
  }
  recorder_->add(recordedS_, currentCamera());
  const scene::CameraPath path = recorder_->path();
  recorder_.reset();
  if (path.keys.size() < 2) throw Error("the camera did not move during the recording");
  std::filesystem::create_directories(state_.resultsFolder);
  std::filesystem::path file;
  for (int number = 1; file.empty() || std::filesystem::exists(file); ++number)
    file = std::filesystem::absolute(state_.resultsFolder) / ("path_" + std::to_string(number) + ".yaml");
  scene::writeCameraPath(file.string(), path);
  run(command::ResetCamera{});
  scene::setCamera(state_.setup.scene.given, scene::RecordedPath{{file.string()}});
  say("recorded a path of " + std::to_string(path.keys.size()) + " keys in " + file.string());
}

}  // namespace limen::viewer
