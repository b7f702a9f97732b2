// SPDX-License-Identifier: BSD-3-Clause
// Rows of bumpy spheres in a few levels of detail that recede from the camera, behind a fence on the left
// half, in front of a patterned wall: the use case of the interactive perceptual pipeline (Schwarz 2009,
// section 9.5 and Fig. 9.8: statues, partly masked). The thesis's scene is not available; this one is made
// from a seed.
#include <cmath>

#include "renderer/scene/bumps.h"
#include "renderer/scene/closest_point.h"
#include "renderer/scene/lod/mesh_chain.h"
#include "renderer/scene/lod_scene_parameters.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kRadius = 0.45;

/// Arrangement of the objects.
struct GridSettings {
  int rows = 5, columns = 4;
  double spacing = 1.8;
  static const SettingsTable<GridSettings>& table() {
    using S = GridSettings;
    static const SettingsTable<S> kTable = {
        Binding(&S::rows, "rows", Range{0, 32}, "", "Rows of objects, one behind another").formerly({"rows"}),
        Binding(&S::columns, "columns", Range{0, 32}, "", "Objects in a row").formerly({"columns"}),
        Binding(&S::spacing, "spacing", Range{0.5, 20.0}, "world units",
                "Distance between objects, whose radius is about 0.45")
            .formerly({"spacing"})};
    return kTable;
  }
};

struct SphereLevels {
  int count = 6, tessellation = 32;
  double ratio = 0.7;
  static const SettingsTable<SphereLevels>& table() {
    using S = SphereLevels;
    static const SettingsTable<S> kTable = {
        {&S::count, "count", {1, 8}, "", "Levels of detail; fewer if the coarsest would have no triangles"},
        Binding(&S::tessellation, "tessellation", Range{1, 96}, "segments",
                "Segments in a quarter circle of the finest level; 8 times its square triangles")
            .formerly({"tessellation"}),
        Binding(&S::ratio, "ratio", Range{0.3, 0.9}, "",
                "Segments of each level relative to the one before; the square is the ratio of triangles")
            .formerly({"level_ratio"})};
    return kTable;
  }
};

struct MaskerSettings {
  double contrast = 0.6, size = 0.25;
  static const SettingsTable<MaskerSettings>& table() {
    using S = MaskerSettings;
    static const SettingsTable<S> kTable = {
        Binding(&S::contrast, "contrast", Range{0.0, 1.0}, "", "Contrast of the pattern on ground and wall")
            .formerly({"masker_contrast"}),
        Binding(&S::size, "size", Range{0.01, 10.0}, "world units", "Size of its coarsest features")
            .formerly({"masker_size"})};
    return kTable;
  }
};

struct Fence {
  static constexpr const char *kKind = "bars", *kSummary = "a fence in front of the left half";
  double pitch = 0.3, share = 0.4;
  static const SettingsTable<Fence>& table() {
    static const SettingsTable<Fence> kTable = {
        Binding(&Fence::pitch, "pitch", Range{0.01, 4.0}, "world units", "Distance from bar to bar")
            .formerly({"fence_pitch"}),
        Binding(&Fence::share, "share", Range{0.05, 0.95}, "", "Share of the pitch that a bar fills")
            .formerly({"fence_share"})};
    return kTable;
  }
};

struct NoFence {
  static constexpr const char *kKind = "none", *kSummary = "no fence";
};

