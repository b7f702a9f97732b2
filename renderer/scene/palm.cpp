// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kTrunkHeight = 1.7, kFrondLength = 1.15;

/// The trunk leans towards +x, like a solitary palm's.
glm::dvec3 trunkPoint(double t) { return {-0.75 + 0.4 * t * t, kTrunkHeight * t, -0.15 * t}; }

Mesh trunk() {
  constexpr int kRings = 12;
  std::vector<glm::dvec3> points;
  std::vector<double> radii;
  for (int i = 0; i <= kRings; ++i) {
    points.push_back(trunkPoint(double(i) / kRings));
    // Scars of old leaves stand out as rings.
    radii.push_back((0.075 - 0.03 * i / kRings) * (i % 2 == 0 ? 1.0 : 1.15));
  }
  return tube(points, radii, 12);
}

/// An arched rib with two rows of narrow leaflets.
class Frond {
 public:
  Frond(glm::dvec3 base, double azimuth, double rise, double length) {
    const glm::dvec3 outward(std::cos(azimuth), 0.0, std::sin(azimuth));
    points_.push_back(base);
    for (int i = 0; i < kPieces; ++i) {
      // From rising to hanging: the weight grows towards the tip.
      const double angle = rise - (rise + 0.9) * (i + 0.5) / kPieces;
      points_.push_back(points_.back() +
                        length / kPieces * (std::cos(angle) * outward + std::sin(angle) * up()));
    }
    side_ = glm::cross(outward, up());
  }

  Mesh rib() const {
    std::vector<double> radii;
    for (int i = 0; i <= kPieces; ++i) radii.push_back(0.009 - 0.0065 * i / kPieces);
    return tube(points_, radii, 4);
  }

  void addLeaflets(Mesh& leaves, int perSide, double width, Random& random) const {
    for (int i = 0; i < perSide; ++i) {
      const double t = 0.12 + 0.88 * (i + 0.5) / perSide;
      const double piece = std::min(t * kPieces, kPieces - 1e-9);
      const auto index = static_cast<size_t>(piece);
      const glm::dvec3 stem = glm::mix(points_[index], points_[index + 1], piece - std::floor(piece));
      const glm::dvec3 forward = glm::normalize(points_[index + 1] - points_[index]);
      const double length =
          0.34 * std::sin(std::numbers::pi * std::min(0.25 + 0.7 * t, 1.0)) * random.uniform(0.85, 1.0);
      for (const double sign : {-1.0, 1.0}) {
        const glm::dvec3 along = glm::normalize(sign * side_ + random.uniform(0.5, 0.8) * forward -
                                                random.uniform(0.2, 0.5) * up());
        addLeaflet(leaves, stem, along, forward, length, width);
      }
    }
  }

 private:
  static constexpr int kPieces = 8;
  static glm::dvec3 up() { return {0.0, 1.0, 0.0}; }

  /// Two triangles, widest in the middle.
  static void addLeaflet(Mesh& leaves, glm::dvec3 stem, glm::dvec3 along, glm::dvec3 forward, double length,
                         double width) {
    const glm::dvec3 across = 0.5 * width * glm::normalize(forward - glm::dot(forward, along) * along);
    const auto first = static_cast<uint32_t>(leaves.positions.size());
    leaves.positions.push_back(stem);
    leaves.positions.push_back(stem + 0.4 * length * along + across);
    leaves.positions.push_back(stem + length * along);
    leaves.positions.push_back(stem + 0.4 * length * along - across);
    leaves.triangles.emplace_back(first, first + 1, first + 2);
    leaves.triangles.emplace_back(first, first + 2, first + 3);
  }

  std::vector<glm::dvec3> points_;
  glm::dvec3 side_;
};

/// Tube through a curve of a parameter from 0 to 1, thinner towards its end.
template <class Curve>
Mesh limb(Curve curve, double thick, double thin) {
  constexpr int kRings = 12;
  std::vector<glm::dvec3> points;
  std::vector<double> radii;
  for (int i = 0; i <= kRings; ++i) {
    points.push_back(curve(double(i) / kRings));
    radii.push_back(glm::mix(thick, thin, double(i) / kRings));
  }
  return tube(points, radii, 12);
}

