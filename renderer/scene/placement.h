// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <variant>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/scene/scene.h"

namespace limen::scene {

/// The scene's own camera path.
struct BuiltInCamera {
  static constexpr const char *kKind = "built_in", *kSummary = "the scene's own";
  double timeS = 0.0;  ///< position on the path
  static const SettingsTable<BuiltInCamera>& table();
};

/// A still view, in the units of the built world: `scale` and `offset` do not move it.
struct StillView {
  static constexpr const char *kKind = "view", *kSummary = "a still view in place of the scene's own";
  std::string text;  ///< see camera_text.h
  static const SettingsTable<StillView>& table();
  void check() const;
};

/// A recorded path, in the units of the built world: `scale` and `offset` do not move it.
struct RecordedPath {
  static constexpr const char *kKind = "path", *kSummary = "a camera path from a file";
  FilePath file;       ///< see camera_path_file.h
  double timeS = 0.0;  ///< position on the path
  static const SettingsTable<RecordedPath>& table();
  /// Reads the file.
  void check() const;
};

using CameraChoice = std::variant<BuiltInCamera, StillView, RecordedPath>;

enum class LightShapeChoice { AsBuilt, Rectangle, Disc, Polygon };
constexpr EnumNames<LightShapeChoice, 4> enumNames(LightShapeChoice) {
  return {{{{LightShapeChoice::AsBuilt, "as_built"},
            {LightShapeChoice::Rectangle, "rectangle"},
            {LightShapeChoice::Disc, "disc"},
            {LightShapeChoice::Polygon, "polygon"}}}};
}

struct EmissionAsBuilt {
  static constexpr const char *kKind = "as_built", *kSummary = "the scene's own";
};

struct EmissionPicture {
  static constexpr const char *kKind = "picture", *kSummary = "an image file";
  FilePath file;   ///< see light_picture.h
  int cells = 16;  ///< per side
  static const SettingsTable<EmissionPicture>& table();
};

/// What lights emit over their extents.
using EmissionChoice = std::variant<EmissionAsBuilt, EmissionPicture>;

/// Settings of every scene: position and scale of its world, its light, and camera.
struct PlacementSettings {
  double scale = 1.0;      ///< of the whole world, about the origin
  double offset = 0.0;     ///< moves the world by this many of its own diagonals along (1,1,1)/sqrt(3)
  double lightSize = 1.0;  ///< multiplies the light's extents
  LightShapeChoice lightShape = LightShapeChoice::AsBuilt;
  EmissionChoice lightEmission;
  CameraChoice camera;
  static const SettingsTable<PlacementSettings>& table();
};

/// Applies the chosen camera to a scene's own path, the last step of buildScene(). A path is moved so
/// that its time 0 is the chosen position: camera.at(0) is the camera of a still picture. Throws Error on a
/// view or path that cannot be used.
CameraPath cameraFor(const CameraPath& builtIn, const CameraChoice& choice);

/// Position on the path [s]; 0 of a still view.
double timeOf(const CameraChoice& choice);

/// Removes or replaces the camera settings in a scene's values, by path.
void clearCamera(std::map<std::string, ParameterValue>& values);
void setCamera(std::map<std::string, ParameterValue>& values, const CameraChoice& choice);

/// Applies the settings to a scene as its builder made it. Throws Error, naming `where` or the file.
void place(Scene& scene, const PlacementSettings& settings, const std::string& where);

}  // namespace limen::scene
