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

/// Sizes of the lower cards of a stack.
enum class CardFit {
  Projective,  ///< same projection from the light's centre
  Umbra,       ///< sections of the topmost card's umbra
  Strips       ///< narrow cards side by side in steps
};
constexpr EnumNames<CardFit, 3> enumNames(CardFit) {
  return {{{{CardFit::Projective, "projective"}, {CardFit::Umbra, "umbra"}, {CardFit::Strips, "strips"}}}};
}

constexpr double kTopCard = 1.2;

struct CardStackSettings {
  int64_t cards = 8;
  double spacing = 0.01;
  CardFit fit = CardFit::Projective;
  static const SettingsTable<CardStackSettings>& table() {
    using S = CardStackSettings;
    static const SettingsTable<S> kTable = {
        {&S::cards, "cards", {1, 64}, "cards", "Number of cards"},
        {&S::spacing, "spacing", {0.0001, 0.15}, "m", "Vertical distance between two cards"},
        {&S::fit, "fit",
         "Size of the lower cards: same projection from the light's centre, or the section of the topmost "
         "card's umbra; strips: narrow cards side by side in steps"}};
    return kTable;
  }
  void check() const {
    if (spacing * static_cast<double>(cards - 1) >= kTopCard)
      throw Error("a stack of " + std::to_string(cards) + " cards with 'spacing' " + shortestNumber(spacing) +
                      " m reaches below the ground",
                  "spacing", "keep (cards - 1) * spacing below " + shortestNumber(kTopCard) + " m");
  }
};

/// Occluder fusion: cards below the topmost one, none of which a shadow map from the light's centre can see.
/// Projective cards all have the same projection from the light's centre. Umbra cards are the sections of the
/// topmost card's umbra, so that every light ray that meets one also meets the topmost: visibility on the
/// ground is then the same for any number of cards (as long as light_size is at most 1). Strips are a
/// staircase of narrow cards that appear side by side from the light's centre, so that the map misses
/// nothing: receivers beyond its deep end see them overlap on the light, the more cards the more overlap.
Scene buildCardStack(const CardStackSettings& settings) {
  constexpr double kTop = kTopCard, kHalf = 0.35, kLightSize = 0.3, kStripTangent = 0.04;
  const double depthOfTop = kCardLightHeight - kTop;
  const CardFit fit = settings.fit;
  const int64_t count = settings.cards;
  const double spacing = settings.spacing;
  Mesh cards;
  for (int64_t i = 0; i < count; ++i) {
    const double drop = spacing * static_cast<double>(i);
    const double depth = depthOfTop + drop, grown = depth / depthOfTop;
    const double half =
        fit == CardFit::Umbra ? kHalf * grown - 0.5 * kLightSize * (grown - 1.0) : kHalf * grown;
    const bool strip = fit == CardFit::Strips;
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

struct HalfPlaneSettings {
  double edgeHeight = 1.0;
  static const SettingsTable<HalfPlaneSettings>& table() {
    static const SettingsTable<HalfPlaneSettings> kTable = {
        {&HalfPlaneSettings::edgeHeight,
         "edge_height",
         {0.05, 1.8},
         "m",
         "Height of the half-plane; the light is at 2 m"}};
    return kTable;
  }
};

/// Covers x < 0 at one height; its edge x = 0 is parallel to the light's y axis. The ground at x then sees
/// the share 1/2 + x (H - h) / (h w) of a light of width w at height H, clamped to [0, 1]. The card reaches
/// far enough to every other side that no other edge comes between the light and the middle of the ground.
Scene buildHalfPlane(const HalfPlaneSettings& settings) {
  const double edgeHeight = settings.edgeHeight;
  constexpr double kReach = 4.5;
  Scene scene;
  addGround(scene, 8.0);
  addPart(scene, "half_plane", flatCard({-0.5 * kReach, edgeHeight, 0.0}, {0.5 * kReach, kReach}),
          kCardAlbedo);
  scene.lights = {lightAbove(glm::dvec2(0.4))};
  setStillCamera(scene, orbitCamera({0.5, 0.0, 0.0}, 2.6, 75.0, 32.0));
  return scene;
}

struct RectangleSettings {
  double height = 0.7, width = 0.6, depth = 0.4;
  static const SettingsTable<RectangleSettings>& table() {
    using S = RectangleSettings;
    static const SettingsTable<S> kTable = {
        {&S::height, "height", {0.05, 1.999}, "m", "Height of the rectangle; the light is at 2 m"},
        {&S::width, "width", {0.0001, 2.0}, "m", "Extent along the light's x axis"},
        {&S::depth, "depth", {0.0001, 2.0}, "m", "Extent along the light's y axis"}};
    return kTable;
  }
};

Scene buildParallelRectangle(const RectangleSettings& settings) {
  Scene scene;
  addGround(scene, 8.0);
  addPart(scene, "rectangle",
          flatCard({0.0, settings.height, 0.0}, 0.5 * glm::dvec2(settings.width, settings.depth)),
          kCardAlbedo);
  scene.lights = {lightAbove({0.4, 0.3})};
  setStillCamera(scene, orbitCamera({0.0, 0.15, 0.0}, 2.4, 20.0, 38.0));
  return scene;
}

const RegisteredScene<CardStackSettings> kCardStack{
    {.name = "card_stack",
     .version = 1,
     .summary = "Stack of parallel cards that cover each other as seen from the light: occluder fusion",
     .source = "Schwarz 2009, section 4.2"},
    buildCardStack};

const RegisteredScene<HalfPlaneSettings> kHalfPlane{
    {.name = "half_plane",
     .version = 1,
     .summary =
         "Half-plane with its edge parallel to the light: penumbra linear in distance, known in closed form",
     .source = "bench"},
    buildHalfPlane};

const RegisteredScene<RectangleSettings> kParallelRectangle{
    {.name = "parallel_rectangle",
     .version = 1,
     .summary = "One rectangle parallel to the light: visibility known in closed form",
     .source = "bench"},
    buildParallelRectangle};

}  // namespace
}  // namespace limen::scene
