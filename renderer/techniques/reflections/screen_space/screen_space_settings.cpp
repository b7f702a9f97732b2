// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/screen_space/screen_space_settings.h"

#include "renderer/techniques/reflections/screen_space/screen_space_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kThicknessUnit = "scene diagonals";

}  // namespace

const SettingsTable<HierarchicalMarch>& HierarchicalMarch::table() {
  static const SettingsTable<HierarchicalMarch> kTable = {
      {&HierarchicalMarch::coarsest,
       "coarsest",
       {0, kScreenPyramidLevels},
       "",
       "Coarsest level of the pyramid, whose cells are 2^level pixels wide",
       "Uludag 2014 (GPU Pro 5)"}};
  return kTable;
}

const SettingsTable<LinearMarch>& LinearMarch::table() {
  using S = LinearMarch;
  static const SettingsTable<S> kTable = {
      {&S::stridePx, "stride", {1.0, 256.0}, "px", "Length of a step", "McGuire and Mara 2014"},
      {&S::jitter,
       "jitter",
       {0.0, 1.0},
       "strides",
       "Widest shift of a pixel's first step, by chance",
       "McGuire and Mara 2014"},
      {&S::refinements, "refinements", {0, 16}, "", "Halvings of the step that goes behind a surface"},
      {&S::seed, "seed", {0, 1000000}, "", "Seed of the shifts"}};
  return kTable;
}

const SettingsTable<ConstantThickness>& ConstantThickness::table() {
  static const SettingsTable<ConstantThickness> kTable = {{&ConstantThickness::depth,
                                                           "depth",
                                                           {1e-6, 10.0},
                                                           kThicknessUnit,
                                                           "Along the view, behind what is seen",
                                                           "McGuire and Mara 2014"}};
  return kTable;
}

const SettingsTable<BackFaceThickness>& BackFaceThickness::table() {
  static const SettingsTable<BackFaceThickness> kTable = {
      {&BackFaceThickness::least,
       "least",
       {1e-6, 10.0},
       kThicknessUnit,
       "At least this, and where no back face is: along the view, behind what is seen"}};
  return kTable;
}

const SettingsTable<SecondLayerThickness>& SecondLayerThickness::table() {
  static const SettingsTable<SecondLayerThickness> kTable = {
      {&SecondLayerThickness::depth,
       "depth",
       {1e-6, 10.0},
       kThicknessUnit,
       "Along the view, behind a surface, up to the second at most",
       "Mara et al. 2016 (two layers)"}};
  return kTable;
}

const SettingsTable<BackgroundFallback>& BackgroundFallback::table() {
  static const SettingsTable<BackgroundFallback> kTable = {};
  return kTable;
}

const SettingsTable<NoFallback>& NoFallback::table() {
  static const SettingsTable<NoFallback> kTable = {};
  return kTable;
}

const SettingsTable<EnvironmentFallback>& EnvironmentFallback::table() {
  static const SettingsTable<EnvironmentFallback> kTable = {included(&EnvironmentFallback::map)};
  return kTable;
}

const SettingsTable<ScreenSpaceSettings>& ScreenSpaceSettings::table() {
  using S = ScreenSpaceSettings;
  static const SettingsTable<S> kTable = {
      {&S::march, "march", "How a ray is followed through the picture"},
      {&S::steps, "steps", {1, 16384}, "", "Places of the picture that a ray is looked at, at most"},
      {&S::thickness, "thickness", "How far surfaces reach behind what is seen of them"},
      {&S::light, "light",
       "Of a pixel as the picture shows it, or of the pixel's triangle where the ray meets it, if it does"},
      {&S::behind, "behind",
       "Whether a ray is followed on where it goes behind a surface, or left to the fallback there"},
      {&S::fade,
       "fade",
       {0.0, 0.5},
       "shorter sides",
       "Width of the picture's border along which what rays meet fades into the fallback"},
      {&S::fallback, "fallback",
       "What pixels show whose ray leaves the picture or goes behind what it shows"},
      shadingBinding(&S::shading)};
  return kTable;
}

}  // namespace limen::techniques
