// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/viewer/controls.h"
#include "experiments/viewer/evaluation_thread.h"
#include "experiments/viewer/path_recorder.h"
#include "experiments/viewer/picture_writer.h"
#include "experiments/viewer/render_thread.h"
#include "experiments/viewer/viewer_command.h"
#include "experiments/viewer/viewer_state.h"
#include "perception/vision/display.h"
#include "renderer/window/ui_surface.h"

namespace limen::viewer {

class Interface;

struct ViewerOptions {
  ViewSetup setup;
  std::string resultsFolder = "results/viewer";
  std::string shaderRoot;  ///< source tree whose shaders are watched; "": none
  perception::DisplayProfile display;
};

/// The viewer without its window: the state that the interface shows, the threads that render and evaluate,
/// and the commands that change the state. Its calls come from one thread, with the surface's context
/// current.
class Viewer {
 public:
  /// `wake` is called from other threads when takeResults() has something to take. Throws Error: no
  /// OpenGL 4.5, unknown names.
  Viewer(window::UiSurface& surface, ViewerOptions options, std::function<void()> wake);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Takes the threads' results; true if something on screen changes.
  bool takeResults();
  /// One frame of the interface, in calls to ImGui, and the commands it issues; `secondsPassed` since the
  /// last one.
  void build(double secondsPassed);
  /// Whether something moves by itself, so that frames are needed continuously.
  bool animated() const;
  /// Whether everything requested is on screen, including the reference.
  bool atRest() const;

  /// As if the interface had issued it. Errors become messages.
  void execute(const ViewerCommand& command);
  /// Replaces the whole setup. Throws Error, nothing changed, if it is not valid.
  void show(ViewSetup setup);

  const ViewerState& state() const { return state_; }
  const ControlMap& controls() const { return controls_; }
  const EvaluationThread& evaluation() const { return evaluation_; }
  int64_t framesRendered() const { return render_.frames(); }

  /// What the key K does; returns the path written, "" if that failed (see ViewerState::messages).
  std::string exportDescriptor();
  /// What the key P does: the files are encoded and written in a thread of their own. A message tells when
  /// they are complete; ViewerState::saving until then.
  void savePictures();

  /// Asks all threads to end, writes the pictures still to be saved, and waits at most `patience` for the
  /// rest. False: a frame or reference cannot be interrupted, and the destructor would wait for it.
  bool close(std::chrono::milliseconds patience);

 private:
  void requestPicture();
  void requestEvaluation();
  void recordTimes();
  void say(const std::string& message);
  void updateMoving();

  void run(const command::ChooseEntry& command);
  void run(const command::SetParameter& command);
  void run(const command::CopyToSecond& command);
  void run(const command::SwapTechniques& command);
  void run(const command::SetPictureSize& command);
  void run(const command::ShowDebugView& command);
  void run(const command::Arrange& command);
  void run(const command::Predict& command);
  void run(const command::ChooseDisplay& command);
  void run(const command::ChooseErrorMap& command);
  void run(const command::MeasureContinuously& command);
  void run(const command::PickPixel& command);
  void run(const command::MoveCamera& command);
  void run(const command::ResetCamera& command);
  void run(const command::FrameScene& command);
  void run(const command::SaveView& command);
  void run(const command::RecallView& command);
  void run(const command::RemoveView& command);
  void run(const command::ToggleRecording& command);
  void run(const command::TogglePlayback& command);
  void run(const command::SetTime& command);
  void run(const command::ExportDescriptor& command);
  void run(const command::SavePictures& command);
  void run(const command::DismissShaderFailure& command);
  void run(const command::TogglePanes& command);

  /// A camera set by the user, in place of the scene's path.
  void setCamera(const scene::Camera& camera);
  /// Where the camera is, including moves that are not on screen yet.
  scene::Camera currentCamera() const;
  void setTime(double timeS);
  void play(double secondsPassed);
  void record(double secondsPassed);
  std::string viewsFile() const;
  void readViews();

  window::UiSurface& surface_;
  RenderThread render_;
  EvaluationThread evaluation_;
  PictureWriter writer_;
  ViewerState state_;
  std::unique_ptr<Interface> interface_;
  CommandQueue commands_;
  ControlMap controls_;
  ParameterMemory memory_;

  RenderRequest request_;  // the last one
  uint64_t number_ = 0, evaluatedNumber_ = 0;
  bool evaluationPending_ = false;
  bool moving_ = false, flying_ = false;  // a control or the camera is held; keys move it
  std::optional<PathRecorder> recorder_;
  double recordedS_ = 0.0;
};

}  // namespace limen::viewer
