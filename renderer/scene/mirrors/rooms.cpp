// SPDX-License-Identifier: BSD-3-Clause
// Interiors with mirrors (Roger 2008, sections 2.4 and 3.5): a room with a kettle, a kitchen.
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/scene/lod/mesh_chain.h"
#include "renderer/scene/mirrors/mirror_parts.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

Material plain(const char* name, glm::vec3 albedo) {
  Material material;
  material.name = name;
  material.albedo = albedo;
  return material;
}

void makeSmooth(Mesh& mesh) { mesh.normals = vertexNormals(mesh); }

/// The body of a kettle of radius 1, star-shaped about (0, 0.7, 0).
Mesh kettleBody(int segments) {
  std::vector<glm::dvec2> profile = {{0.0, 0.0}, {0.7, 0.0}, {0.7, 0.0}};
  for (int i = 0; i <= segments; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / segments;
    profile.emplace_back(0.75 + 0.25 * std::cos(angle), 0.15 + 0.9 * std::sin(angle));
  }
  for (const glm::dvec2 lid : {glm::dvec2{0.55, 1.15}, {0.3, 1.22}, {0.12, 1.24}, {0.1, 1.34}, {0.0, 1.36}})
    profile.push_back(lid);
  return lathe(glm::dvec3(0.0), profile, 2 * segments);
}

/// Handle and spout.
Mesh kettleFittings(int segments) {
  std::vector<glm::dvec3> handle;
  std::vector<double> radii;
  for (int i = 0; i <= segments; ++i) {
    const double angle = std::numbers::pi * i / segments;
    handle.emplace_back(0.75 * std::cos(angle), 1.1 + 0.75 * std::sin(angle), 0.0);
    radii.push_back(0.06);
  }
  Mesh mesh = tube(handle, radii, 16);
  const std::array<glm::dvec3, 3> spout = {{{0.85, 0.5, 0.0}, {1.25, 0.75, 0.0}, {1.45, 1.1, 0.0}}};
  const std::array<double, 3> widths = {0.2, 0.13, 0.08};
  append(mesh, tube(spout, widths, 24));
  makeSmooth(mesh);
  return mesh;
}

/// Of legs, seat and back; 0.9 high, facing +z.
Mesh chair() {
  Mesh mesh = box({-0.22, 0.42, -0.22}, {0.22, 0.46, 0.22});
  for (const double x : {-0.2, 0.2})
    for (const double z : {-0.2, 0.2}) append(mesh, frustum({x, 0.0, z}, {x, 0.42, z}, 0.02, 0.02, 12));
  for (const double x : {-0.2, 0.2}) append(mesh, frustum({x, 0.46, -0.2}, {x, 0.9, -0.2}, 0.018, 0.018, 12));
  for (const double y : {0.6, 0.72, 0.84}) append(mesh, box({-0.2, y, -0.21}, {0.2, y + 0.05, -0.19}));
  return mesh;
}

struct MirrorRoomSettings {
  int tessellation = 48;
  double layer = 0.002, reflectance = 0.7;
  static const SettingsTable<MirrorRoomSettings>& table() {
    using S = MirrorRoomSettings;
    static const SettingsTable<S> kTable = {
        {&S::tessellation, "tessellation", {4, 256}, "segments", "Segments of the kettle"},
        {&S::layer,
         "layer",
         {1e-4, 0.05},
         "world units",
         "Height of a sheet of paper above the table's top, which is one pair of triangles",
         "Roger 2008, Fig. 2.18"},
        {&S::reflectance, "reflectance", {0.0, 1.0}, "", "Share of the light that the kettle reflects"}};
    return kTable;
  }
};

