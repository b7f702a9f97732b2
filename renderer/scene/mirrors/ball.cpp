// SPDX-License-Identifier: BSD-3-Clause
// The smallest scene with a mirror (Roger 2008, sections 2.3, 3.5 and 5.4).
#include "renderer/scene/mirrors/mirror_parts.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct MirrorBallSettings {
  int tessellation = 48;
  double reflectance = 0.8, glossRad = 0.0;
  static const SettingsTable<MirrorBallSettings>& table() {
    using S = MirrorBallSettings;
    static const SettingsTable<S> kTable = {
        {&S::tessellation, "tessellation", {1, 128}, "segments", "Segments in a quarter circle of the ball"},
        {&S::reflectance, "reflectance", {0.0, 1.0}, "", "Share of the light that the ball reflects"},
        {&S::glossRad,
         "gloss",
         {0.0, 1.0},
         "rad",
         "Half-angle of the cone from which the ball gathers light",
         "Roger 2008, Fig. 5.10"}};
    return kTable;
  }
};

/// A ball among a cone, two boxes and a checkered floor, one of the boxes in contact with it.
Scene buildMirrorBall(const MirrorBallSettings& settings) {
  const glm::dvec3 centre(0.0, 0.5, 0.0);
  Scene scene;
  addCheckeredGround(scene, 6.0, 0.25);
  addPart(scene, ellipsoid(centre, glm::dvec3(0.5), settings.tessellation),
          mirrorMaterial(settings.reflectance, settings.glossRad));
  addPart(scene, "touching box", box({0.5, 0.3, -0.2}, {0.8, 0.7, 0.2}), {0.7F, 0.25F, 0.2F});
  addPart(scene, "box", box({-1.2, 0.0, 0.2}, {-0.8, 0.6, 0.6}), {0.25F, 0.5F, 0.7F});
  addPart(scene, "cone", frustum({0.2, 0.0, 1.0}, {0.2, 0.5, 1.0}, 0.2, 0.0, 48), {0.3F, 0.6F, 0.3F});
  frameStanding(scene, 1.0, 1.0);
  return scene;
}

const RegisteredScene<MirrorBallSettings> kMirrorBall{
    {.name = "mirrors/ball",
     .version = 1,
     .summary = "Mirroring ball among objects near and in contact, on a checkered floor",
     .source = "stand-in for Roger 2008, Figs. 2.13 and 5.10"},
    buildMirrorBall};

}  // namespace
}  // namespace limen::scene
