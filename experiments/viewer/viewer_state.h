// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/viewer/evaluation_thread.h"
#include "experiments/viewer/render_thread.h"
#include "experiments/viewer/saved_views.h"
#include "experiments/viewer/setup.h"
#include "experiments/viewer/viewer_command.h"
#include "perception/vision/display.h"

namespace limen::viewer {

/// Everything that the interface shows: plain data that the panes read and only the viewer changes.
struct ViewerState {
  // What was requested.
  ViewSetup setup;
  std::string debugView;  ///< of the first technique, in place of its product; "": the product
  std::optional<glm::ivec2> pickedPx;
  Arrangement arrangement = Arrangement::First;
  Overlay overlay = Overlay::None;
  std::string errorMap = "absolute_error";  ///< the map shown
  perception::DisplayProfile display;
  std::string displayName;
  bool continuous = false;  ///< frames are rendered and timed continuously
  bool panesHidden = false;
  std::string resultsFolder, shaderRoot;

  // The camera and its path.
  scene::Camera camera;  ///< as requested; the picture may not show it yet
  double timeS = 0.0;    ///< on the path
  bool playing = false, recording = false;
  std::vector<SavedView> views;

  // Results from the threads.
  gl::DeviceInfo device;
  std::optional<RenderResult> shown;
  std::optional<EvaluationResult> evaluated;
  /// Of the first technique, latest last: each pass, and the whole frame as "frame"; ms.
  std::map<std::string, std::deque<float>> passMs;
  std::vector<std::string> messages;  ///< latest last
  std::string shaderFailure;          ///< the driver's messages about changed shaders that it refused
  bool saving = false;                ///< pictures are being written
  bool atRest = false;                ///< everything requested is on screen

  double aspect() const { return double(setup.sizePx.x) / setup.sizePx.y; }
  /// Of the camera path, s; 0 for a still camera.
  double durationS() const { return shown ? shown->path.durationS() : 0.0; }
  /// Null if nothing was rendered.
  const Rendered* rendered(size_t index) const {
    return shown && index < shown->rendered.size() ? &shown->rendered[index] : nullptr;
  }
  /// The second technique's, otherwise the reference's.
  std::shared_ptr<const ScreenPicture> secondPicture() const {
    if (const Rendered* second = rendered(1)) return second->picture;
    return evaluated ? evaluated->referencePicture : nullptr;
  }
};

}  // namespace limen::viewer