Scene buildMirrorRoom(const MirrorRoomSettings& settings) {
  Scene scene;
  addCheckeredGround(scene, 6.0, 0.5);
  addPart(scene, "back wall", card({0.0, 1.25, -3.0}, {3.0, 0.0, 0.0}, {0.0, 1.25, 0.0}),
          {0.7F, 0.7F, 0.62F});
  addPart(scene, "left wall", card({-3.0, 1.25, 0.0}, {0.0, 0.0, -3.0}, {0.0, 1.25, 0.0}),
          {0.62F, 0.45F, 0.4F});
  addPart(scene, "right wall", card({3.0, 1.25, 0.0}, {0.0, 0.0, 3.0}, {0.0, 1.25, 0.0}),
          {0.4F, 0.5F, 0.62F});
  addPart(scene, "table", box({-0.8, 0.65, -0.5}, {0.8, 0.7, 0.5}), {0.5F, 0.33F, 0.2F});
  Mesh legs;
  for (const double x : {-0.72, 0.72})
    for (const double z : {-0.42, 0.42}) append(legs, frustum({x, 0.0, z}, {x, 0.65, z}, 0.03, 0.03, 16));
  addPart(scene, "legs", legs, {0.45F, 0.3F, 0.18F});
  const double top = 0.7 + settings.layer;
  addPart(scene, "paper", card({0.35, top, 0.2}, {0.2, 0.0, 0.0}, {0.0, 0.0, -0.14}), {0.9F, 0.9F, 0.85F});
  Material kettle = mirrorMaterial(settings.reflectance);
  kettle.name = "kettle";
  addPart(scene, movedMesh(kettleBody(settings.tessellation), 0.22, 0.0, {-0.15, 0.7, 0.0}), kettle);
  addPart(scene, movedMesh(kettleFittings(settings.tessellation), 0.22, 0.0, {-0.15, 0.7, 0.0}),
          plain("handle and spout", {0.1F, 0.1F, 0.1F}));
  addPart(scene, movedMesh(chair(), 1.0, 180.0, {0.2, 0.0, 0.95}), plain("chair", {0.65F, 0.25F, 0.15F}));
  addPart(scene, movedMesh(statue(8), 1.5, -60.0, {1.6, 0.0, 0.4}), plain("figure", {0.3F, 0.55F, 0.35F}));
  // A ball that touches the kettle's side.
  addPart(scene, ellipsoid({-0.15, 0.7 + 0.06, 0.22 + 0.045}, glm::dvec3(0.06), 12),
          plain("ball", {0.8F, 0.7F, 0.1F}));
  scene.lights = {lightTowards({-0.8, 4.6, 2.2}, {0.0, 0.7, 0.0}, glm::dvec2(0.3))};
  setMovingCamera(scene, orbitCamera({-0.1, 0.8, 0.0}, 1.7, 12.0, 24.0),
                  orbitCamera({-0.1, 0.8, 0.0}, 1.5, 32.0, 18.0), 2.0);
  return scene;
}

const RegisteredScene<MirrorRoomSettings> kMirrorRoom{
    {.name = "mirrors/room",
     .version = 1,
     .summary = "Mirroring kettle on a table in a room with a chair, a figure, a ball in contact and a thin "
                "sheet; the "
                "camera moves for 2 s",
     .source = "stand-in for Roger 2008, Figs. 1.9, 2.13, 2.14 and 2.18"},
    buildMirrorRoom};

struct MirrorKitchenSettings {
  int tessellation = 28;
  int bounceSurfaces = 2;
  double reflectance = 0.6;
  ObjectMotion motion;
  static const SettingsTable<MirrorKitchenSettings>& table() {
    using S = MirrorKitchenSettings;
    static const SettingsTable<S> kTable = {
        {&S::tessellation,
         "tessellation",
         {6, 96},
         "segments",
         "Segments of everything round; 28: 83 K triangles",
         "Roger 2008, section 3.5 (83 K triangles)"},
        {&S::bounceSurfaces,
         "mirrors",
         {1, 3},
         "",
         "What reflects: kettle and pots, the worktops, the tiles"},
        {&S::reflectance, "reflectance", {0.0, 1.0}, "", "Share of the light that kettle and pots reflect"},
        {&S::motion, "motion", kMotionText}};
    return kTable;
  }
};

