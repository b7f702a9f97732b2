// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "renderer/frame/shaded.h"
#include "renderer/techniques/reflections/environment_map/environment_light.h"

namespace limen::techniques {

/// Ways through the picture's depths.
struct HierarchicalMarch {
  static constexpr const char *kKind = "hierarchical",
                              *kSummary = "from cell to cell of a pyramid of nearest depths";
  int coarsest = 6;
  static const SettingsTable<HierarchicalMarch>& table();
};
struct LinearMarch {
  static constexpr const char *kKind = "linear", *kSummary = "in steps of some pixels";
  double stridePx = 4.0, jitter = 0.0;
  int refinements = 4;
  int64_t seed = 1;
  static const SettingsTable<LinearMarch>& table();
};

/// How far a surface of the picture reaches behind what is seen of it.
struct ConstantThickness {
  static constexpr const char *kKind = "constant", *kSummary = "the same for all";
  double depth = 0.02;
  static const SettingsTable<ConstantThickness>& table();
};
struct BackFaceThickness {
  static constexpr const char *kKind = "back_faces", *kSummary = "up to the nearest back face";
  double least = 0.002;
  static const SettingsTable<BackFaceThickness>& table();
};
struct SecondLayerThickness {
  static constexpr const char *kKind = "second_layer",
                              *kSummary =
                                  "the same for two layers: what is seen, and behind it the nearest front";
  double depth = 0.02;
  static const SettingsTable<SecondLayerThickness>& table();
};

/// Whose light a ray brings that meets what a pixel shows.
enum class ScreenLight { Picture, Triangle };
constexpr EnumNames<ScreenLight, 2> enumNames(ScreenLight) {
  return {{{{ScreenLight::Picture, "picture"}, {ScreenLight::Triangle, "triangle"}}}};
}

/// What becomes of a ray that has gone behind a surface, where the picture does not show what it passes.
enum class Behind { Follow, GiveUp };
constexpr EnumNames<Behind, 2> enumNames(Behind) {
  return {{{{Behind::Follow, "follow"}, {Behind::GiveUp, "give_up"}}}};
}

/// What pixels show whose ray the picture does not answer.
struct BackgroundFallback {
  static constexpr const char *kKind = "background", *kSummary = "the background";
  static const SettingsTable<BackgroundFallback>& table();
};
struct NoFallback {
  static constexpr const char *kKind = "none", *kSummary = "nothing: black";
  static const SettingsTable<NoFallback>& table();
};
struct EnvironmentFallback {
  static constexpr const char *kKind = "environment_map",
                              *kSummary = "a map of the surroundings, drawn each frame";
  EnvironmentLightSettings map;
  static const SettingsTable<EnvironmentFallback>& table();
};

struct ScreenSpaceSettings {
  std::variant<LinearMarch, HierarchicalMarch> march;  // an H200 takes 0.16 ms for 0.40, with the same error
  int steps = 1024;
  std::variant<ConstantThickness, BackFaceThickness, SecondLayerThickness> thickness;
  ScreenLight light = ScreenLight::Picture;
  Behind behind = Behind::Follow;
  double fade = 0.05;
  std::variant<BackgroundFallback, NoFallback, EnvironmentFallback> fallback;
  frame::ShadedSetting shading;
  static const SettingsTable<ScreenSpaceSettings>& table();
};

}  // namespace limen::techniques
