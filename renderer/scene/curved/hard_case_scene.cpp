// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that tessellation and evaluation may trip over, a few patches each (SC-79).
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/patch_convert.h"
#include "renderer/surfaces/pn_set.h"
#include "renderer/surfaces/quadrics.h"

namespace limen::scene {
namespace {

using surfaces::PatchSet;
using surfaces::weighted;

enum class HardCase {
  Poles,
  Loop,
  SCurve,
  Weights,
  InfinitePoints,
  NegativeWeight,
  NearlyStraight,
  OpposedNormals,
  PartlyShared,
  OneTo64,
  Drum
};
constexpr EnumNames<HardCase, 11> enumNames(HardCase) {
  return {{{{HardCase::Poles, "poles"},
            {HardCase::Loop, "loop"},
            {HardCase::SCurve, "s_curve"},
            {HardCase::Weights, "weights"},
            {HardCase::InfinitePoints, "infinite_points"},
            {HardCase::NegativeWeight, "negative_weight"},
            {HardCase::NearlyStraight, "nearly_straight"},
            {HardCase::OpposedNormals, "opposed_normals"},
            {HardCase::PartlyShared, "partly_shared"},
            {HardCase::OneTo64, "one_to_64"},
            {HardCase::Drum, "drum"}}}};
}

struct HardCaseSettings {
  HardCase which = HardCase::Poles;
  int tessellation = 16;
  static const SettingsTable<HardCaseSettings>& table() {
    using S = HardCaseSettings;
    static const SettingsTable<S> kTable = {
        {&S::which, "case",
         "Sides collapsed to poles; a common boundary with a loop; an "
         "S-shaped one in space; weights from 1e-6 to "
         "1e6; control points at infinity; a negative weight; one "
         "direction all but straight; opposed normals at "
         "the ends of edges; sides of which neighbours share halves; a "
         "flat patch beside one that takes 64 segments; a closed drum whose lids and side part at the rims"},
        {&S::tessellation,
         "tessellation",
         {1, 64},
         "segments",
         "Segments along each side of a patch in the mesh"}};
    return kTable;
  }
};

/// A bicubic patch from a function of (i, j).
template <class Point>
void addBicubic(PatchSet& set, Point point) {
  std::array<glm::dvec4, 16> net;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) net[static_cast<size_t>(i + 4 * j)] = point(i, j);
  addRectangle(set, 3, 3, net);
}

/// Two patches left and right of a curve: `curve` four control points, `bulge` how far the right one leaves
/// the plane.
PatchSet besideCurve(const std::array<glm::dvec3, 4>& curve, double bulge) {
  PatchSet set;
  for (const double side : {-1.0, 1.0})
    addBicubic(set, [&](int i, int j) {
      // The shared side is the left one's u = 1 and the right one's u = 0.
      const double away = side < 0.0 ? (3 - i) / 3.0 : i / 3.0;
      const glm::dvec3 straight(0.0, curve[0].y + (curve[3].y - curve[0].y) * j / 3.0, 0.0);
      const glm::dvec3 p =
          glm::mix(curve[size_t(j)], straight, away) + glm::dvec3(0.8 * side * away, 0.0, 0.0);
      const double out = side > 0.0 && i > 0 && i < 3 ? (i == 1 ? bulge : -bulge) : 0.0;
      return weighted(p + glm::dvec3(0.0, 0.0, out));
    });
  return set;
}

PatchSet extremeWeights() {
  PatchSet set;
  Random random(3);
  constexpr int kCells = 3, kPoints = 3 * kCells + 1;
  std::array<std::array<glm::dvec4, kPoints>, kPoints> net;
  for (int j = 0; j < kPoints; ++j)
    for (int i = 0; i < kPoints; ++i) {
      const glm::dvec3 p(1.6 * i / (kPoints - 1) - 0.8, 1.2 * j / (kPoints - 1) + 0.1,
                         random.uniform(-0.15, 0.15));
      // Powers of ten: 1e-6 and 1e6 among them.
      net[size_t(j)][size_t(i)] = weighted(p, std::pow(10.0, (i * 7 + j * 5) % 13 - 6));
    }
  for (int b = 0; b < kCells; ++b)
    for (int a = 0; a < kCells; ++a)
      addBicubic(set, [&](int i, int j) { return net[size_t(3 * b + j)][size_t(3 * a + i)]; });
  return set;
}

/// Half cylinders of radius 1/2, each from three control points of which the middle one is a direction.
PatchSet infinitePoints() {
  PatchSet set;
  for (const double x : {-0.55, 0.55}) {
    const std::array<glm::dvec4, 6> net = {weighted({x + 0.5, 0.1, 0.0}),  glm::dvec4(0.0, 0.0, 0.5, 0.0),
                                           weighted({x - 0.5, 0.1, 0.0}),  weighted({x + 0.5, 1.1, 0.0}),
                                           glm::dvec4(0.0, 0.0, 0.5, 0.0), weighted({x - 0.5, 1.1, 0.0})};
    addRectangle(set, 2, 1, net);
  }
  return transformed(std::move(set), glm::rotate(glm::dmat4(1.0), M_PI, {0.0, 1.0, 0.0}));
}

/// The long way around a circle: its middle weight is negative, the sum of weights is not.
PatchSet negativeWeight() {
  PatchSet set;
  const double c = std::cos(0.7 * M_PI), s = std::sin(0.7 * M_PI);
  std::array<glm::dvec4, 6> net;
  for (size_t j = 0; j < 2; ++j) {
    const double y = 0.1 + double(j);
    net[3 * j] = weighted({0.5 * c, y, -0.5 * s}), net[3 * j + 2] = weighted({0.5 * c, y, 0.5 * s});
    net[3 * j + 1] = weighted({0.5 / c, y, 0.0}, c);
  }
  std::swap(net[0], net[2]), std::swap(net[3], net[5]);
  addRectangle(set, 2, 1, net);
  return set;
}

PatchSet nearlyStraight() {
  PatchSet set;
  for (const double bend : {0.0, 1e-7})
    addBicubic(set, [&](int i, int j) {
      const double inner = i == 1 || i == 2 ? 1.0 : 0.0;
      return weighted({(bend > 0.0 ? 0.1 : -0.9) + 0.8 * i / 3.0, 0.1 + j / 3.0,
                       0.4 * (j == 1 || j == 2) + bend * inner});
    });
  return set;
}

/// Two triangles; the normals at the ends of some edges are opposed, at others perpendicular to the face.
PatchSet opposedNormals() {
  surfaces::BaseMesh mesh;
  mesh.positions = {{-0.8, 0.3, 0.0}, {0.8, 0.3, 0.0}, {0.8, 1.1, 0.1}, {-0.8, 1.1, -0.1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const glm::dvec3 up(0.0, 0.0, 1.0), down = -up, aside = glm::normalize(glm::dvec3(1.0, 0.0, 1.0));
  mesh.cornerNormals = {{up, down, aside}, {up, aside, up}};
  return pnSet(mesh, {{surfaces::PnNormals::Vlachos, false}, true});
}

/// One patch above two that each share half of its lower side, as surfaces from different knot vectors do.
PatchSet partlyShared() {
  PatchSet set;
  const auto bump = [](double x) { return 0.3 * x * (1.0 - x); };
  addBicubic(set, [&](int i, int j) {
    return weighted({1.6 * i / 3.0 - 0.8, 0.7 + 0.5 * j / 3.0, i == 1 || i == 2 ? bump(0.5) : 0.0});
  });
  for (const double half : {0.0, 1.0}) {
    // The upper patch's curve, split in the middle: (0, b, b, 0) by de Casteljau.
    const double b = bump(0.5), left[4] = {0.0, b / 2, 3 * b / 4, 3 * b / 4};
    addBicubic(set, [&](int i, int j) {
      const double z = left[half > 0.0 ? 3 - i : i];
      return weighted({0.8 * (half + i / 3.0) - 0.8, 0.2 + 0.5 * j / 3.0, z * j / 3.0});
    });
  }
  return set;
}

PatchSet oneTo64() {
  PatchSet set;
  addBicubic(set, [](int i, int j) { return weighted({0.8 * i / 3.0 - 0.8, 0.1 + j / 3.0, 0.0}); });
  // Bent along its inner columns alone: the common side is as straight as the flat patch.
  addBicubic(set, [](int i, int j) {
    const double bend = i == 0 ? 0.0 : (j == 1 ? 0.8 : j == 2 ? -0.8 : 0.0);
    return weighted({0.8 * i / 3.0, 0.1 + j / 3.0, bend});
  });
  return set;
}

/// A closed drum as PN triangles: straight sides of the lids meet the side's arcs, and between the two lies a
/// gap in the plane of the lid.
PatchSet drum() {
  constexpr uint32_t kSegments = 12;
  surfaces::BaseMesh mesh;
  std::vector<glm::dvec3> out;
  for (uint32_t i = 0; i < kSegments; ++i) {
    const double turn = 2.0 * M_PI * i / kSegments;
    out.emplace_back(std::sin(turn), 0.0, std::cos(turn));
    for (const double y : {0.2, 0.9}) mesh.positions.push_back(0.6 * out.back() + glm::dvec3(0.0, y, 0.0));
  }
  const uint32_t middle = 2 * kSegments;
  mesh.positions.insert(mesh.positions.end(), {{0.0, 0.2, 0.0}, {0.0, 0.9, 0.0}});
  const glm::dvec3 up(0.0, 1.0, 0.0);
  for (uint32_t i = 0; i < kSegments; ++i) {
    const uint32_t k = (i + 1) % kSegments, low = 2 * i, nextLow = 2 * k;
    const glm::dvec3 &own = out[i], &next = out[k];
    mesh.triangles.insert(mesh.triangles.end(), {{low, nextLow, nextLow + 1},
                                                 {low, nextLow + 1, low + 1},
                                                 {middle + 1, low + 1, nextLow + 1},
                                                 {middle, nextLow, low}});
    mesh.cornerNormals.insert(mesh.cornerNormals.end(),
                              {{own, next, next}, {own, next, own}, {up, up, up}, {-up, -up, -up}});
  }
  return pnSet(mesh, {{}, false});
}

PatchSet hardCase(HardCase which) {
  switch (which) {
    case HardCase::Poles: {
      const glm::dmat4 place = glm::scale(glm::translate(glm::dmat4(1.0), {0.0, 0.6, 0.0}), glm::dvec3(0.5));
      return transformed(elevated(surfaces::unitSphere(), 3, 3), place);
    }
    case HardCase::Loop:
      return besideCurve({{{0.0, 0.2, 0.0}, {0.9, 1.4, 0.0}, {-0.9, 1.4, 0.0}, {0.0, 0.4, 0.0}}}, 0.1);
    case HardCase::SCurve:
      return besideCurve({{{0.0, 0.1, 0.0}, {0.5, 0.45, 0.6}, {-0.5, 0.85, -0.6}, {0.0, 1.2, 0.0}}}, 1.5);
    case HardCase::Weights:
      return extremeWeights();
    case HardCase::InfinitePoints:
      return infinitePoints();
    case HardCase::NegativeWeight:
      return negativeWeight();
    case HardCase::NearlyStraight:
      return nearlyStraight();
    case HardCase::OpposedNormals:
      return opposedNormals();
    case HardCase::PartlyShared:
      return partlyShared();
    case HardCase::OneTo64:
      return oneTo64();
    case HardCase::Drum:
      return drum();
  }
  return {};
}

Scene buildHardCase(const HardCaseSettings& settings) {
  Scene scene;
  addGround(scene, 9.5);
  addSurface(scene, "surface", hardCase(settings.which), settings.tessellation, {0.7F, 0.62F, 0.55F});
  frameStanding(scene, 1.2, 1.0);
  return scene;
}

const RegisteredScene<HardCaseSettings> kHardCase{
    {.name = "curved/hard_case",
     .version = 1,
     .summary = "A few patches on which evaluation, factors or patterns may fail",
     .source = "bench; Schwarz 2009, chapters 6 and 7"},
    buildHardCase};

}  // namespace
}  // namespace limen::scene
