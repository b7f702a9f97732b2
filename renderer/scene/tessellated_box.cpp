// SPDX-License-Identifier: BSD-3-Clause
// A box of any number of triangles that look the same, for costs that should not depend on them.
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct TessellatedBoxSettings {
  int cells = 9;
  static const SettingsTable<TessellatedBoxSettings>& table() {
    using S = TessellatedBoxSettings;
    static const SettingsTable<S> kTable = {
        {&S::cells, "cells", {1, 1024}, "", "Squares along each edge: 12 times their square triangles"}};
    return kTable;
  }
};

Scene buildTessellatedBox(const TessellatedBoxSettings& settings) {
  Mesh mesh;
  const glm::dvec3 x(0.5, 0.0, 0.0), y(0.0, 0.4, 0.0), z(0.0, 0.0, 0.45);
  const auto side = [&](glm::dvec3 out, glm::dvec3 a, glm::dvec3 b) {
    append(mesh, cardGrid(out, a, b, settings.cells));
    append(mesh, cardGrid(-out, b, a, settings.cells));
  };
  side(x, y, z), side(y, z, x), side(z, x, y);
  Scene scene;
  addPart(scene, "box", mesh, {0.6F, 0.6F, 0.58F});
  scene.lights = {lightTowards({1.5, 3.0, 2.0}, glm::dvec3(0.0), glm::dvec2(0.3))};
  setStillCamera(scene, orbitCamera(glm::dvec3(0.0), 2.6, 30.0, 25.0));
  return scene;
}

const RegisteredScene<TessellatedBoxSettings> kTessellatedBox{
    {.name = "tessellated_box",
     .version = 1,
     .summary = "Box whose sides are divided into any number of triangles",
     .source = "stand-in for the meshes of Gaitatzes 2012, table 8"},
    buildTessellatedBox};

}  // namespace
}  // namespace limen::scene
