// SPDX-License-Identifier: BSD-3-Clause
// Flat occluders parallel to a horizontal light, for which visibility has a closed form.
#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr glm::vec3 kCardAlbedo{0.55F, 0.6F, 0.7F};
/// Height of the light above the ground.
constexpr double kCardLightHeight = 2.0;

/// Horizontal, facing up, centred over (x, z).
Mesh flatCard(glm::dvec3 centre, glm::dvec2 halfSize) {
  return card(centre, {0.0, 0.0, halfSize.y}, {halfSize.x, 0.0, 0.0});
}

AreaLight lightAbove(glm::dvec2 size) {
  return lightTowards({0.0, kCardLightHeight, 0.0}, glm::dvec3(0.0), size);
}

/// Occluder fusion: cards below the topmost one, none of which a shadow map from the light's centre can see.
/// Projective cards all have the same projection from the light's centre. Umbra cards are the sections of the
/// topmost card's umbra, so that no light ray meets one that has not met the topmost: visibility on the
/// ground is then the same for any number of cards (as long as light_size is at most 1). Strips are a
/// staircase of narrow cards that lie side by side as seen from the light's centre, so that the map misses
/// nothing: receivers beyond its deep end see them overlap on the light, the more the more there are.
Scene buildCardStack(const ParameterValues& values) {
  constexpr double kTop = 1.2, kHalf = 0.35, kLightSize = 0.3, kStripTangent = 0.04;
  const double depthOfTop = kCardLightHeight - kTop;
  const std::string& fit = values.text("fit");
  const int64_t count = values.integer("cards");
  const double spacing = values.real("spacing");
  if (spacing * static_cast<double>(count - 1) >= kTop)
    throw Error("a stack of " + std::to_string(count) + " cards with 'spacing' " + shortestNumber(spacing) +
                    " m reaches below the ground",
                "card_stack", "keep (cards - 1) * spacing below " + shortestNumber(kTop) + " m");
  Mesh cards;
  for (int64_t i = 0; i < count; ++i) {
    const double drop = spacing * static_cast<double>(i);
    const double depth = depthOfTop + drop, grown = depth / depthOfTop;
    const double half = fit == "umbra" ? kHalf * grown - 0.5 * kLightSize * (grown - 1.0) : kHalf * grown;
    const bool strip = fit == "strips";
    const double centre = strip ? kStripTangent * (static_cast<double>(i) + 0.5) * depth : 0.0;
    append(cards, flatCard({centre, kTop - drop, 0.0}, {strip ? 0.5 * kStripTangent * depth : half, half}));
  }
  Scene scene;
  addGround(scene, 12.0);
  addPart(scene, "cards", cards, kCardAlbedo);
  scene.lights = {lightAbove(glm::dvec2(kLightSize))};
  setStillCamera(scene, orbitCamera({0.0, 0.3, 0.0}, 4.2, 25.0, 37.0));
  return scene;
}

/// Covers x < 0 at one height; its edge x = 0 is parallel to the light's y axis. The ground at x then sees
/// the share 1/2 + x (H - h) / (h w) of a light of width w at height H, clamped to [0, 1]. The card reaches
/// far enough to every other side that no other edge comes between the light and the ground plane's middle.
Scene buildHalfPlane(const ParameterValues& values) {
  const double edgeHeight = values.real("edge_height");
  constexpr double kReach = 4.5;
  Scene scene;
  addGround(scene, 8.0);
  addPart(scene, "half_plane", flatCard({-0.5 * kReach, edgeHeight, 0.0}, {0.5 * kReach, kReach}),
          kCardAlbedo);
  scene.lights = {lightAbove(glm::dvec2(0.4))};
  setStillCamera(scene, orbitCamera({0.5, 0.0, 0.0}, 2.6, 75.0, 32.0));
  return scene;
}

Scene buildParallelRectangle(const ParameterValues& values) {
  Scene scene;
  addGround(scene, 8.0);
  addPart(scene, "rectangle",
          flatCard({0.0, values.real("height"), 0.0},
                   0.5 * glm::dvec2(values.real("width"), values.real("depth"))),
          kCardAlbedo);
  scene.lights = {lightAbove({0.4, 0.3})};
  setStillCamera(scene, orbitCamera({0.0, 0.15, 0.0}, 2.4, 20.0, 38.0));
  return scene;
}

const Registered<SceneInfo> kCardStack{SceneInfo{
    .name = "card_stack",
    .version = 1,
    .summary =
        "Parallel cards one below another that cover each other as seen from the light: occluder fusion",
    .source = "Schwarz 2009, section 4.2",
    .parameters = {integerParameter("cards", 8, 1, 64, "cards", "Number of cards"),
                   realParameter("spacing", 0.01, 0.0001, 0.15, "m", "Vertical distance between two cards"),
                   choiceParameter(
                       "fit", "projective", {"projective", "umbra", "strips"},
                       "Size of the lower cards: same projection from the light's centre, or the section of "
                       "the topmost card's umbra; strips: narrow cards side by side, a step each")},
    .build = buildCardStack}};

const Registered<SceneInfo> kHalfPlane{SceneInfo{
    .name = "half_plane",
    .version = 1,
    .summary =
        "Half-plane with its edge parallel to the light: penumbra linear in distance, known in closed form",
    .source = "bench",
    .parameters = {realParameter("edge_height", 1.0, 0.05, 1.8, "m",
                                 "Height of the half-plane; the light is at 2 m")},
    .build = buildHalfPlane}};

const Registered<SceneInfo> kParallelRectangle{
    SceneInfo{.name = "parallel_rectangle",
              .version = 1,
              .summary = "One rectangle parallel to the light: visibility known in closed form",
              .source = "bench",
              .parameters = {realParameter("height", 0.7, 0.05, 1.8, "m",
                                           "Height of the rectangle; the light is at 2 m"),
                             realParameter("width", 0.6, 0.01, 2.0, "m", "Extent along the light's x axis"),
                             realParameter("depth", 0.4, 0.01, 2.0, "m", "Extent along the light's y axis")},
              .build = buildParallelRectangle}};

}  // namespace
}  // namespace limen::scene
