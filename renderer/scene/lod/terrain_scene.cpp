// SPDX-License-Identifier: BSD-3-Clause
// Fly-over of mountains in tiles with levels of detail (SP-55, SP-56): the second example of Schwarz 2009,
// section 10.3.5. The thesis's terrain data are not given; here the mountains are made by noise. Its chunks
// follow a quadtree; here tiles lie side by side on one grid, each with the levels that a quadtree's would
// have, so that any tile may show any level.
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

const char* const kFlyOver = "Schwarz 2009, section 10.3.5";
constexpr double kTerrainSize = 16.0;  // world units along a side

struct TileLevels {
  int perSide = 8, cells = 16, levels = 4;
  bool skirts = true;
  static const SettingsTable<TileLevels>& table() {
    using S = TileLevels;
    static const SettingsTable<S> kTable = {
        {&S::perSide, "per_side", {1, 16}, "", "Tiles per side of the terrain, which is 16 world units wide"},
        Binding(&S::cells, "cells", oneOf({4, 8, 16, 32}), "", "Cells per side of a tile's finest level")
            .formerly({"cells"}),
        Binding(&S::levels, "levels", Range{2, 6}, "",
                "Levels of a tile, each with every second point of the one before; at least two cells per "
                "side remain",
                kFlyOver)
            .formerly({"levels"}),
        Binding(&S::skirts, "skirts", "Close cracks with strips that hang from the borders of tiles")
            .formerly({"skirts"})};
    return kTable;
  }
};

struct MountainShape {
  double relief = 2.5;
  int octaves = 4, azimuths = 24;
  int64_t seed = 1;
  static const SettingsTable<MountainShape>& table() {
    using S = MountainShape;
    static const SettingsTable<S> kTable = {
        Binding(&S::relief, "relief", Range{0.1, 10.0}, "world units", "Largest height; the smallest is 0")
            .formerly({"relief"}),
        Binding(&S::octaves, "octaves", Range{1, 10}, "", "Octaves of the noise that shapes the mountains")
            .formerly({"octaves"}),
        Binding(&S::azimuths, "azimuths", Range{4, 64}, "",
                "Directions in which the horizon of a point is searched", kFlyOver)
            .formerly({"azimuths"}),
        Binding(&S::seed, "seed", Range{0, 1000000}, "", "Seed of the noise").formerly({"seed"})};
    return kTable;
  }
};

struct SunSettings {
  double elevationDeg = 25.0, azimuthDeg = -60.0, radiusDeg = 1.5;
  static const SettingsTable<SunSettings>& table() {
    using S = SunSettings;
    static const SettingsTable<S> kTable = {
        Binding(&S::elevationDeg, "elevation_deg", Range{1.0, 90.0}, "deg",
                "Elevation of the sun: the time of day", kFlyOver)
            .formerly({"sun_elevation_deg"}),
        Binding(&S::azimuthDeg, "azimuth_deg", Range{-180.0, 180.0}, "deg",
                "Azimuth of the sun: 0 is +z, 90 is +x")
            .formerly({"sun_azimuth_deg"}),
        Binding(&S::radiusDeg, "radius_deg", Range{0.01, 20.0}, "deg",
                "Angular radius, 0.27 in nature; larger ones give softer shadows")
            .formerly({"sun_radius_deg"})};
    return kTable;
  }
};

struct LookAhead {
  static constexpr const char *kKind = "ahead",
                              *kSummary = "a point ahead, at an altitude over all mountains";
  double altitude = 0.6;
  static const SettingsTable<LookAhead>& table() {
    static const SettingsTable<LookAhead> kTable = {Binding(&LookAhead::altitude, "altitude",
                                                            Range{0.01, 20.0}, "world units",
                                                            "Altitude of the eye above the terrain's relief")
                                                        .formerly({"altitude"})};
    return kTable;
  }
};

struct LookAtTile {
  static constexpr const char *kKind = "tile", *kSummary = "the middle of a tile";
  size_t number = 0;
  static const SettingsTable<LookAtTile>& table() {
    static const SettingsTable<LookAtTile> kTable = {
        Binding(&LookAtTile::number, "number", Range{0, 255}, "",
                "Index in the order of objects; the last one if there are fewer")
            .formerly({"tile"})};
    return kTable;
  }
};

