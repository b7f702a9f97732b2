// SPDX-License-Identifier: BSD-3-Clause
// Scenes of rational and bicubic patches with the counts of Schwarz 2009, Table 7.4, and solids from NURBS.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scene/curved/herd_animal.h"
#include "renderer/scene/curved/nurbs_solids.h"
#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/curved/tea_table.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/patch_convert.h"
#include "renderer/surfaces/quadrics.h"

namespace limen::scene {
namespace {

const char* const kPatchSegments = "Segments along each side of a patch in the mesh";

enum class SpheresView { Overview, CloseUp };
constexpr EnumNames<SpheresView, 2> enumNames(SpheresView) {
  return {{{{SpheresView::Overview, "overview"}, {SpheresView::CloseUp, "close_up"}}}};
}

struct SpheresSettings {
  SpheresView view = SpheresView::Overview;
  int tessellation = 4;
  int64_t seed = 1;
  static const SettingsTable<SpheresSettings>& table() {
    using S = SpheresSettings;
    static const SettingsTable<S> kTable = {
        {&S::view, "view", "All spheres, or a few of them that fill the picture"},
        {&S::tessellation, "tessellation", {1, 6}, "segments", kPatchSegments},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of sizes and places"}};
    return kTable;
  }
};

/// 20 x 10 x 20 spheres of eight octants, raised to degree 3 like all patches of the thesis' scenes.
Scene buildSpheres(const SpheresSettings& settings) {
  const surfaces::PatchSet sphere = elevated(surfaces::unitSphere(), 3, 3);
  Random random(settings.seed);
  constexpr double kCell = 0.25, kLowest = 0.2;
  surfaces::PatchSet all;
  for (int z = 0; z < 20; ++z)
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 20; ++x) {
        const double radius = random.uniform(0.05, 0.1);
        const glm::dvec3 shift = random.direction() * random.uniform(0.0, 0.5 * kCell - radius);
        const glm::dvec3 centre =
            glm::dvec3(x - 9.5, y + 0.5, z - 9.5) * kCell + glm::dvec3(0.0, kLowest, 0.0);
        append(all, transformed(sphere, glm::scale(glm::translate(glm::dmat4(1.0), centre + shift),
                                                   glm::dvec3(radius))));
      }
  Scene scene;
  addGround(scene, 24.0);
  addSurface(scene, "spheres", std::move(all), settings.tessellation, {0.6F, 0.65F, 0.72F});
  const double height = kLowest + 10 * kCell;
  frameStanding(scene, height, 10 * kCell);
  const glm::dvec3 middle(0.0, 0.5 * height, 0.0), corner(0.5, 0.6 * height, 9.5 * kCell);
  setStillCamera(scene, settings.view == SpheresView::Overview ? orbitCamera(middle, 9.0, 30.0, 40.0)
                                                               : orbitCamera(corner, 0.9, 20.0, 15.0, 45.0));
  return scene;
}

struct TeaTableSettings {
  int tessellation = 8;
  static const SettingsTable<TeaTableSettings>& table() {
    static const SettingsTable<TeaTableSettings> kTable = {
        {&TeaTableSettings::tessellation, "tessellation", {1, 32}, "segments", kPatchSegments}};
    return kTable;
  }
};

Scene buildTeaTable(const TeaTableSettings& settings) {
  Scene scene;
  addGround(scene, 11.5);
  addSurface(scene, "tea_table", teaTable(), settings.tessellation, {0.75F, 0.7F, 0.62F});
  frameStanding(scene, 1.3, 0.85);
  scene.lights[0].size = glm::dvec2(0.5);
  setStillCamera(scene, orbitCamera({0.0, 0.85, 0.0}, 3.6, 20.0, 40.0));
  return scene;
}

struct HerdSettings {
  int animals = 8, tessellation = 1;
  static const SettingsTable<HerdSettings>& table() {
    using S = HerdSettings;
    static const SettingsTable<S> kTable = {
        {&S::animals, "animals", {1, 8}, "", "Animals of 11,532 patches each", "Schwarz 2009, Table 7.4"},
        {&S::tessellation, "tessellation", {1, 4}, "segments", kPatchSegments}};
    return kTable;
  }
};

Scene buildHerd(const HerdSettings& settings) {
  const surfaces::PatchSet animal = herdAnimal();
  surfaces::PatchSet herd;
  for (int i = 0; i < settings.animals; ++i) {
    const double x = 1.9 * (i % 4 - 1.5) + 0.5 * (i / 4), z = -1.3 * (i / 4) + 0.4 + 0.35 * std::sin(2.3 * i);
    const glm::dmat4 place = glm::translate(glm::dmat4(1.0), {x, 0.0, z});
    append(herd, transformed(animal, glm::rotate(place, 0.5 * std::sin(1.7 * i), {0.0, 1.0, 0.0})));
  }
  Scene scene;
  addGround(scene, 36.0);
  addSurface(scene, "herd", std::move(herd), settings.tessellation, {0.62F, 0.5F, 0.4F});
  frameStanding(scene, 1.4, 4.0);
  scene.lights[0].size = glm::dvec2(2.0);
  setStillCamera(scene, orbitCamera({0.5, 0.4, -0.3}, 10.5, 12.0, 30.0));
  return scene;
}

struct NurbsSettings {
  int tessellation = 8;
  static const SettingsTable<NurbsSettings>& table() {
    static const SettingsTable<NurbsSettings> kTable = {
        {&NurbsSettings::tessellation, "tessellation", {1, 32}, "segments", kPatchSegments}};
    return kTable;
  }
};

Scene buildNurbs(const NurbsSettings& settings) {
  Scene scene;
  addGround(scene, 12.0);
  for (const NurbsSolid& solid : nurbsSolids()) {
    scene.nurbs.push_back({solid.surface, static_cast<uint32_t>(scene.parts.size()),
                           static_cast<uint32_t>(scene.surfaces.patches.size())});
    addSurface(scene, solid.name, solid.patches, settings.tessellation, solid.albedo);
  }
  frameStanding(scene, 1.0, 1.3);
  return scene;
}

struct TrimmedSettings {
  int tessellation = 16;
  static const SettingsTable<TrimmedSettings>& table() {
    static const SettingsTable<TrimmedSettings> kTable = {
        {&TrimmedSettings::tessellation, "tessellation", {1, 32}, "segments", kPatchSegments}};
    return kTable;
  }
};

Scene buildTrimmed(const TrimmedSettings& settings) {
  Scene scene;
  addGround(scene, 12.0);
  for (const NurbsSolid& solid : trimmedSolids())
    addSurface(scene, solid.name, solid.patches, settings.tessellation, solid.albedo);
  frameStanding(scene, 1.0, 1.3);
  return scene;
}

const RegisteredScene<SpheresSettings> kSpheres{
    {.name = "curved/spheres",
     .version = 1,
     .summary = "4,000 spheres of eight rational bicubic octants each: 32,000 patches",
     .source = "stand-in with the same count for Schwarz 2009, Table 7.4"},
    buildSpheres};

const RegisteredScene<TeaTableSettings> kTeaTable{
    {.name = "curved/tea_table",
     .version = 1,
     .summary = "Table laid for tea: 332 rational bicubic patches",
     .source = "stand-in with the same count for Schwarz 2009, Table 7.4"},
    buildTeaTable};

const RegisteredScene<HerdSettings> kHerd{
    {.name = "curved/herd",
     .version = 1,
     .summary = "Eight animals of 11,532 bicubic patches each, made by code in place of the Killeroo herd",
     .source = "stand-in with the same count for Schwarz 2009, Table 7.4"},
    buildHerd};

const RegisteredScene<NurbsSettings> kNurbs{
    {.name = "curved/nurbs_solids",
     .version = 1,
     .summary = "Solids from NURBS of degrees 2 to 5, uneven and multiple knots, turned into Bézier patches",
     .source = "Schwarz 2009, section 6.1.4"},
    buildNurbs};

const RegisteredScene<TrimmedSettings> kTrimmed{
    {.name = "curved/trimmed",
     .version = 1,
     .summary = "The solids of curved/nurbs_solids with holes, trimmed by rational curves in their domains",
     .source = "Schwarz 2009, section 6.1.4"},
    buildTrimmed};

}  // namespace
}  // namespace limen::scene
