// SPDX-License-Identifier: BSD-3-Clause
// Scenes for reflections that are found vertex by vertex: star-shaped mirrors of several shapes among many
// small objects, an object near contact, and thin layers (Roger 2008, section 2.3).
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <variant>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct SphereMirror {
  static constexpr const char *kKind = "sphere", *kSummary = "closed, convex";
};
struct EllipsoidMirror {
  static constexpr const char *kKind = "ellipsoid", *kSummary = "closed, convex, no two axes alike";
};
struct BumpyMirror {
  static constexpr const char *kKind = "bumpy", *kSummary = "sphere with waves: star-shaped, not convex";
  double height = 0.05, frequency = 8.0;
  static const SettingsTable<BumpyMirror>& table() {
    using S = BumpyMirror;
    static const SettingsTable<S> kTable = {
        {&S::height, "height", {0.0, 0.5}, "radii", "Of the waves"},
        {&S::frequency, "frequency", {0.0, 40.0}, "rad/radius", "Of the waves along x and y"}};
    return kTable;
  }
};
struct BowlMirror {
  static constexpr const char *kKind = "bowl",
                              *kSummary = "open, concave: part of a sphere, seen from inside";
  double openingDeg = 70.0;
  static const SettingsTable<BowlMirror>& table() {
    static const SettingsTable<BowlMirror> kTable = {
        {&BowlMirror::openingDeg,
         "opening_deg",
         {5.0, 90.0},
         "deg",
         "Angle between the axis and the rim, from the sphere's middle"}};
    return kTable;
  }
};
struct TwoSphereMirrors {
  static constexpr const char *kKind = "two_spheres",
                              *kSummary = "two spheres that meet: not star-shaped, two convex parts";
};

struct MirrorShapesSettings {
  std::variant<SphereMirror, EllipsoidMirror, BumpyMirror, BowlMirror, TwoSphereMirrors> mirror;
  int tessellation = 32;
  int objects = 12;
  int objectSegments = 4;
  double reflectance = 0.9;
  static const SettingsTable<MirrorShapesSettings>& table() {
    using S = MirrorShapesSettings;
    static const SettingsTable<S> kTable = {
        {&S::mirror, "mirror", "Shape of the mirror"},
        {&S::tessellation,
         "tessellation",
         {2, 128},
         "segments",
         "Segments in a quarter circle of the mirror"},
        {&S::objects, "objects", {0, 400}, "", "Small spheres all around the mirror"},
        {&S::objectSegments,
         "object_segments",
         {1, 64},
         "segments",
         "Segments in a quarter circle of a small sphere, 8 triangles for each pair"},
        {&S::reflectance, "reflectance", {0.0, 1.0}, "", "Share of the light that the mirror reflects"}};
    return kTable;
  }
};

Material vertexMirror(double reflectance, const char* name = "mirror") {
  Material material;
  material.name = name;
  material.albedo = glm::vec3(0.02F);
  material.mirror = glm::vec3(static_cast<float>(reflectance));
  return material;
}

constexpr double kMirrorRadius = 0.5;

/// Unit sphere moved by `place`; normals by differences.
Mesh movedSphere(int cells, const std::function<glm::dvec3(glm::dvec3)>& place) {
  Mesh mesh = sphere(glm::dvec3(0.0), 1.0, cells);
  mesh.normals.clear();
  for (glm::dvec3& position : mesh.positions) {
    const glm::dvec3 u = glm::normalize(position), x = perpendicular(u), y = glm::cross(u, x);
    constexpr double kStep = 1e-5;
    const auto along = [&](glm::dvec3 t) {
      return place(glm::normalize(u + kStep * t)) - place(glm::normalize(u - kStep * t));
    };
    mesh.normals.emplace_back(glm::normalize(glm::cross(along(x), along(y))));
    position = place(u);
  }
  return mesh;
}

