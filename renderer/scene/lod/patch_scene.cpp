// SPDX-License-Identifier: BSD-3-Clause
// The stimulus of the patch experiment (SP-54; Schwarz 2009, section 10.4.1): a bicubic B-spline patch with a
// tip, before a dark grey background, that the camera approaches. The thesis shows the patch in a figure and
// gives no control points: a tent of 16, pinched towards its middle so that the middle stands out as a tip
// against the background.
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

Scene buildPatches(const ParameterValues& values) {
  Scene scene;
  scene.patches = {tent(values.real("tip_height"), values.real("pinch"))};
  const std::vector<int> factors = {static_cast<int>(values.integer("factor_fine")),
                                    static_cast<int>(values.integer("factor_middle")),
                                    static_cast<int>(values.integer("factor_coarse"))};
  Material material{"patch", {0.7F, 0.68F, 0.62F}};
  material.surface = SurfaceKind::BicubicPatch;
  if (values.real("contrast") > 0.0) {
    material.pattern.kind = Pattern::Kind::ValueNoise;
    material.pattern.contrast = values.real("contrast");
  }
  const LodSet set = patchLevels(scene.patches[0], factors);
  addLodObject(scene, set, {}, material, switchDistances(values, set.levels.size()));
  const glm::dvec3 middle = scene.lodObjects[0].bounds.centre();
  scene.lights = {lightTowards(middle + glm::dvec3(-60.0, 70.0, 30.0), middle, glm::dvec2(4.0))};
  Ride ride = rideOf(values);
  ride.target = middle;
  ride.back = orbitCamera(glm::dvec3(0.0), 1.0, values.real("azimuth_deg"), values.real("elevation_deg")).eye;
  ride.nearest = 0.8;
  setRide(scene, ride);
  return scene;
}

std::vector<Parameter> patchParameters() {
  const char* const kSource = "Schwarz 2009, section 10.4.1";
  std::vector<Parameter> out = {
      integerParameter("factor_fine", 9, 1, 64, "", "Tessellation factor of the finest level", kSource),
      integerParameter("factor_middle", 3, 1, 64, "", "Tessellation factor of the second level", kSource),
      integerParameter("factor_coarse", 2, 1, 64, "", "Tessellation factor of the coarsest level", kSource),
      realParameter("tip_height", 2.2, 0.1, 4.0, "world units", "Height of the middle control points",
                    "reconstructed; the patch is 1 wide"),
      realParameter("pinch", 0.35, 0.05, 1.0, "",
                    "Middle control points' distance from the middle, as a share of an even net's",
                    "reconstructed"),
      realParameter("elevation_deg", 18.0, 0.0, 80.0, "deg", "Of the eye above the patch's plane"),
      realParameter("azimuth_deg", 30.0, -180.0, 180.0, "deg", "Of the eye around the patch"),
      realParameter("contrast", 0.0, 0.0, 1.0, "", "Contrast of the solid texture; the thesis shows none")};
  for (const std::vector<Parameter>& more :
       {switchParameters(3.0, 100.0), rideParameters(5.0, 50.0, 0.8, 20.0)})
    out.insert(out.end(), more.begin(), more.end());
  return out;
}

const Registered<SceneInfo> kPatchSceneRegistered{
    SceneInfo{.name = "lod/patch",
              .version = 1,
              .summary = "Bicubic B-spline patch with a tip, tessellated 9, 3 or 2 times a side, approached",
              .source = "Schwarz 2009, section 10.4.1",
              .parameters = patchParameters(),
              .build = buildPatches}};

}  // namespace
}  // namespace limen::scene
