// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kGroundSize = 11.0;
constexpr int kTexturedCells = 32;

/// The ground between two x. Grids that meet at an x have bit for bit the same vertices there.
Mesh groundBetween(double low, double high) {
  Mesh mesh = planeGrid(glm::dvec3(0.0), 1.0, kGroundSize, kTexturedCells);
  for (glm::dvec3& position : mesh.positions) position.x = glm::mix(low, high, position.x + 0.5);
  return mesh;
}

struct NoiseTexture {
  static constexpr const char *kKind = "noise", *kSummary = "value noise";
  static constexpr Pattern::Kind kPattern = Pattern::Kind::ValueNoise;
  double size = 0.06, contrast = 0.9;
  static const SettingsTable<NoiseTexture>& table() {
    using S = NoiseTexture;
    static const SettingsTable<S> kTable = {
        Binding(&S::size, "size", Range{0.005, 2.0}, "m", "Pitch of the coarsest lattice")
            .formerly({"texture_size"}),
        Binding(&S::contrast, "contrast", Range{0.0, 1.0}, "", "Contrast of the texture")
            .formerly({"texture_contrast"})};
    return kTable;
  }
};

struct CheckerTexture {
  static constexpr const char *kKind = "checker", *kSummary = "cubes of two shades";
  static constexpr Pattern::Kind kPattern = Pattern::Kind::Checker;
  double size = 0.06, contrast = 0.9;
  static const SettingsTable<CheckerTexture>& table() {
    using S = CheckerTexture;
    static const SettingsTable<S> kTable = {
        Binding(&S::size, "size", Range{0.005, 2.0}, "m", "Edge of the cubes").formerly({"texture_size"}),
        Binding(&S::contrast, "contrast", Range{0.0, 1.0}, "", "Contrast of the texture")
            .formerly({"texture_contrast"})};
    return kTable;
  }
};

struct NoTexture {
  static constexpr const char *kKind = "none", *kSummary = "plain";
};

struct TexturedGroundSettings {
  std::variant<NoiseTexture, CheckerTexture, NoTexture> texture;
  double texturedShare = 0.5;
  static const SettingsTable<TexturedGroundSettings>& table() {
    using S = TexturedGroundSettings;
    static const SettingsTable<S> kTable = {
        {&S::texture, "texture", "Solid texture of the textured ground"},
        {&S::texturedShare,
         "textured_share",
         {0.0, 1.0},
         "",
         "Share of the ground that is textured, from its right side (+x) on"}};
    return kTable;
  }
};

template <class Texture>
Pattern patternOf(const Texture& texture) {
  Pattern pattern;
  pattern.kind = Texture::kPattern;
  pattern.size = texture.size;
  pattern.contrast = texture.contrast;
  // Off the ground plane: a checker's cubes must not end exactly in the visible plane.
  pattern.origin = {0.0, -0.5 * pattern.size, 0.0};
  return pattern;
}
Pattern patternOf(const NoTexture&) { return {}; }

/// A rail along x casts the same penumbrae on the plain and on the textured part of the ground, so that they
/// differ only by what the texture masks.
Scene buildTexturedGround(const TexturedGroundSettings& settings) {
  const double half = 0.5 * kGroundSize, border = half - kGroundSize * settings.texturedShare;
  Scene scene;
  const glm::vec3 albedo(0.5F, 0.5F, 0.48F);
  if (border > -half) addPart(scene, "ground", groundBetween(-half, border), albedo, Role::ReceiverOnly);
  if (border < half) {
    addPart(scene, "textured_ground", groundBetween(border, half), albedo, Role::ReceiverOnly);
    scene.materials.back().pattern =
        std::visit([](const auto& texture) { return patternOf(texture); }, settings.texture);
  }
  Mesh rails;
  for (int i = 0; i < 4; ++i) {
    const double y = 0.3 + 0.25 * i;
    append(rails, box({-1.7, y, -0.72}, {1.7, y + 0.05, -0.68}));
  }
  for (const double x : {-1.5, -0.5, 0.5, 1.5})
    append(rails, box({x - 0.03, 0.0, -0.76}, {x + 0.03, 1.2, -0.72}));
  addPart(scene, "rails", rails, {0.6F, 0.45F, 0.3F});
  Mesh balls;
  for (const double x : {-1.0, 1.0}) append(balls, sphere({x, 0.55, 0.35}, 0.22, 16));
  addPart(scene, "balls", balls, {0.65F, 0.62F, 0.6F});
  scene.lights = {lightTowards({0.0, 4.2, -2.6}, {0.0, 0.2, 0.2}, {0.5, 0.5})};
  setStillCamera(scene, orbitCamera({0.0, 0.1, 0.4}, 5.2, 0.0, 42.0));
  return scene;
}

const RegisteredScene<TexturedGroundSettings> kTexturedGroundRegistered{
    {.name = "textured_ground",
     .version = 1,
     .summary = "The same penumbrae on plain and on highly textured ground: what texture masks",
     .source = "stand-in for Schwarz 2009, Fig. 5.4"},
    buildTexturedGround};

}  // namespace
}  // namespace limen::scene
