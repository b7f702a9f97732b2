// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"
#include "perception/threshold_maps/viewing.h"
#include "perception/thresholds/settings.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/perceptual_lod/layers.h"
#include "renderer/techniques/perceptual_lod/tested_levels.h"

namespace limen::techniques {

/// What turns a picture into thresholds: the display it is viewed on and the model.
struct SeenOn {
  perception::DisplayProfile display;
  perception::ThresholdSettings thresholds;
};

/// Settings of the display and of the model, for thresholds computed on the GPU or (T: ThresholdSettings)
/// not.
template <class T>
struct SeenOnSettings {
  /// The single map: below the combined one hardly any level differs from the finest (docs/perceive.md).
  T thresholds = std::variant_alternative_t<1, T>{};
  perception::ViewingSettings viewing;
  static const SettingsTable<SeenOnSettings>& table();
  /// Throws Error on an unreadable display.
  SeenOn seenOn() const { return {viewing.profile(), perception::modelOf(thresholds)}; }
};
using ModelSettings = SeenOnSettings<perception::ThresholdSettings>;
using GpuModelSettings = SeenOnSettings<perception::ThresholdGpuSettings>;

/// How pixels above threshold are counted.
enum class CountMethod {
  Compute,  ///< in a compute shader
  Query     ///< by occlusion queries
};
constexpr EnumNames<CountMethod, 2> enumNames(CountMethod) {
  return {{{{CountMethod::Compute, "compute"}, {CountMethod::Query, "query"}}}};
}

/// Layers whose threshold map is computed in a frame.
enum class MappedLayers {
  Tested,  ///< those with an object under test
  All
};
constexpr EnumNames<MappedLayers, 2> enumNames(MappedLayers) {
  return {{{{MappedLayers::Tested, "tested"}, {MappedLayers::All, "all"}}}};
}

enum class StartLevel { Finest, Coarsest };
constexpr EnumNames<StartLevel, 2> enumNames(StartLevel) {
  return {{{{StartLevel::Finest, "finest"}, {StartLevel::Coarsest, "coarsest"}}}};
}

/// What a frame tests.
struct TestSettings {
  int objectsPerFrame = 2;
  int latencyFrames = 1;
  bool wait = false;
  CountMethod count = CountMethod::Compute;
  MappedLayers thresholdMaps = MappedLayers::Tested;
  static const SettingsTable<TestSettings>& table();
};

/// Shadows that other layers cast on a layer, as a masking pattern.
struct DarkenedShadows {
  static constexpr const char *kKind = "darkened", *kSummary = "count as a pattern, if shading has shadows";
  double factor = 0.2;  ///< factor in shadow
  static const SettingsTable<DarkenedShadows>& table();
};

struct IgnoredShadows {
  static constexpr const char *kKind = "ignored", *kSummary = "do not mask";
};

/// All settings of the interactive perceptual pipeline (Schwarz 2009, section 9.5).
struct PerceptualLodSettings {
  LayerPartition layers;
  LevelRule rule;
  TestSettings tests;
  StartLevel startLevel = StartLevel::Finest;
  int settleFrames = 32;
  double frameStepS = 0.0;
  std::variant<DarkenedShadows, IgnoredShadows> castShadows;
  bool oracle = true;
  frame::ShadedSetting shading;
  GpuModelSettings model;
  static const SettingsTable<PerceptualLodSettings>& table();
};

}  // namespace limen::techniques