/// Inner side of a part of a sphere around `centre`, its lowest point in the middle.
Mesh bowl(glm::dvec3 centre, double radius, double openingDeg, int cells) {
  Mesh mesh;
  const int rings = 2 * cells, around = 4 * cells;
  const auto add = [&](double polar, double azimuth) {
    const glm::dvec3 u(std::sin(polar) * std::cos(azimuth), -std::cos(polar),
                       std::sin(polar) * std::sin(azimuth));
    mesh.positions.push_back(centre + radius * u);
    mesh.normals.emplace_back(-u);
  };
  add(0.0, 0.0);
  for (int i = 1; i <= rings; ++i)
    for (int j = 0; j < around; ++j)
      add(glm::radians(openingDeg) * i / rings, 2.0 * glm::pi<double>() * j / around);
  const auto at = [&](int i, int j) {
    return i == 0 ? 0U : static_cast<uint32_t>(1 + (i - 1) * around + j % around);
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
    }
  // Fronts face the middle.
  for (glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 normal =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    if (glm::dot(normal, centre - mesh.positions[t.x]) < 0.0) std::swap(t.y, t.z);
  }
  return mesh;
}

void checkFloor(Scene& scene) {
  Pattern& pattern = scene.materials[0].pattern;
  pattern.kind = Pattern::Kind::Checker;
  pattern.size = 0.25;
  pattern.origin.y = 0.125;  // the floor lies within cells, not between them
}

void addShape(Scene& scene, const MirrorShapesSettings& settings) {
  const glm::dvec3 centre(0.0, 0.7, 0.0);
  const Material material = vertexMirror(settings.reflectance);
  const int cells = settings.tessellation;
  if (const auto* bumpy = std::get_if<BumpyMirror>(&settings.mirror)) {
    addPart(scene,
            movedSphere(cells,
                        [&](glm::dvec3 u) {
                          const double wave =
                              std::cos(bumpy->frequency * u.x) * std::cos(bumpy->frequency * u.y);
                          return centre + kMirrorRadius * (1.0 + bumpy->height * wave) * u;
                        }),
            material);
  } else if (const auto* open = std::get_if<BowlMirror>(&settings.mirror)) {
    addPart(scene,
            bowl({0.0, 2.0 * kMirrorRadius + 0.05, 0.0}, 2.0 * kMirrorRadius, open->openingDeg, cells / 2),
            material);
  } else if (std::holds_alternative<EllipsoidMirror>(settings.mirror)) {
    addPart(scene, movedSphere(cells, [&](glm::dvec3 u) { return centre + glm::dvec3(0.6, 0.4, 0.5) * u; }),
            material);
  } else if (std::holds_alternative<TwoSphereMirrors>(settings.mirror)) {
    for (const double side : {-1.0, 1.0})
      addPart(scene,
              movedSphere(cells,
                          [&](glm::dvec3 u) { return centre + glm::dvec3(0.38 * side, 0.0, 0.0) + 0.4 * u; }),
              vertexMirror(settings.reflectance, side < 0.0 ? "left mirror" : "right mirror"));
  } else {
    addPart(scene, movedSphere(cells, [&](glm::dvec3 u) { return centre + kMirrorRadius * u; }), material);
  }
}

Scene buildMirrorShapes(const MirrorShapesSettings& settings) {
  Scene scene;
  addGround(scene, 6.0);
  checkFloor(scene);
  addShape(scene, settings);
  // On two rings, so that some are near, some far, and some on the silhouette from anywhere.
  Mesh objects;
  for (int i = 0; i < settings.objects; ++i) {
    const double azimuth = 2.0 * glm::pi<double>() * i / settings.objects;
    const double distance = i % 2 == 0 ? 1.0 : 1.6, height = i % 3 == 0 ? 0.25 : i % 3 == 1 ? 0.8 : 1.4;
    Mesh ball = sphere({distance * std::cos(azimuth), height, distance * std::sin(azimuth)}, 0.12,
                       settings.objectSegments);
    append(objects, ball);
  }
  if (settings.objects > 0) addPart(scene, "objects", objects, {0.7F, 0.4F, 0.2F});
  frameStanding(scene, 1.4, 1.2);
  if (std::holds_alternative<BowlMirror>(settings.mirror))
    setStillCamera(scene, orbitCamera({0.0, 0.3, 0.0}, 4.0, 8.0, 55.0));
  return scene;
}

const RegisteredScene<MirrorShapesSettings> kMirrorShapes{
    {.name = "mirrors/shapes",
     .version = 1,
     .summary = "Star-shaped mirror, or two spheres that meet, with small spheres all around",
     .source = "stand-in for Roger 2008, Figs. 2.9, 2.13, 2.15 and 2.16"},
    buildMirrorShapes};

