// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/placement.h"

#include <cmath>

#include "experiments/base/error.h"
#include "renderer/scene/camera_path_file.h"
#include "renderer/scene/camera_text.h"
#include "renderer/scene/light.h"
#include "renderer/scene/light_picture.h"

namespace limen::scene {
namespace {

constexpr Range kTimes{0.0, 3600.0};
const char* const kTimeHelp = "Position on the camera path; past its end the camera rests";

/// Applies `map` to every position of the world: geometry, lights, cameras.
template <class Map>
void mapWorld(Scene& scene, Map map) {
  for (Mesh* mesh : {&scene.mesh, &scene.coarser}) {
    for (glm::dvec3& position : mesh->positions) position = map(position);
    for (glm::dvec3& target : mesh->morphTargets) target = map(target);
  }
  for (LodObject& object : scene.lodObjects)
    object.bounds = {map(object.bounds.low), map(object.bounds.high)};
  for (AreaLight& light : scene.lights) light.centre = map(light.centre);
  for (Material& material : scene.materials) material.pattern.origin = map(material.pattern.origin);
  for (BicubicPatch& patch : scene.patches)
    for (glm::dvec3& point : patch.points) point = map(point);
  // p -> a p + b of w p: a map of positions is affine here, directions (w = 0) lose the translation.
  const auto mapPoints = [&](std::vector<glm::dvec4>& points) {
    for (glm::dvec4& point : points)
      point = glm::dvec4(point.w == 0.0 ? map(glm::dvec3(point)) - map(glm::dvec3(0.0))
                                        : map(glm::dvec3(point) / point.w) * point.w,
                         point.w);
  };
  mapPoints(scene.surfaces.points);
  for (surfaces::SubdivisionSurface& surface : scene.subdivisions) {
    for (glm::dvec3& point : surface.cage.points) point = map(point);
    for (surfaces::Joint& joint : surface.joints) joint.pivot = map(joint.pivot);
  }
  for (NurbsPart& part : scene.nurbs) mapPoints(part.surface.points);
  for (const auto member : {&surfaces::PatchMotion::sine, &surfaces::PatchMotion::cosine})
    for (glm::dvec3& vector : scene.surfaces.motion.*member) vector = map(vector) - map(glm::dvec3(0.0));
  for (PartMotion& motion : scene.motions) {
    motion.pivot = map(motion.pivot);
    motion.travel = map(motion.travel) - map(glm::dvec3(0.0));
  }
  for (CameraPath::Key& key : scene.camera.keys) {
    key.camera.eye = map(key.camera.eye);
    key.camera.target = map(key.camera.target);
  }
}

/// What the lights of a scene become.
AreaLight changed(AreaLight light, const LightShapeChoice& choice) {
  if (std::holds_alternative<ShapeDisc>(choice)) return withShape(std::move(light), LightShape::Disc);
  if (std::holds_alternative<ShapePolygon>(choice)) return withShape(std::move(light), LightShape::Polygon);
  if (std::holds_alternative<ShapeAsBuilt>(choice)) return light;
  return withShape(std::move(light), LightShape::Rectangle);
}

CameraPath from(CameraPath path, double timeS) {
  if (path.keys.size() > 1)
    for (CameraPath::Key& key : path.keys) key.timeS -= timeS;
  return path;
}

}  // namespace

const SettingsTable<BuiltInCamera>& BuiltInCamera::table() {
  static const SettingsTable<BuiltInCamera> kTable = {
      Binding(&BuiltInCamera::timeS, "time_s", kTimes, "s", kTimeHelp).formerly({"time_s"})};
  return kTable;
}

const SettingsTable<StillView>& StillView::table() {
  static const SettingsTable<StillView> kTable = {
      {&StillView::text, "text",
       "In the built world's units: eye X Y Z target X Y Z [up X Y Z] [fov DEGREES]"}};
  return kTable;
}

void StillView::check() const { parseCamera(text, "text"); }

const SettingsTable<RecordedPath>& RecordedPath::table() {
  static const SettingsTable<RecordedPath> kTable = {
      Binding(&RecordedPath::file, "file", FileIs::Required, "Camera path in the built world's units")
          .formerly({"camera_path"}),
      {&RecordedPath::timeS, "time_s", kTimes, "s", kTimeHelp}};
  return kTable;
}

void RecordedPath::check() const {
  try {
    readCameraPath(file.path);
  } catch (const Error& error) {
    // As one message: each of its lines has its own position in the file.
    throw Error(error.what(), "file");
  }
}

const SettingsTable<ShapePicture>& ShapePicture::table() {
  using S = ShapePicture;
  static const SettingsTable<S> kTable = {
      {&S::file, "file", FileIs::Required,
       "Picture that the light shows to its lit side, in linear radiance; integers are taken as sRGB"},
      {&S::cells,
       "cells",
       {1, 64},
       "cells",
       "Cells per side of the light, each with the picture's mean within it"}};
  return kTable;
}

const SettingsTable<PlacementSettings>& PlacementSettings::table() {
  using S = PlacementSettings;
  static const SettingsTable<S> kTable = {
      {&S::scale, "scale", {1e-6, 1e6}, "", "Scales the whole world about the origin"},
      {&S::offset, "offset", {0.0, 1e6}, "scene diagonals", "Moves the whole world along (1,1,1)"},
      {&S::lightSize,
       "light_size",
       {0.001, 100.0},
       "",
       "Multiplies the light's extents",
       "Schwarz 2009, chapters 3 to 5"},
      {&S::lightShape, "light_shape", "Shape of the light within its extents, and what it shows",
       "Schwarz 2009, section 4.2.2"},
      {&S::camera, "camera", "Camera that looks at the scene"}};
  return kTable;
}

CameraPath cameraFor(const CameraPath& builtIn, const CameraChoice& choice) {
  if (const auto* view = std::get_if<StillView>(&choice)) return {{{0.0, parseCamera(view->text)}}};
  if (const auto* path = std::get_if<RecordedPath>(&choice))
    return from(readCameraPath(path->file.path), path->timeS);
  return from(builtIn, std::get<BuiltInCamera>(choice).timeS);
}

double timeOf(const CameraChoice& choice) {
  if (const auto* path = std::get_if<RecordedPath>(&choice)) return path->timeS;
  const auto* builtIn = std::get_if<BuiltInCamera>(&choice);
  return builtIn ? builtIn->timeS : 0.0;
}

void clearCamera(std::map<std::string, ParameterValue>& values) {
  std::erase_if(values, [](const auto& value) {
    return value.first == "camera" || value.first.starts_with("camera.");
  });
}

void setCamera(std::map<std::string, ParameterValue>& values, const CameraChoice& choice) {
  clearCamera(values);
  PlacementSettings settings;
  settings.camera = choice;
  for (const auto& [path, value] : PlacementSettings::table().write(settings))
    if (path == "camera" || path.starts_with("camera.")) values[path] = value;
}

void place(Scene& scene, const PlacementSettings& settings, const std::string& where) {
  const double scale = settings.scale;
  if (scale != 1.0) {
    mapWorld(scene, [&](glm::dvec3 p) { return p * scale; });
    for (AreaLight& light : scene.lights) light.size *= scale;
    for (Material& material : scene.materials) material.pattern.size *= scale;
    for (LodObject& object : scene.lodObjects) {
      for (LodLevel& level : object.levels) level.deviation *= scale, level.statedError *= scale;
      for (double& distance : object.switchDistances) distance *= scale;
    }
  }
  if (settings.offset != 0.0) {
    const glm::dvec3 shift(settings.offset * scene.bounds().diagonal() / std::sqrt(3.0));
    mapWorld(scene, [&](glm::dvec3 p) { return p + shift; });
  }
  const auto* picture = std::get_if<ShapePicture>(&settings.lightShape);
  const std::vector<LightPart> pictured =
      picture ? pictureParts(readRadiance(picture->file.path), picture->cells) : std::vector<LightPart>{};
  for (AreaLight& light : scene.lights) {
    light.size *= settings.lightSize;
    light = changed(std::move(light), settings.lightShape);
    if (picture) light.parts = pictured;
    checkLight(light, where);
  }
  scene.camera = cameraFor(scene.camera, settings.camera);
}

}  // namespace limen::scene