/// A long-necked animal that walks along +x under the palm: one large occluder among many thin ones.
Mesh creature(int legPairs) {
  const glm::dvec3 middle(0.1, 0.42, 0.35);
  Mesh body = sphere(glm::dvec3(0.0), 1.0, 10);
  for (glm::dvec3& position : body.positions) position = middle + position * glm::dvec3(0.42, 0.17, 0.16);
  append(body, limb([&](double t) { return middle + glm::dvec3(0.34 + 0.42 * t, 0.05 + 0.5 * t * t, 0.0); },
                    0.09, 0.035));
  append(body, sphere(middle + glm::dvec3(0.8, 0.56, 0.0), 0.06, 6));
  append(body,
         limb([&](double t) { return middle + glm::dvec3(-0.34 - 0.6 * t, 0.02 - 0.3 * t * t, 0.1 * t); },
              0.1, 0.008));
  for (int i = 0; i < legPairs; ++i) {
    const double x = legPairs == 1 ? 0.0 : -0.28 + 0.56 * i / (legPairs - 1);
    for (const double side : {-1.0, 1.0}) {
      const double step = 0.05 * side * (i % 2 == 0 ? 1.0 : -1.0);
      const glm::dvec3 hip = middle + glm::dvec3(x, -0.05, 0.09 * side);
      const glm::dvec3 foot(hip.x + step, 0.0, hip.z + 0.02 * side);
      append(
          body,
          limb([&](double t) { return glm::mix(hip, foot, t) + glm::dvec3(step * t * (1.0 - t), 0.0, 0.0); },
               0.06, 0.035));
    }
  }
  return body;
}

struct PalmSettings {
  int fronds = 14, leaflets = 40;
  double leafletWidth = 0.022;
  int legPairs = 2;
  int64_t seed = 1;
  static const SettingsTable<PalmSettings>& table() {
    using S = PalmSettings;
    static const SettingsTable<S> kTable = {
        {&S::fronds, "fronds", {1, 64}, "fronds", "Fronds of the crown"},
        {&S::leaflets,
         "leaflets",
         {1, 400},
         "leaflets",
         "Leaflets on each side of a frond, two triangles each"},
        {&S::leafletWidth,
         "leaflet_width",
         {0.001, 0.1},
         "m",
         "Largest width of a leaflet; a frond is about 1.15 m long"},
        {&S::legPairs, "leg_pairs", {1, 12}, "pairs", "Pairs of legs of the animal"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the positions of fronds and leaflets"}};
    return kTable;
  }
};

Scene buildPalm(const PalmSettings& settings) {
  const int fronds = settings.fronds, leaflets = settings.leaflets;
  Random random(settings.seed);
  Mesh wood = trunk(), leaves;
  for (int i = 0; i < fronds; ++i) {
    const double azimuth = 2.0 * std::numbers::pi * (i + random.uniform(-0.3, 0.3)) / fronds;
    const Frond frond(trunkPoint(1.0), azimuth, random.uniform(0.5, 1.1),
                      kFrondLength * random.uniform(0.85, 1.1));
    append(wood, frond.rib());
    frond.addLeaflets(leaves, leaflets, settings.leafletWidth, random);
  }
  Scene scene;
  addGround(scene, 13.0);
  addPart(scene, "wood", wood, {0.38F, 0.28F, 0.18F});
  addPart(scene, "leaves", leaves, {0.22F, 0.42F, 0.13F});
  addPart(scene, "creature", creature(settings.legPairs), {0.45F, 0.5F, 0.42F});
  scene.lights = {lightTowards({-2.6, 5.2, 1.8}, {0.0, 0.8, 0.1}, glm::dvec2(0.4))};
  setStillCamera(scene, orbitCamera({0.1, 0.6, 0.1}, 5.2, 14.0, 37.0));
  return scene;
}

const RegisteredScene<PalmSettings> kPalmRegistered{
    {.name = "palm",
     .version = 1,
     .summary = "Long-necked animal under a palm: shadows of thin fronds on a body and on the ground",
     .source = "stand-in for Schwarz 2009, Fig. 5.3"},
    buildPalm};

}  // namespace
}  // namespace limen::scene
