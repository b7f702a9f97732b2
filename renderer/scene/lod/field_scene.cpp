// SPDX-License-Identifier: BSD-3-Clause
// Rows of bumpy spheres in a few levels of detail that go away from the camera, behind a fence on the left
// half, before a patterned wall: what the interactive perceptual pipeline is about (Schwarz 2009, section 9.5
// and Fig. 9.8: statues, partly masked). The thesis's scene is not available; this one is made from a seed.
#include <cmath>

#include "renderer/scene/bumps.h"
#include "renderer/scene/lod/closest_point.h"
#include "renderer/scene/lod/mesh_chain.h"
#include "renderer/scene/lod_scene_parameters.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kRadius = 0.45;

LodSet bumpySpheres(const ParameterValues& values) {
  const Bumps bumps(kRadius, values.real("bumps"), values.integer("seed"));
  LodSet set{"bumpy_sphere", {}};
  const int64_t levels = values.integer("levels");
  for (int64_t i = 0; i < levels; ++i) {
    const double finest = static_cast<double>(values.integer("tessellation"));
    const double ratio = std::pow(values.real("level_ratio"), static_cast<double>(i));
    const int cells = std::max(static_cast<int>(std::lround(finest * ratio)), 1);
    LodMesh level{sphere(glm::dvec3(0.0), 1.0, cells)};
    for (glm::dvec3& position : level.mesh.positions) position *= bumps.radius(glm::normalize(position));
    level.mesh.normals = vertexNormals(level.mesh);
    if (i > 0) level.deviation = sampledDeviation(set.levels[0].mesh, level.mesh, 4000);
    level.statedError = level.deviation;
    set.levels.push_back(std::move(level));
    if (cells == 1) break;
  }
  return set;
}

Material textured(const std::string& name, glm::vec3 albedo, double contrast, double size) {
  Material out{name, albedo};
  if (contrast > 0.0)
    out.pattern = {Pattern::Kind::ValueNoise, size, contrast, 3, glm::dvec3(0.13, 0.31, 0.7)};
  return out;
}

Scene buildField(const ParameterValues& values) {
  const auto rows = static_cast<int>(values.integer("rows")),
             columns = static_cast<int>(values.integer("columns"));
  const double spacing = values.real("spacing"), contrast = values.real("masker_contrast");
  const double size = values.real("masker_size");
  const double width = spacing * columns + 4.0, depth = spacing * rows + 4.0;
  Scene scene;
  addPart(scene, "ground", planeGrid({0.0, 0.0, -0.5 * depth + 4.0}, 3.0 * width, depth + 8.0, 16), {},
          Role::ReceiverOnly);
  scene.materials.back() = textured("ground", {0.45F, 0.46F, 0.42F}, contrast, size);
  addPart(scene, "wall",
          cardGrid({0.0, 3.0, -spacing * rows - 1.5}, {1.5 * width, 0.0, 0.0}, {0.0, 3.0, 0.0}, 8), {},
          Role::ReceiverOnly);
  scene.materials.back() = textured("wall", {0.45F, 0.43F, 0.4F}, contrast, size);
  // Bars on the left half, before the nearest row: they hide parts of the objects and shadow them.
  const double pitch = values.real("fence_pitch");
  if (pitch > 0.0) {
    Mesh bars;
    const double bar = values.real("fence_share") * pitch;
    for (double x = -0.5 * width; x + bar <= 0.0; x += pitch)
      append(bars, box({x, 0.0, 0.9}, {x + bar, 1.3, 0.95}));
    addPart(scene, "fence", bars, {0.3F, 0.2F, 0.14F});
  }
  if (rows * columns > 0) {
    const LodSet set = bumpySpheres(values);
    Random random(values.integer("seed"));
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        Placement placement;
        placement.position = {spacing * (column - 0.5 * (columns - 1) + random.uniform(-0.15, 0.15)),
                              kRadius + 0.1, -spacing * (row + random.uniform(-0.15, 0.15))};
        placement.yawDeg = random.uniform(0.0, 360.0);
        addLodObject(scene, set, placement,
                     textured("bumpy_sphere", {0.62F, 0.6F, 0.56F}, values.real("object_contrast"), 0.1),
                     switchDistances(values, set.levels.size()));
      }
  }
  const glm::dvec3 middle(0.0, 0.5, 0.0);
  scene.lights = {lightTowards({-12.0, 22.0, 25.0}, {0.0, 0.0, -0.4 * depth}, glm::dvec2(1.0))};
  Ride ride = rideOf(values);
  ride.target = middle;
  ride.back = orbitCamera(glm::dvec3(0.0), 1.0, 0.0, 17.0).eye;
  ride.nearest = 1.5;
  ride.verticalFovDeg = 40.0;
  setRide(scene, ride);
  return scene;
}

std::vector<Parameter> fieldParameters() {
  std::vector<Parameter> out = {
      integerParameter("rows", 5, 0, 32, "", "Rows of objects, one behind another"),
      integerParameter("columns", 4, 0, 32, "", "Objects in a row"),
      realParameter("spacing", 1.8, 0.5, 20.0, "world units", "Between objects, whose radius is about 0.45"),
      integerParameter("levels", 6, 1, 8, "",
                       "Levels of detail; fewer where the coarsest would have no triangles"),
      integerParameter("tessellation", 32, 1, 96, "segments",
                       "Segments in a quarter circle of the finest level; 8 times its square triangles"),
      realParameter("level_ratio", 0.7, 0.3, 0.9, "",
                    "Segments of each level over those of the one before; its square is that of triangles"),
      realParameter("bumps", 0.25, 0.0, 0.8, "", "Height of the objects' bumps over their radius"),
      realParameter("object_contrast", 0.0, 0.0, 1.0, "", "Contrast of the objects' solid texture"),
      realParameter("masker_contrast", 0.6, 0.0, 1.0, "", "Contrast of the pattern on ground and wall"),
      realParameter("masker_size", 0.25, 0.01, 10.0, "world units",
                    "Size of that pattern's coarsest features"),
      realParameter("fence_pitch", 0.3, 0.0, 4.0, "world units",
                    "From bar to bar of the fence before the left half; 0: no fence"),
      realParameter("fence_share", 0.4, 0.05, 0.95, "", "Share of the pitch that a bar fills"),
      integerParameter("seed", 1, 0, 1000000, "", "Of bumps, places and turns")};
  const auto add = [&](std::vector<Parameter> more) { out.insert(out.end(), more.begin(), more.end()); };
  add(switchParameters(3.5, 100.0));
  add(rideParameters(4.5, 50.0, 0.5, 50.0));
  return out;
}

const Registered<SceneInfo> kField{SceneInfo{
    .name = "lod/field",
    .version = 1,
    .summary = "Rows of bumpy spheres with levels behind a fence, before a patterned wall: masked LODs",
    .source = "stand-in for Schwarz 2009, Fig. 9.8",
    .parameters = fieldParameters(),
    .build = buildField}};

}  // namespace
}  // namespace limen::scene
