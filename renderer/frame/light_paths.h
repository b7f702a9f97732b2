// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"
#include "renderer/frame/shaded.h"

namespace limen::frame {

/// Part of the light of a picture: what surfaces emit and reflect of the lamp at once, what they reflect of
/// each other, or both.
enum class LightPart { Direct, Indirect, All };
constexpr EnumNames<LightPart, 3> enumNames(LightPart) {
  return {{{{LightPart::Direct, "direct"}, {LightPart::Indirect, "indirect"}, {LightPart::All, "all"}}}};
}

/// How all techniques of global illumination light a scene, so that their pictures differ by indirect light
/// alone. Surfaces are diffuse, with the normals of their triangles. The lamp is the scene's first light: it
/// shines from its centre with the same strength at any distance, as everywhere else in the bench, so that a
/// surface of albedo a that faces it has the radiance a * strength, its irradiance being pi * strength.
/// Materials emit from their front sides. What leaves the scene is lost; nothing comes from outside. Surfaces
/// with a transmittance let that share through straight on (their refractive index has no part in it).
struct SurfaceLightSettings {
  LightPart light = LightPart::All;
  double strength = 0.8;
  bool pattern = true;
  static const SettingsTable<SurfaceLightSettings>& table() {
    using S = SurfaceLightSettings;
    static const SettingsTable<S> kTable = {
        {&S::light, "light", "Which light the picture holds"},
        {&S::strength,
         "strength",
         {0.0, 10.0},
         "",
         "Radiance of a white surface that faces the lamp",
         "as frame::Shaded has it"},
        {&S::pattern, "pattern", "Apply the solid textures of the scene's materials"}};
    return kTable;
  }
  /// The lamp's light alone, as shading.glsl and its double-precision twin take it.
  ShadedSetting lamp() const {
    ShadedSetting setting;
    setting.ambient = setting.specular = setting.background = 0.0;
    setting.diffuse = strength;
    setting.smoothNormals = false;
    setting.pattern = pattern;
    return setting;
  }
};

/// Settings of paths that light takes over diffuse surfaces.
struct LightPathSettings {
  int64_t paths = 64;
  int bounces = 2;
  int64_t seed = 1;
  SurfaceLightSettings surfaces;
  static const SettingsTable<LightPathSettings>& table() {
    using S = LightPathSettings;
    static const SettingsTable<S> kTable = {
        {&S::paths, "paths", {2, 65536}, "paths/px", "Paths from each pixel's point"},
        {&S::bounces,
         "bounces",
         {0, 8},
         "",
         "Reflections between surfaces at most, after the one of the lamp's light",
         "Gaitatzes 2012, section 5.6 (two)"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the directions"},
        included(&S::surfaces)};
    return kTable;
  }
};

/// Transparent surfaces that a path or a ray to the lamp passes at most; behind more there is no light.
inline constexpr int kMostPassages = 8;

}  // namespace limen::frame
