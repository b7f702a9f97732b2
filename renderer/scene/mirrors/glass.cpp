// SPDX-License-Identifier: BSD-3-Clause
// Glass among objects (refraction: named in Roger 2008, section 3.3.5): a ball, a ball with a bubble, a slab,
// a prism that reflects totally, and a mirror behind.
#include "renderer/scene/mirrors/mirror_parts.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

enum class GlassShape { Ball, Bubble, Slab, Prism };
constexpr EnumNames<GlassShape, 4> enumNames(GlassShape) {
  return {{{{GlassShape::Ball, "ball"},
            {GlassShape::Bubble, "bubble"},
            {GlassShape::Slab, "slab"},
            {GlassShape::Prism, "prism"}}}};
}

struct MirrorGlassSettings {
  GlassShape shape = GlassShape::Ball;
  double index = 1.5, transmittance = 0.9;
  int tessellation = 32;
  static const SettingsTable<MirrorGlassSettings>& table() {
    using S = MirrorGlassSettings;
    static const SettingsTable<S> kTable = {
        {&S::shape, "shape", "Of the glass: a ball, a ball with a bubble in it, an upright slab, a prism"},
        {&S::index, "refractive_index", {0.25, 4.0}, "", "Of the glass, relative to air"},
        {&S::transmittance,
         "transmittance",
         {0.0, 1.0},
         "",
         "Share of the light that a surface lets through"},
        {&S::tessellation, "tessellation", {1, 128}, "segments", "Segments in a quarter circle of balls"}};
    return kTable;
  }
};

/// Upright prism over the triangle (a, b, c) of the xz plane, counter-clockwise seen from above (+y, with z
/// towards the viewer).
Mesh prism(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, double low, double high) {
  Mesh mesh;
  for (const double y : {low, high})
    for (const glm::dvec2 p : {a, b, c}) mesh.positions.emplace_back(p.x, y, p.y);
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}};
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t j = (i + 1) % 3;
    mesh.triangles.emplace_back(i, i + 3, j + 3);
    mesh.triangles.emplace_back(i, j + 3, j);
  }
  const glm::dvec3 inside((a.x + b.x + c.x) / 3.0, 0.5 * (low + high), (a.y + b.y + c.y) / 3.0);
  for (glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 p = mesh.positions[t.x];
    if (glm::dot(glm::cross(mesh.positions[t.y] - p, mesh.positions[t.z] - p), p - inside) < 0.0)
      std::swap(t.y, t.z);
  }
  return mesh;
}

Scene buildMirrorGlass(const MirrorGlassSettings& settings) {
  Scene scene;
  addCheckeredGround(scene, 6.0, 0.25);
  Material glass;
  glass.name = "glass";
  glass.albedo = glm::vec3(0.02F);
  glass.transmittance = glm::vec3(static_cast<float>(settings.transmittance));
  glass.refractiveIndex = static_cast<float>(settings.index);
  const glm::dvec3 middle(0.0, 0.5, 0.0);
  switch (settings.shape) {
    case GlassShape::Ball:
    case GlassShape::Bubble:
      addPart(scene, ellipsoid(middle, glm::dvec3(0.48), settings.tessellation), glass);
      break;
    case GlassShape::Slab:
      addPart(scene, box({-0.6, 0.02, -0.1}, {0.6, 0.98, 0.1}), glass);
      break;
    case GlassShape::Prism:
      addPart(scene, prism({-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}, 0.02, 0.98), glass);
      break;
  }
  if (settings.shape == GlassShape::Bubble) {
    // Behind its front is air, seen from glass.
    Material air = glass;
    air.name = "bubble";
    air.refractiveIndex = static_cast<float>(1.0 / settings.index);
    addPart(scene, ellipsoid(middle, glm::dvec3(0.25), settings.tessellation), air);
  }
  addPart(scene, "red box", box({0.8, 0.0, -0.4}, {1.1, 0.7, 0.0}), {0.7F, 0.25F, 0.2F});
  addPart(scene, "blue box", box({-1.3, 0.0, -0.8}, {-0.9, 0.6, -0.4}), {0.25F, 0.5F, 0.7F});
  addPart(scene, card({0.0, 0.6, -1.4}, {0.9, 0.0, 0.0}, {0.0, 0.6, 0.0}), mirrorMaterial(0.8));
  frameStanding(scene, 1.0, 1.0);
  return scene;
}

const RegisteredScene<MirrorGlassSettings> kMirrorGlass{
    {.name = "mirrors/glass",
     .version = 1,
     .summary = "A ball, bubble, slab or prism of glass before a mirror, on a checkered floor",
     .source = "bench; refraction: Roger 2008, section 3.3.5"},
    buildMirrorGlass};

}  // namespace
}  // namespace limen::scene
