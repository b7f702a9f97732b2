// SPDX-License-Identifier: BSD-3-Clause
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

const RegisteredScene<RestingSphereSettings> kRestingSphere{
    {.name = "resting_sphere",
     .version = 1,
     .summary = "Sphere that touches a plane straight below the light; the plane may be tilted",
     .source = "stand-in for Schwarz 2009, Fig. 4.15"},
    buildRestingSphere};

}  // namespace
}  // namespace limen::scene
