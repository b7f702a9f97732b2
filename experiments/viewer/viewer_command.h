// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/base/enum_names.h"
#include "experiments/base/parameter.h"
#include "experiments/viewer/evaluation_thread.h"
#include "experiments/viewer/saved_views.h"
#include "renderer/scene/scene.h"

namespace limen::viewer {

/// Parts of a ViewSetup that have a name and parameters.
enum class Slot { Scene, Technique, Second, Reference };
constexpr EnumNames<Slot, 4> enumNames(Slot) {
  return {{{{Slot::Scene, "scene"},
            {Slot::Technique, "technique"},
            {Slot::Second, "second"},
            {Slot::Reference, "reference"}}}};
}

/// How pictures are arranged. The second picture is that of the second technique, or the reference if there
/// is none.
enum class Arrangement { First, Second, SideBySide, Split, Flicker, ErrorMap, Overlay };

/// What the interface tells the viewer to do.
namespace command {

/// "": none, where that is possible.
struct ChooseEntry {
  Slot slot;
  std::string name;
};
/// No value: back to the default.
struct SetParameter {
  Slot slot;
  std::string path;
  std::optional<ParameterValue> value;
};
/// The second technique becomes the same as the first.
struct CopyToSecond {};
struct SwapTechniques {};
struct SetPictureSize {
  glm::ivec2 sizePx;
};
/// "": the product.
struct ShowDebugView {
  std::string name;
};
struct Arrange {
  Arrangement arrangement;
};
struct Predict {
  Overlay overlay;
};
/// A preset, for which predictions are made.
struct ChooseDisplay {
  std::string name;
};
struct ChooseErrorMap {
  std::string name;
};
struct MeasureContinuously {
  bool on;
};
/// No pixel: none is picked.
struct PickPixel {
  std::optional<glm::ivec2> px;
};
/// While the mouse or keys move the camera.
struct MoveCamera {
  scene::Camera camera;
  bool flying;  ///< keys are held: it keeps moving
};
/// Back to the scene's own camera.
struct ResetCamera {};
/// Moves back until the whole scene is in view.
struct FrameScene {};
struct SaveView {
  std::string name;
};
struct RecallView {
  SavedView view;
};
struct RemoveView {
  std::string name;
};
/// Begins or ends recording the camera's path.
struct ToggleRecording {};
/// Plays or pauses the camera's path.
struct TogglePlayback {};
struct SetTime {
  double timeS;
};
struct ExportDescriptor {};
struct SavePictures {};
struct DismissShaderFailure {};
struct TogglePanes {};

}  // namespace command

using ViewerCommand =
    std::variant<command::ChooseEntry, command::SetParameter, command::CopyToSecond, command::SwapTechniques,
                 command::SetPictureSize, command::ShowDebugView, command::Arrange, command::Predict,
                 command::ChooseDisplay, command::ChooseErrorMap, command::MeasureContinuously,
                 command::PickPixel, command::MoveCamera, command::ResetCamera, command::FrameScene,
                 command::SaveView, command::RecallView, command::RemoveView, command::ToggleRecording,
                 command::TogglePlayback, command::SetTime, command::ExportDescriptor, command::SavePictures,
                 command::DismissShaderFailure, command::TogglePanes>;

/// Commands of one frame, in the order in which they were given.
class CommandQueue {
 public:
  void push(ViewerCommand command) { commands_.push_back(std::move(command)); }
  std::vector<ViewerCommand> take() { return std::exchange(commands_, {}); }

 private:
  std::vector<ViewerCommand> commands_;
};

}  // namespace limen::viewer
