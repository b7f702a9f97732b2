// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "experiments/base/settings_table.h"
#include "perception/popping/settings.h"
#include "perception/threshold_maps/viewing.h"
#include "perception/vision/display.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/shaded.h"
#include "renderer/scene/lod_set.h"

namespace limen::techniques {

/// Level whose shading is compared with the previous frame.
enum class FlickerLevel {
  Before,  ///< flicker of the level before the change
  After    ///< the level after the change against the previous frame, which includes the change
};
constexpr EnumNames<FlickerLevel, 2> enumNames(FlickerLevel) {
  return {{{{FlickerLevel::Before, "before"}, {FlickerLevel::After, "after"}}}};
}

/// Levels of the objects that do not change.
enum class OtherLevels {
  Finest,
  Distance,  ///< by the scene's switch distances
  Omitted    ///< not drawn
};
constexpr EnumNames<OtherLevels, 3> enumNames(OtherLevels) {
  return {{{{OtherLevels::Finest, "finest"},
            {OtherLevels::Distance, "distance"},
            {OtherLevels::Omitted, "omitted"}}}};
}

struct DynamicPresentation {
  static constexpr const char *kKind = "dynamic", *kSummary = "the camera moves as defined by the scene";
  double dtS =
      0.0;  ///< from the last frame before the change to the first after it; 0: one frame of the display
  FlickerLevel flickerLevel = FlickerLevel::Before;
  static const SettingsTable<DynamicPresentation>& table();
};

struct StaticPresentation {
  static constexpr const char *kKind = "static", *kSummary = "the same two pictures shown at rest";
};

/// Settings of popping/lod_switch and its reference.
struct SwitchSettings {
  size_t object = 0;
  int fromLevel = 1, toLevel = 0;
  OtherLevels others = OtherLevels::Finest;
  std::variant<DynamicPresentation, StaticPresentation> presentation;
  int samples = 2;
  perception::ViewingSettings viewing;
  frame::ShadedSetting shading;
  perception::PoppingSettings predictor;
  static const SettingsTable<SwitchSettings>& table();
  /// Throws Error on an unreadable display.
  void check() const;
};

/// One object's change from one level of detail to another, and how it is viewed.
struct SwitchSetting {
  size_t object = 0;  ///< of Scene::lodObjects
  int fromLevel = 1, toLevel = 0;
  OtherLevels others = OtherLevels::Finest;
  bool dynamic = true;      ///< the camera moves as defined by the scene; false: it rests in both frames
  double dtS = 1.0 / 60.0;  ///< between the last frame before the change and the first after it
  /// Flicker is that of the level before the change; false: the level after the change is compared with the
  /// previous frame, which includes the change.
  bool flickerOfBefore = true;
  int samples = 2;  ///< per pixel along each axis, of the pictures shown
  frame::ShadedSetting shaded;
  /// Its refreshHz is 1 / dtS: the frame rate of displacements in pixels per frame.
  perception::DisplayProfile display;
  perception::PoppingSettings popping;

  SwitchSetting() = default;
  /// Throws Error on an unreadable display.
  explicit SwitchSetting(const SwitchSettings& settings);

  /// Levels of all objects after and before the change: {actual, predicted}. Throws Error if there is no such
  /// object or level.
  std::pair<scene::LodSelection, scene::LodSelection> levels(const frame::Frame& frame) const;
  bool usesDisocclusion() const { return dynamic && popping.usesDisocclusion(); }
  bool usesFlicker() const { return dynamic && popping.usesFlicker(); }
};

}  // namespace limen::techniques
