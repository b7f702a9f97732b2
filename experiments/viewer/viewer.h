// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/viewer/camera_control.h"
#include "experiments/viewer/choices.h"
#include "experiments/viewer/controls.h"
#include "experiments/viewer/judge_thread.h"
#include "experiments/viewer/path_recorder.h"
#include "experiments/viewer/render_thread.h"
#include "experiments/viewer/saved_views.h"
#include "experiments/viewer/ui_texture.h"
#include "perception/vision/display.h"
#include "renderer/window/ui_surface.h"

namespace limen::viewer {

struct ViewerOptions {
  Choices choices;
  std::string resultsFolder = "results/viewer";
  std::string shaderRoot;  ///< source tree whose shaders are watched; "": none
  perception::DisplayProfile display;
};

/// How pictures stand beside each other. The second picture is that of the second technique, or the reference
/// where there is none.
enum class Arrangement { First, Second, SideBySide, Split, Flicker, ErrorMap, Overlay };

/// The viewer without its window: what is chosen, what is shown, and the threads that make it. Its calls come
/// from one thread, with the surface's context current.
class Viewer {
 public:
  /// `wake` is called from other threads when takeResults() has something to take. Throws Error: no
  /// OpenGL 4.5, unknown names.
  Viewer(window::UiSurface& surface, ViewerOptions options, std::function<void()> wake);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Takes what the threads have made; true if something on screen changes.
  bool takeResults();
  /// One frame of the interface, in calls to ImGui; `secondsPassed` since the last one.
  void build(double secondsPassed);
  /// Something moves by itself: frames are wanted one after the other.
  bool animated() const;
  /// All that was asked for is on screen, the reference included.
  bool atRest() const;

  const Choices& choices() const { return choices_; }
  /// As if the controls had been used.
  void choose(Choices choices);
  const ControlMap& controls() const { return controls_; }
  const std::optional<RenderResult>& shown() const { return shown_; }
  const std::optional<JudgeResult>& judged() const { return judged_; }
  const std::vector<std::string>& messages() const { return messages_; }
  int64_t framesRendered() const { return render_.frames(); }
  const JudgeThread& judge() const { return judge_; }
  Arrangement arrangement = Arrangement::First;

  /// What is to be predicted of a person's seeing the picture.
  void predict(Overlay overlay);

  /// The driver's words about changed shaders that it refused; "" if there are none.
  const std::string& shaderFailure() const { return shaderFailure_; }
  /// What the keys K and P do; they return the paths written, "" where that failed (see messages()).
  std::string keepDescriptor();
  std::string savePictures();

 private:
  friend class Panes;
  friend class PicturePane;

  void ask();
  void recordTimes();
  void askJudge();
  void say(const std::string& message);
  /// A view of the user's own, in place of the scene's path.
  void setCamera(const scene::Camera& camera);
  /// The same while a hand is on it.
  void moveTo(const scene::Camera& camera);
  /// Where the camera is, with what has been asked for and is not on screen yet.
  scene::Camera cameraNow() const;
  std::string viewsFile() const;
  void readViews();
  void saveViewNow(const std::string& name);
  void goTo(const SavedView& view);
  void toggleRecording();
  void record(double secondsPassed);
  /// Their controls.
  void views();
  void setTime(double timeS);
  void dropCamera();
  std::shared_ptr<const ScreenPicture> secondPicture() const;
  void handleKeys();
  void play(double secondsPassed);
  double aspect() const;
  double durationS() const;  ///< of the camera path that is there, 0 for a still camera

  window::UiSurface& surface_;
  ViewerOptions options_;
  RenderThread render_;
  JudgeThread judge_;
  gl::DeviceInfo device_;

  Choices choices_, asked_;
  uint64_t number_ = 0, judgedNumber_ = 0;
  bool judgePending_ = false;
  RenderRequest request_;  // the last one
  std::string view_;       // debug view of the first technique, "": product
  std::optional<glm::ivec2> pickedPx_;
  bool moving_ = false, flying_ = false, continuous_ = false, panesHidden_ = false;
  Overlay overlay_ = Overlay::None;
  std::string displayName_, mapName_ = "absolute_error";

  std::optional<RenderResult> shown_;
  std::optional<JudgeResult> judged_;
  // Of the first technique, latest last: the whole frame under its own name, "frame".
  std::map<std::string, std::deque<float>> passMs_;
  std::vector<std::string> messages_;
  std::string shaderFailure_;

  // The path of the camera.
  bool playing_ = false;
  double timeS_ = 0.0, flickerHz_ = 2.0, clockS_ = 0.0;
  float splitAt_ = 0.5F;
  double zoom_ = 0.0;  // screen pixels for one of the picture; 0: as fits
  glm::vec2 panPx_{0.0F};

  std::vector<SavedView> views_;
  std::array<char, 128> viewName_{};
  std::optional<PathRecorder> recorder_;
  double recordedS_ = 0.0;

  // A drag in the picture.
  scene::Camera dragFrom_;
  glm::vec2 dragStartPx_{0.0F}, panFrom_{0.0F};
  bool splitHeld_ = false;

  ControlMap controls_;
  UiTexture first_, second_, map_, painted_;
};

}  // namespace limen::viewer