struct MirrorContactSettings {
  double gap = 0.0;
  int tessellation = 32;
  static const SettingsTable<MirrorContactSettings>& table() {
    using S = MirrorContactSettings;
    static const SettingsTable<S> kTable = {
        {&S::gap, "gap", {0.0, 1.0}, "world units", "Between the mirror and the plate's middle"},
        {&S::tessellation, "tessellation", {2, 128}, "segments", "Segments in a quarter circle of the ball"}};
    return kTable;
  }
};

/// A ball, with a plate that touches it in a vertex.
Scene buildMirrorContact(const MirrorContactSettings& settings) {
  const glm::dvec3 centre(0.0, 0.5, 0.0);
  Scene scene;
  addGround(scene, 6.0);
  checkFloor(scene);
  addPart(scene, movedSphere(settings.tessellation, [&](glm::dvec3 u) { return centre + kMirrorRadius * u; }),
          vertexMirror(0.9));
  const glm::dvec3 towards = glm::normalize(glm::dvec3(1.0, 0.4, 1.2));
  const glm::dvec3 x = perpendicular(towards), y = glm::cross(towards, x);
  // Of an even number of cells, so that a vertex lies in the middle.
  addPart(scene, "plate", cardGrid(centre + (kMirrorRadius + settings.gap) * towards, 0.2 * x, 0.2 * y, 8),
          {0.7F, 0.25F, 0.2F});
  frameStanding(scene, 1.0, 1.0);
  setStillCamera(scene, orbitCamera(centre, 3.6, 85.0, 20.0));
  return scene;
}

const RegisteredScene<MirrorContactSettings> kMirrorContact{
    {.name = "mirrors/contact",
     .version = 1,
     .summary = "Mirroring ball and a plate that touches it, or nearly",
     .source = "stand-in for Roger 2008, Fig. 2.13 (hand on a sphere)"},
    buildMirrorContact};

struct MirrorLayersSettings {
  double gap = 0.005;
  int cells = 32;
  static const SettingsTable<MirrorLayersSettings>& table() {
    using S = MirrorLayersSettings;
    static const SettingsTable<S> kTable = {
        {&S::gap, "gap", {0.0, 0.5}, "world units", "Between the wall and the thin plates before it"},
        {&S::cells, "cells", {1, 64}, "", "Squares along the side of the wall"}};
    return kTable;
  }
};

/// A ball before a wall on which thin plates lie, two triangles each: where the wall's are smaller, its path
/// lengths are interpolated better, and it shows through the plates.
Scene buildMirrorLayers(const MirrorLayersSettings& settings) {
  const glm::dvec3 centre(0.0, 0.5, 0.0);
  Scene scene;
  addGround(scene, 6.0);
  addPart(scene, movedSphere(32, [&](glm::dvec3 u) { return centre + kMirrorRadius * u; }),
          vertexMirror(0.9));
  const glm::dvec3 wall(0.0, 0.9, 1.6), x(-0.9, 0.0, 0.0), y(0.0, 0.9, 0.0);
  addPart(scene, "wall", cardGrid(wall, 1.5 * x, y, settings.cells), {0.25F, 0.5F, 0.7F});
  Mesh plates;
  for (const double across : {-0.6, 0.0, 0.6})
    for (const double up : {-0.5, 0.5})
      append(plates, card(wall + glm::dvec3(across, 0.6 * up, -settings.gap), 0.25 * x, 0.35 * y));
  addPart(scene, "plates", plates, {0.8F, 0.6F, 0.1F});
  frameStanding(scene, 1.0, 1.0);
  setStillCamera(scene, {{2.2, 0.9, 1.0}, {0.1, 0.5, 0.1}, {0.0, 1.0, 0.0}, 32.0});
  return scene;
}

const RegisteredScene<MirrorLayersSettings> kMirrorLayers{
    {.name = "mirrors/layers",
     .version = 1,
     .summary = "Mirroring ball before a wall with thin coarse plates on it",
     .source = "stand-in for Roger 2008, Fig. 2.18"},
    buildMirrorLayers};

}  // namespace
}  // namespace limen::scene