struct FieldSettings {
  GridSettings grid;
  SphereLevels levels;
  double bumps = 0.25, objectContrast = 0.0;
  MaskerSettings masker;
  std::variant<Fence, NoFence> fence;
  int64_t seed = 1;
  SwitchSettings switching{.distance = 3.5};
  double distance = 4.5;
  CameraMotion motion = Approach{.speed = 0.5};
  static const SettingsTable<FieldSettings>& table() {
    using S = FieldSettings;
    static const SettingsTable<S> kTable = {
        {&S::grid, "grid", "Arrangement of the objects"},
        Binding(&S::levels, "levels", "Levels of detail").shorthand("count"),
        {&S::bumps, "bumps", {0.0, 0.8}, "", "Height of the objects' bumps relative to their radius"},
        {&S::objectContrast, "object_contrast", {0.0, 1.0}, "", "Contrast of the objects' solid texture"},
        {&S::masker, "masker", "The pattern on ground and wall"},
        {&S::fence, "fence", "What hides parts of the objects and shadows them"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of bumps, positions and rotations"},
        switchBinding(&S::switching),
        distanceBinding(&S::distance, 50.0),
        motionBinding(&S::motion)};
    return kTable;
  }
};

LodSet bumpySpheres(const FieldSettings& settings) {
  const Bumps bumps(kRadius, settings.bumps, settings.seed);
  LodSet set{"bumpy_sphere", {}};
  for (int i = 0; i < settings.levels.count; ++i) {
    const double finest = settings.levels.tessellation;
    const double ratio = std::pow(settings.levels.ratio, static_cast<double>(i));
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

Scene buildField(const FieldSettings& settings) {
  const int rows = settings.grid.rows, columns = settings.grid.columns;
  const double spacing = settings.grid.spacing, contrast = settings.masker.contrast;
  const double size = settings.masker.size;
  const double width = spacing * columns + 4.0, depth = spacing * rows + 4.0;
  Scene scene;
  addPart(scene, "ground", planeGrid({0.0, 0.0, -0.5 * depth + 4.0}, 3.0 * width, depth + 8.0, 16), {},
          Role::ReceiverOnly);
  scene.materials.back() = textured("ground", {0.45F, 0.46F, 0.42F}, contrast, size);
  addPart(scene, "wall",
          cardGrid({0.0, 3.0, -spacing * rows - 1.5}, {1.5 * width, 0.0, 0.0}, {0.0, 3.0, 0.0}, 8), {},
          Role::ReceiverOnly);
  scene.materials.back() = textured("wall", {0.45F, 0.43F, 0.4F}, contrast, size);
  // Bars on the left half, in front of the nearest row: they hide parts of the objects and shadow them.
  if (const auto* fence = std::get_if<Fence>(&settings.fence)) {
    Mesh bars;
    const double bar = fence->share * fence->pitch;
    for (double x = -0.5 * width; x + bar <= 0.0; x += fence->pitch)
      append(bars, box({x, 0.0, 0.9}, {x + bar, 1.3, 0.95}));
    addPart(scene, "fence", bars, {0.3F, 0.2F, 0.14F});
  }
  if (rows * columns > 0) {
    const LodSet set = bumpySpheres(settings);
    Random random(settings.seed);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        Placement placement;
        placement.position = {spacing * (column - 0.5 * (columns - 1) + random.uniform(-0.15, 0.15)),
                              kRadius + 0.1, -spacing * (row + random.uniform(-0.15, 0.15))};
        placement.yawDeg = random.uniform(0.0, 360.0);
        addLodObject(scene, set, placement,
                     textured("bumpy_sphere", {0.62F, 0.6F, 0.56F}, settings.objectContrast, 0.1),
                     settings.switching.distances(set.levels.size()));
      }
  }
  const glm::dvec3 middle(0.0, 0.5, 0.0);
  scene.lights = {lightTowards({-12.0, 22.0, 25.0}, {0.0, 0.0, -0.4 * depth}, glm::dvec2(1.0))};
  Ride ride;
  ride.distance = settings.distance;
  ride.target = middle;
  ride.back = orbitCamera(glm::dvec3(0.0), 1.0, 0.0, 17.0).eye;
  ride.nearest = 1.5;
  ride.verticalFovDeg = 40.0;
  setRide(scene, ride, settings.motion);
  return scene;
}

const RegisteredScene<FieldSettings> kField{{.name = "lod/field",
                                             .version = 1,
                                             .summary = "Rows of bumpy spheres with levels of detail behind "
                                                        "a fence, in front of a patterned wall: masked LODs",
                                             .source = "stand-in for Schwarz 2009, Fig. 9.8"},
                                            buildField};

}  // namespace
}  // namespace limen::scene
