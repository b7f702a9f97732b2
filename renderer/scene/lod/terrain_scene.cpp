// SPDX-License-Identifier: BSD-3-Clause
// Fly-over of mountains in tiles with levels of detail (SP-55, SP-56): the second example of Schwarz 2009,
// section 10.3.5. The thesis's terrain data are not given; here the mountains are made by noise. Its chunks
// follow a quadtree; here tiles stand side by side on one grid, each with the levels that a quadtree's would
// have had, so that any tile may show any level.
#include <cmath>
#include <memory>
#include <mutex>

#include "experiments/base/error.h"
#include "renderer/scene/lod/terrain_tiles.h"
#include "renderer/scene/lod_scene_parameters.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct Ground {
  HeightField field;
  std::vector<Aperture> apertures;
};

/// Apertures take seconds for large fields: the last ground is kept for scenes that differ in camera, sun or
/// tiles.
std::shared_ptr<const Ground> groundOf(const MountainSetting& setting, int azimuths) {
  static std::mutex guard;
  static std::string keptKey;
  static std::shared_ptr<const Ground> kept;
  std::string key;
  for (const double value : {double(setting.side), setting.size, setting.relief, setting.feature,
                             double(setting.octaves), double(setting.seed), double(azimuths)})
    key += toText(ParameterValue(value)) + "|";
  const std::scoped_lock lock(guard);
  if (!kept || key != keptKey) {
    auto made = std::make_shared<Ground>();
    made->field = mountains(setting);
    made->apertures = apertures(made->field, azimuths);
    kept = std::move(made);
    keptKey = key;
  }
  return kept;
}

Scene buildTerrain(const ParameterValues& values) {
  TileSetting tiling;
  tiling.tiles = static_cast<int>(values.integer("tiles"));
  tiling.cells = std::stoi(values.text("cells"));
  // A tile's coarsest level keeps two cells a side.
  tiling.levels =
      std::min(static_cast<int>(values.integer("levels")), static_cast<int>(std::log2(tiling.cells) + 0.5));
  tiling.skirts = values.boolean("skirts");
  MountainSetting setting;
  setting.side = tiling.tiles * tiling.cells + 1;
  setting.size = 16.0;
  setting.relief = values.real("relief");
  setting.octaves = static_cast<int>(values.integer("octaves"));
  setting.seed = values.integer("seed");
  const auto ground = groundOf(setting, static_cast<int>(values.integer("azimuths")));

  Scene scene;
  Material material{"terrain", {0.62F, 0.57F, 0.5F}};
  material.surface = SurfaceKind::Aperture;
  if (const double contrast = values.real("contrast"); contrast > 0.0)
    material.pattern = {Pattern::Kind::ValueNoise, 0.5, contrast, 4, {0.31, 0.17, 0.23}};
  for (const LodSet& set : terrainTiles(ground->field, ground->apertures, tiling))
    addLodObject(scene, set, {}, material, switchDistances(values, set.levels.size()));

  // The sun, far enough to be in the same direction everywhere up to a thousandth of a degree.
  const double elevation = glm::radians(values.real("sun_elevation_deg")),
               azimuth = glm::radians(values.real("sun_azimuth_deg"));
  const glm::dvec3 toSun(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                         std::cos(elevation) * std::cos(azimuth));
  constexpr double kFar = 1e6;
  const double radius = kFar * std::tan(glm::radians(values.real("sun_radius_deg")));
  AreaLight sun = lightTowards(kFar * toSun, glm::dvec3(0.0), glm::dvec2(2.0 * radius));
  sun.shape = LightShape::Disc;
  scene.lights = {sun};

  Ride ride = rideOf(values);
  ride.back = orbitCamera(glm::dvec3(0.0), 1.0, values.real("azimuth_deg"), values.real("pitch_deg")).eye;
  ride.forward = -glm::normalize(glm::dvec3(ride.back.x, 0.0, ride.back.z));
  // The eye starts at the given altitude above the highest point the terrain may have; the target follows.
  const double height = setting.relief + values.real("altitude");
  ride.target = glm::dvec3(0.0, height - ride.distance * ride.back.y, 0.0);
  if (const int64_t tile = values.integer("tile"); tile >= 0) {
    const size_t last = scene.lodObjects.size() - 1;
    ride.target = scene.lodObjects[std::min(static_cast<size_t>(tile), last)].bounds.centre();
    const glm::dvec3 eye = ride.target + ride.distance * ride.back;
    if (!(eye.y > ground->field.height(eye.x, eye.z)))
      throw Error("the eye lies within the mountains", "scene 'lod/terrain'",
                  "raise 'pitch_deg' or choose another distance, azimuth or tile");
  }
  ride.nearest = 0.1;
  ride.verticalFovDeg = 45.0;
  setRide(scene, ride);
  return scene;
}

std::vector<Parameter> terrainParameters() {
  const char* const kThesis = "Schwarz 2009, section 10.3.5";
  std::vector<Parameter> out = {
      integerParameter("tiles", 8, 1, 16, "",
                       "Tiles along a side of the terrain, which is 16 world units wide"),
      choiceParameter("cells", "16", {"4", "8", "16", "32"}, "Cells along a side of a tile's finest level"),
      integerParameter("levels", 4, 2, 6, "",
                       "Levels of a tile, each with every second point of the one before; no fewer than two "
                       "cells a side are left",
                       kThesis),
      booleanParameter("skirts", true, "Hangs strips from the borders of tiles, which close cracks"),
      realParameter("relief", 2.5, 0.1, 10.0, "world units", "Heights lie between 0 and this"),
      integerParameter("octaves", 4, 1, 10, "", "Octaves of the noise that shapes the mountains"),
      integerParameter("azimuths", 24, 4, 64, "", "Directions in which the horizon of a point is found",
                       kThesis),
      realParameter("contrast", 0.4, 0.0, 1.0, "", "Contrast of the solid texture"),
      realParameter("sun_elevation_deg", 25.0, 1.0, 90.0, "deg", "Height of the sun: the time of day",
                    kThesis),
      realParameter("sun_azimuth_deg", -60.0, -180.0, 180.0, "deg", "Of the sun: 0 is +z, 90 is +x"),
      realParameter("sun_radius_deg", 1.5, 0.01, 20.0, "deg",
                    "Angular radius of the sun, 0.27 in nature; larger ones make softer shadows"),
      realParameter("altitude", 0.6, 0.01, 20.0, "world units", "Of the eye above the terrain's relief"),
      realParameter("azimuth_deg", 0.0, -180.0, 180.0, "deg", "Side of the terrain that the eye comes from"),
      integerParameter(
          "tile", -1, -1, 255, "",
          "Tile that `distance` leads to, in the order of objects, the last one if there are fewer; "
          "`altitude` plays no part then. -1: none"),
      realParameter("pitch_deg", 14.0, 0.0, 80.0, "deg", "Of the view below the horizontal"),
      integerParameter("seed", 1, 0, 1000000, "", "Of the mountains")};
  for (const std::vector<Parameter>& more :
       {switchParameters(5.0, 100.0), rideParameters(8.0, 30.0, 1.0, 20.0)})
    out.insert(out.end(), more.begin(), more.end());
  return out;
}

const Registered<SceneInfo> kTerrainSceneRegistered{
    SceneInfo{.name = "lod/terrain",
              .version = 1,
              .summary = "Mountains in tiles with levels of detail under a sun, flown over",
              .source = "Schwarz 2009, section 10.3.5",
              .parameters = terrainParameters(),
              .build = buildTerrain}};

}  // namespace
}  // namespace limen::scene
