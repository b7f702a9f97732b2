// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct RestingSphereSettings {
  double tilt = 0.0, radius = 0.3;
  int tessellation = 16;
  static const SettingsTable<RestingSphereSettings>& table() {
    using S = RestingSphereSettings;
    static const SettingsTable<S> kTable = {
        {&S::tilt, "tilt", {0.0, 80.0}, "deg", "Angle between the plane and the light"},
        {&S::radius, "radius", {0.02, 0.5}, "m", "Radius of the sphere"},
        {&S::tessellation, "tessellation", {1, 48}, "segments", "Segments in a quarter circle"}};
    return kTable;
  }
};

/// A shadow that begins where caster and receiver touch, and a plane that may be tilted away from the light:
/// a depth bias trades one for the other. The plane casts too, so that a shadow map contains all of it.
Scene buildRestingSphere(const RestingSphereSettings& settings) {
  const double tilt = glm::radians(settings.tilt), radius = settings.radius;
  const glm::dvec3 up(-std::sin(tilt), std::cos(tilt), 0.0), along(std::cos(tilt), std::sin(tilt), 0.0);
  constexpr double kHalfSide = 1.5, kLightHeight = 4.0, kLightSide = 0.4;
  Scene scene;
  addPart(scene, "plane", card(glm::dvec3(0.0), {0.0, 0.0, kHalfSide}, kHalfSide * along),
          {0.6F, 0.6F, 0.58F});
  addPart(scene, "sphere", sphere(radius * up, radius, settings.tessellation), {0.7F, 0.62F, 0.5F});
  scene.lights = {lightTowards({0.0, kLightHeight, 0.0}, glm::dvec3(0.0), glm::dvec2(kLightSide))};
  setStillCamera(scene, orbitCamera(glm::dvec3(0.0), 5.0, -35.0, 50.0));
  return scene;
}

struct StandingCardSettings {
  double viewSize = 2.0;
  static const SettingsTable<StandingCardSettings>& table() {
    static const SettingsTable<StandingCardSettings> kTable = {
        {&StandingCardSettings::viewSize,
         "view_size",
         {1e-7, 3.0},
         "m",
         "Extent of the ground, from the foot of the card on, that the picture shows"}};
    return kTable;
  }
};

/// A card of no thickness that stands on the ground with its back to the light: behind its foot, points of
/// the ground and what hides the light from them come as close as the picture shows. A point at x sees the
/// light's rays cross the card at heights up to x (H + a) / (H - a + x) with H = 1.5 m and a = 0.2 m / sqrt
/// 2, so that everything up to 0.4 m behind the card is in its umbra.
Scene buildStandingCard(const StandingCardSettings& settings) {
  constexpr double kHeight = 0.5, kHalfWidth = 0.6, kLight = 1.5, kLightSide = 0.4;
  const double size = settings.viewSize;
  Scene scene;
  // All of it before the light.
  addGround(scene, 5.8);
  addPart(scene, "card", card({0.0, 0.5 * kHeight, 0.0}, {0.0, 0.5 * kHeight, 0.0}, {0.0, 0.0, kHalfWidth}),
          {0.7F, 0.62F, 0.5F});
  scene.lights = {lightTowards({-kLight, kLight, 0.0}, glm::dvec3(0.0), glm::dvec2(kLightSide))};
  // From no nearer than what the camera's near plane leaves; a narrower view shows less from there.
  const glm::dvec3 target(0.5 * size, 0.0, 0.1 * size), away(1.2, 1.3, 0.3);
  const double distance = std::max(size, 0.01);
  const double fov = 2.0 * std::atan(0.5 * size / (distance * glm::length(away)));
  setStillCamera(scene, {target + distance * away, target, {0.0, 1.0, 0.0}, glm::degrees(fov)});
  return scene;
}

const RegisteredScene<StandingCardSettings> kStandingCard{
    {.name = "standing_card",
     .version = 1,
     .summary = "Card that stands on the ground, seen from behind at any distance from its foot",
     .source = "bench"},
    buildStandingCard};

const RegisteredScene<RestingSphereSettings> kRestingSphere{
    {.name = "resting_sphere",
     .version = 1,
     .summary = "Sphere that touches a plane straight below the light; the plane may be tilted",
     .source = "stand-in for Schwarz 2009, Fig. 4.15"},
    buildRestingSphere};

}  // namespace
}  // namespace limen::scene
