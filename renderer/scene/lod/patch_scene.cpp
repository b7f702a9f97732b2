// SPDX-License-Identifier: BSD-3-Clause
// The stimulus of the patch experiment (SP-54; Schwarz 2009, section 10.4.1): a bicubic B-spline patch with a
// tip, in front of a dark grey background, that the camera approaches. The thesis shows the patch in a figure
// and gives no control points: a tent of 16, pinched towards its middle so that the middle stands out as a
// tip against the background.
#include "renderer/scene/lod/bspline_patch.h"
#include "renderer/scene/lod_scene_parameters.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

/// About 1 wide. Heights of the control points: `tip` in the middle four, 0 at the edges, below 0 in the
/// corners.
BicubicPatch tent(double tip, double pinch) {
  // 1 / (2 x the half-width of the patch for control points at +-1.5 and +-0.5 pinch).
  const double half = 1.5 / 6.0 + (4.0 - 1.0) / 6.0 * 0.5 * pinch, scale = 0.5 / half;
  constexpr std::array<double, 4> kSide = {-1.5, -0.5, 0.5, 1.5};
  BicubicPatch patch;
  for (size_t j = 0; j < 4; ++j)
    for (size_t i = 0; i < 4; ++i) {
      const bool innerX = i == 1 || i == 2, innerZ = j == 1 || j == 2;
      const double height = innerX && innerZ ? tip : innerX || innerZ ? 0.0 : -0.5 * tip;
      patch.points[i + 4 * j] = {scale * kSide[i] * (innerX ? pinch : 1.0), height,
                                 -scale * kSide[j] * (innerZ ? pinch : 1.0)};
    }
  return patch;
}

const char* const kPatchExperiment = "Schwarz 2009, section 10.4.1";

/// Number of pieces per side that each level is tessellated into.
struct FactorSettings {
  int fine = 9, middle = 3, coarse = 2;
  static const SettingsTable<FactorSettings>& table() {
    using S = FactorSettings;
    static const SettingsTable<S> kTable = {
        Binding(&S::fine, "fine", Range{1, 64}, "", "Factor of the finest level", kPatchExperiment)
            .formerly({"factor_fine"}),
        Binding(&S::middle, "middle", Range{1, 64}, "", "Factor of the second level", kPatchExperiment)
            .formerly({"factor_middle"}),
        Binding(&S::coarse, "coarse", Range{1, 64}, "", "Factor of the coarsest level", kPatchExperiment)
            .formerly({"factor_coarse"})};
    return kTable;
  }
};

struct PatchSettings {
  FactorSettings factors;
  double tipHeight = 2.2, pinch = 0.35;
  double elevationDeg = 18.0, azimuthDeg = 30.0;
  double contrast = 0.0;
  SwitchSettings switching{.distance = 3.0};
  double distance = 5.0;
  CameraMotion motion = Approach{.speed = 0.8};
  static const SettingsTable<PatchSettings>& table() {
    using S = PatchSettings;
    static const SettingsTable<S> kTable = {
        {&S::factors, "factors", "Tessellation factors of the levels"},
        {&S::tipHeight,
         "tip_height",
         {0.1, 4.0},
         "world units",
         "Height of the middle control points",
         "reconstructed; the patch is 1 wide"},
        {&S::pinch,
         "pinch",
         {0.05, 1.0},
         "",
         "Distance of the middle control points from the centre, as a share of that in an even net",
         "reconstructed"},
        {&S::elevationDeg,
         "elevation_deg",
         {0.0, 80.0},
         "deg",
         "Elevation of the eye above the patch's plane"},
        {&S::azimuthDeg, "azimuth_deg", {-180.0, 180.0}, "deg", "Azimuth of the eye around the patch"},
        {&S::contrast, "contrast", {0.0, 1.0}, "", "Contrast of the solid texture; the thesis shows none"},
        switchBinding(&S::switching),
        distanceBinding(&S::distance, 50.0),
        motionBinding(&S::motion)};
    return kTable;
  }
};

Scene buildPatches(const PatchSettings& settings) {
  Scene scene;
  scene.patches = {tent(settings.tipHeight, settings.pinch)};
  const std::vector<int> factors = {settings.factors.fine, settings.factors.middle, settings.factors.coarse};
  Material material{"patch", {0.7F, 0.68F, 0.62F}};
  material.surface = SurfaceKind::BicubicPatch;
  if (settings.contrast > 0.0) {
    material.pattern.kind = Pattern::Kind::ValueNoise;
    material.pattern.contrast = settings.contrast;
  }
  const LodSet set = patchLevels(scene.patches[0], factors);
  addLodObject(scene, set, {}, material, settings.switching.distances(set.levels.size()));
  const glm::dvec3 middle = scene.lodObjects[0].bounds.centre();
  scene.lights = {lightTowards(middle + glm::dvec3(-60.0, 70.0, 30.0), middle, glm::dvec2(4.0))};
  Ride ride;
  ride.distance = settings.distance;
  ride.target = middle;
  ride.back = orbitCamera(glm::dvec3(0.0), 1.0, settings.azimuthDeg, settings.elevationDeg).eye;
  ride.nearest = 0.8;
  setRide(scene, ride, settings.motion);
  return scene;
}

const RegisteredScene<PatchSettings> kPatchSceneRegistered{
    {.name = "lod/patch",
     .version = 1,
     .summary =
         "Bicubic B-spline patch with a tip, tessellated 9, 3 or 2 times per side, approached by the camera",
     .source = kPatchExperiment},
    buildPatches};

}  // namespace
}  // namespace limen::scene
