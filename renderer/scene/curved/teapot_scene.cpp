// SPDX-License-Identifier: BSD-3-Clause
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/curved/teapot.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::scene {
namespace {

struct TeapotSettings {
  int tessellation = 8;
  static const SettingsTable<TeapotSettings>& table() {
    static const SettingsTable<TeapotSettings> kTable = {{&TeapotSettings::tessellation,
                                                          "tessellation",
                                                          {1, 64},
                                                          "segments",
                                                          "Segments along each side of a patch in the mesh"}};
    return kTable;
  }
};

/// 1 high, on a ground plane.
Scene buildTeapot(const TeapotSettings& settings) {
  Scene scene;
  addGround(scene, 9.0);
  const double scale = 1.0 / 3.15;
  addSurface(scene, "teapot", transformed(teapot(), glm::scale(glm::dmat4(1.0), glm::dvec3(scale))),
             settings.tessellation, {0.72F, 0.66F, 0.58F});
  frameStanding(scene, 1.0, 3.525 * scale);
  return scene;
}

const RegisteredScene<TeapotSettings> kTeapot{
    {.name = "curved/teapot",
     .version = 1,
     .summary = "Newell's teapot over a plane: 32 bicubic patches, eight sides collapsed to points",
     .source = "Newell 1975; Schwarz 2009, section 6.1.3"},
    buildTeapot};

}  // namespace
}  // namespace limen::scene
