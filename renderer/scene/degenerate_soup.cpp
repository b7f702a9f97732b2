// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kSoupLightHeight = 3.0, kLightSize = 0.3;

enum class Flaw {
  None,
  RepeatedVertex,  ///< two corners are one vertex
  Collinear,       ///< three collinear points
  Point,           ///< three vertices at one point
  Sliver,          ///< height about 1e-7 of the length
  Duplicate,       ///< repeats another triangle's corners
  Flipped,         ///< repeats another triangle's corners, facing the other way
  Coplanar,        ///< overlaps another triangle in its plane
  TouchesLight,    ///< one corner in the plane of the light
  LiesInLight,     ///< all corners in the plane of the light
  Count
};

/// Adds triangles with each defect in turn.
class Soup {
 public:
  explicit Soup(int64_t seed) : random_(seed) {}

  void add(Flaw flaw) {
    switch (flaw) {
      case Flaw::RepeatedVertex: {
        corners();
        const uint32_t first = place(corner_[0]), second = place(corner_[1]);
        mesh_.triangles.emplace_back(first, second, second);
        return;
      }
      case Flaw::Collinear:
        corners(), corner_[2] = 0.5 * (corner_[0] + corner_[1]);
        break;
      case Flaw::Point:
        corners(), corner_[1] = corner_[2] = corner_[0];
        break;
      case Flaw::Sliver:
        corners(), corner_[2] = 0.5 * (corner_[0] + corner_[1]) + 2e-8 * random_.direction();
        break;
      // Corners of the last valid triangle, as new vertices.
      case Flaw::Duplicate:
        corner_ = sound_;
        break;
      case Flaw::Flipped:
        corner_ = {sound_[0], sound_[2], sound_[1]};
        break;
      case Flaw::Coplanar: {
        const glm::dvec3 middle = (sound_[0] + sound_[1] + sound_[2]) / 3.0;
        corner_ = {middle, sound_[1], sound_[1] + (sound_[2] - sound_[0])};
        break;
      }
      case Flaw::TouchesLight: {
        corners();
        const auto lower = [](const glm::dvec3& a, const glm::dvec3& b) { return a.y < b.y; };
        glm::dvec3& highest = *std::max_element(corner_.begin(), corner_.end(), lower);
        const glm::dvec3 touch(highest.x, kSoupLightHeight, highest.z), from = highest;
        // Small, since all of them are near the light and would darken the whole ground.
        for (glm::dvec3& corner : corner_) corner = touch + 0.2 * (corner - from);
        break;
      }
      case Flaw::LiesInLight: {
        corners();
        const double side = std::copysign(2.0 * kLightSize, corner_[0].x);
        // Beside the light: whether a triangle on it casts a shadow is undefined.
        for (glm::dvec3& corner : corner_) corner = {corner.x + side, kSoupLightHeight, corner.z};
        break;
      }
      case Flaw::None:
      case Flaw::Count:
        corners(), sound_ = corner_;
        break;
    }
    const uint32_t a = place(corner_[0]), b = place(corner_[1]), c = place(corner_[2]);
    mesh_.triangles.emplace_back(a, b, c);
  }

  const Mesh& mesh() const { return mesh_; }

 private:
  /// A valid triangle of about 0.15 in a slab halfway up.
  void corners() {
    // Braces fix the order of the draws.
    const glm::dvec3 middle{random_.uniform(-0.8, 0.8), random_.uniform(0.4, 1.4),
                            random_.uniform(-0.8, 0.8)};
    for (glm::dvec3& corner : corner_) corner = middle + 0.15 * random_.direction();
  }
  uint32_t place(glm::dvec3 position) {
    mesh_.positions.push_back(position);
    return static_cast<uint32_t>(mesh_.positions.size()) - 1;
  }

  Random random_;
  Mesh mesh_;
  std::array<glm::dvec3, 3> corner_{}, sound_{};
};

struct SoupSettings {
  int64_t triangles = 600, seed = 1;
  static const SettingsTable<SoupSettings>& table() {
    using S = SoupSettings;
    static const SettingsTable<S> kTable = {
        {&S::triangles, "triangles", {10, 100000}, "triangles", "Number of triangles of the soup"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the soup"}};
    return kTable;
  }
};

Scene buildDegenerateSoup(const SoupSettings& settings) {
  Soup soup(settings.seed);
  for (int64_t i = 0; i < settings.triangles; ++i)
    soup.add(static_cast<Flaw>(i % static_cast<int64_t>(Flaw::Count)));
  Scene scene;
  addGround(scene, 10.0);
  addPart(scene, "soup", soup.mesh(), {0.6F, 0.45F, 0.6F});
  scene.lights = {lightTowards({0.0, kSoupLightHeight, 0.0}, glm::dvec3(0.0), glm::dvec2(kLightSize))};
  setStillCamera(scene, orbitCamera({0.0, 0.4, 0.0}, 4.4, 15.0, 40.0));
  return scene;
}

const RegisteredScene<SoupSettings> kDegenerateSoupRegistered{
    {.name = "degenerate_soup",
     .version = 1,
     .summary = "Triangles without area, slivers, duplicates, coplanar overlaps and triangles in the light's "
                "plane, over a regular ground",
     .source = "bench"},
    buildDegenerateSoup};

}  // namespace
}  // namespace limen::scene