/// A closed lathe of a pot, a plate or a cup: outside, rim, inside.
Mesh vessel(double radius, double height, double foot, int segments) {
  std::vector<glm::dvec2> profile = {{0.0, 0.0}, {foot, 0.0}, {foot, 0.0}};
  for (int i = 1; i <= segments / 2; ++i) {
    const double t = 2.0 * i / segments;
    profile.emplace_back(foot + (radius - foot) * std::sqrt(t), height * t);
  }
  for (int i = segments / 2; i >= 1; --i) {
    const double t = 2.0 * i / segments;
    profile.emplace_back(0.94 * (foot + (radius - foot) * std::sqrt(t)), height * (0.05 + 0.95 * t));
  }
  profile.emplace_back(0.0, 0.05 * height);
  return lathe(glm::dvec3(0.0), profile, 2 * segments);
}

Scene buildMirrorKitchen(const MirrorKitchenSettings& settings) {
  Scene scene;
  const int n = settings.tessellation;
  addCheckeredGround(scene, 5.0, 0.4);
  addPart(scene, "back wall", card({0.0, 1.25, -2.5}, {2.5, 0.0, 0.0}, {0.0, 1.25, 0.0}),
          {0.75F, 0.72F, 0.62F});
  addPart(scene, "left wall", card({-2.5, 1.25, 0.0}, {0.0, 0.0, -2.5}, {0.0, 1.25, 0.0}),
          {0.6F, 0.66F, 0.7F});
  addPart(scene, "right wall", card({2.5, 1.25, 0.0}, {0.0, 0.0, 2.5}, {0.0, 1.25, 0.0}),
          {0.72F, 0.62F, 0.55F});
  const Material shiny = [&] {
    Material material = mirrorMaterial(settings.reflectance);
    material.name = "steel";
    return material;
  }();
  Material worktop = plain("worktop", {0.25F, 0.25F, 0.28F});
  if (settings.bounceSurfaces >= 2) worktop.mirror = glm::vec3(0.3F), worktop.fresnel = true;
  Material tile = plain("tiles", {0.7F, 0.75F, 0.78F});
  if (settings.bounceSurfaces >= 3) tile.mirror = glm::vec3(0.1F), tile.fresnel = true;

  // Cupboards with doors and knobs along the back, worktop above, tiles on the wall.
  Mesh cupboards, knobs, tiles;
  for (int i = 0; i < 8; ++i) {
    const double x = -2.4 + 0.6 * i;
    append(cupboards, box({x, 0.05, -2.5}, {x + 0.58, 0.85, -1.95}));
    append(cupboards, box({x + 0.03, 0.1, -1.95}, {x + 0.55, 0.8, -1.93}));
    append(knobs, ellipsoid({x + 0.5, 0.7, -1.91}, glm::dvec3(0.02), 4));
    if (i != 3 && i != 4) append(cupboards, box({x, 1.55, -2.5}, {x + 0.58, 2.2, -2.15}));
  }
  addPart(scene, cupboards, plain("cupboards", {0.55F, 0.4F, 0.25F}));
  addPart(scene, knobs, plain("knobs", {0.2F, 0.2F, 0.2F}));
  addPart(scene, box({-2.45, 0.86, -2.5}, {2.45, 0.9, -1.9}), worktop);
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 48; ++column) {
      const double x = -2.4 + 0.1 * column, y = 0.91 + 0.1 * row;
      append(tiles, box({x + 0.004, y + 0.004, -2.5}, {x + 0.096, y + 0.096, -2.49}));
    }
  addPart(scene, tiles, tile);

  // The kettle slides along the worktop and turns, the chairs are moved, the bowl of fruit turns.
  const PartMotion kettle{
      .pivot = {0.5, 0.9, -2.15}, .turnDegS = 45.0, .travel = {0.3, 0.0, 0.0}, .periodS = 4.0};
  addPart(scene, movedMesh(kettleBody(n), 0.2, 0.0, {0.5, 0.9, -2.15}), shiny);
  moveLastPart(scene, settings.motion, kettle);
  addPart(scene, movedMesh(kettleFittings(n), 0.2, 0.0, {0.5, 0.9, -2.15}),
          plain("handle", {0.1F, 0.1F, 0.1F}));
  moveLastPart(scene, settings.motion, kettle);
  Mesh pots, crockery, fruit;
  for (const double x : {-0.3, -0.75, -1.2})
    append(pots, movedMesh(vessel(0.17, 0.2, 0.15, n), 1.0, 0.0, {x, 0.9, -2.2}));
  addPart(scene, pots, shiny);
  // The table: mirror ball as a lamp, plates, cups, a bowl of fruit.
  addPart(scene, box({-0.9, 0.7, -0.6}, {0.9, 0.74, 0.4}), worktop);
  Mesh legs;
  for (const double x : {-0.82, 0.82})
    for (const double z : {-0.52, 0.32}) append(legs, frustum({x, 0.0, z}, {x, 0.7, z}, 0.03, 0.03, 2 * n));
  addPart(scene, legs, plain("table legs", {0.45F, 0.3F, 0.18F}));
  for (const double x : {-0.6, 0.0, 0.6})
    for (const double z : {-0.4, 0.2}) {
      append(crockery, movedMesh(vessel(0.12, 0.02, 0.07, n), 1.0, 0.0, {x, 0.74, z}));
      append(crockery, movedMesh(vessel(0.04, 0.08, 0.03, n / 2), 1.0, 0.0, {x + 0.18, 0.74, z}));
    }
  append(crockery, movedMesh(vessel(0.18, 0.1, 0.08, n), 1.0, 0.0, {0.3, 0.74, -0.1}));
  addPart(scene, crockery, plain("crockery", {0.85F, 0.85F, 0.88F}));
  for (int i = 0; i < 7; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 6.0, r = i == 6 ? 0.0 : 0.09;
    append(fruit, ellipsoid({0.3 + r * std::cos(angle), 0.85, -0.1 + r * std::sin(angle)}, glm::dvec3(0.045),
                            n / 3));
  }
  addPart(scene, fruit, plain("fruit", {0.8F, 0.35F, 0.1F}));
  moveLastPart(scene, settings.motion, {.pivot = {0.3, 0.85, -0.1}, .turnDegS = 60.0});
  addPart(scene, ellipsoid({-0.3, 0.74 + 0.16, -0.1}, glm::dvec3(0.16), 2 * n), shiny);
  Mesh chairs;
  for (const double x : {-0.5, 0.5}) {
    append(chairs, movedMesh(chair(), 1.0, 0.0, {x, 0.0, -0.8}));
    append(chairs, movedMesh(chair(), 1.0, 180.0, {x, 0.0, 0.65}));
  }
  addPart(scene, chairs, plain("chairs", {0.6F, 0.3F, 0.15F}));
  moveLastPart(scene, settings.motion, {.travel = {0.15, 0.0, 0.2}, .periodS = 3.0});
  scene.lights = {lightTowards({0.6, 4.6, 2.6}, {0.0, 0.8, -0.6}, glm::dvec2(0.4))};
  setStillCamera(scene, {{0.25, 1.75, 2.3}, {-0.05, 0.75, -0.9}, {0.0, 1.0, 0.0}, 46.0});
  return scene;
}

const RegisteredScene<MirrorKitchenSettings> kMirrorKitchen{
    {.name = "mirrors/kitchen",
     .version = 1,
     .summary = "Kitchen of 83 K triangles with a mirroring kettle, pots, ball and worktops",
     .source = "stand-in for Roger 2008, Figs. 3.10 and 5.7"},
    buildMirrorKitchen};

}  // namespace
}  // namespace limen::scene