struct TerrainSettings {
  TileLevels tiles;
  MountainShape mountains;
  double contrast = 0.4;
  SunSettings sun;
  std::variant<LookAhead, LookAtTile> target;
  double azimuthDeg = 0.0, pitchDeg = 14.0;
  SwitchSettings switching{.distance = 5.0};
  double distance = 8.0;
  CameraMotion motion = Approach{.speed = 1.0};
  static const SettingsTable<TerrainSettings>& table() {
    using S = TerrainSettings;
    static const SettingsTable<S> kTable = {
        Binding(&S::tiles, "tiles", "Tiles with levels of detail").shorthand("per_side"),
        {&S::mountains, "mountains", "Shape of the terrain"},
        {&S::contrast, "contrast", {0.0, 1.0}, "", "Contrast of the solid texture"},
        {&S::sun, "sun", "The light"},
        {&S::target, "target", "Target of the ride"},
        {&S::azimuthDeg,
         "azimuth_deg",
         {-180.0, 180.0},
         "deg",
         "Side of the terrain that the eye comes from"},
        {&S::pitchDeg, "pitch_deg", {0.0, 80.0}, "deg", "Pitch of the view below the horizontal"},
        switchBinding(&S::switching),
        distanceBinding(&S::distance, 30.0),
        motionBinding(&S::motion)};
    return kTable;
  }
};

struct Ground {
  HeightField field;
  std::vector<Aperture> apertures;
};

/// Apertures take seconds for large fields: the last ground is cached for scenes that differ only in camera,
/// sun or tiles.
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

Scene buildTerrain(const TerrainSettings& settings) {
  TileSetting tiling;
  tiling.tiles = settings.tiles.perSide;
  tiling.cells = settings.tiles.cells;
  // A tile's coarsest level keeps two cells a side.
  tiling.levels = std::min(settings.tiles.levels, static_cast<int>(std::log2(tiling.cells) + 0.5));
  tiling.skirts = settings.tiles.skirts;
  MountainSetting setting;
  setting.side = tiling.tiles * tiling.cells + 1;
  setting.size = kTerrainSize;
  setting.relief = settings.mountains.relief;
  setting.octaves = settings.mountains.octaves;
  setting.seed = settings.mountains.seed;
  const auto ground = groundOf(setting, settings.mountains.azimuths);

  Scene scene;
  Material material{"terrain", {0.62F, 0.57F, 0.5F}};
  material.surface = SurfaceKind::Aperture;
  if (const double contrast = settings.contrast; contrast > 0.0)
    material.pattern = {Pattern::Kind::ValueNoise, 0.5, contrast, 4, {0.31, 0.17, 0.23}};
  for (const LodSet& set : terrainTiles(ground->field, ground->apertures, tiling))
    addLodObject(scene, set, {}, material, settings.switching.distances(set.levels.size()));

  // The sun, far enough away for its direction to be the same everywhere to within a thousandth of a degree.
  const double elevation = glm::radians(settings.sun.elevationDeg),
               azimuth = glm::radians(settings.sun.azimuthDeg);
  const glm::dvec3 toSun(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                         std::cos(elevation) * std::cos(azimuth));
  constexpr double kFar = 1e6;
  const double radius = kFar * std::tan(glm::radians(settings.sun.radiusDeg));
  AreaLight sun = lightTowards(kFar * toSun, glm::dvec3(0.0), glm::dvec2(2.0 * radius));
  sun.shape = LightShape::Disc;
  scene.lights = {sun};

  Ride ride;
  ride.distance = settings.distance;
  ride.back = orbitCamera(glm::dvec3(0.0), 1.0, settings.azimuthDeg, settings.pitchDeg).eye;
  ride.forward = -glm::normalize(glm::dvec3(ride.back.x, 0.0, ride.back.z));
  if (const auto* ahead = std::get_if<LookAhead>(&settings.target)) {
    // The eye starts at the given altitude above the highest point the terrain may have; the target follows.
    const double height = setting.relief + ahead->altitude;
    ride.target = glm::dvec3(0.0, height - ride.distance * ride.back.y, 0.0);
  } else {
    const size_t last = scene.lodObjects.size() - 1;
    const size_t tile = std::get<LookAtTile>(settings.target).number;
    ride.target = scene.lodObjects[std::min(tile, last)].bounds.centre();
    const glm::dvec3 eye = ride.target + ride.distance * ride.back;
    if (!(eye.y > ground->field.height(eye.x, eye.z)))
      throw Error("the eye lies within the mountains", "scene 'lod/terrain'",
                  "raise 'pitch_deg' or choose another distance, azimuth or tile");
  }
  ride.nearest = 0.1;
  ride.verticalFovDeg = 45.0;
  setRide(scene, ride, settings.motion);
  return scene;
}

const RegisteredScene<TerrainSettings> kTerrainSceneRegistered{
    {.name = "lod/terrain",
     .version = 1,
     .summary = "Mountains in tiles with levels of detail under a sun, flown over",
     .source = kFlyOver},
    buildTerrain};

}  // namespace
}  // namespace limen::scene
