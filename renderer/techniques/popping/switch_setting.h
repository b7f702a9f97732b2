// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/base/parameter.h"
#include "perception/popping/settings.h"
#include "perception/vision/display.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/shaded.h"
#include "renderer/scene/lod_set.h"

namespace limen::techniques {

/// One object's change from a level of detail to another, and who watches it. Parameters of
/// popping/lod_switch and its reference.
struct SwitchSetting {
  size_t object = 0;  ///< of Scene::lodObjects
  int fromLevel = 1, toLevel = 0;
  std::string others;       ///< levels of all other objects: "finest", "distance", "omitted"
  bool dynamic = true;      ///< the camera moves as the scene says; false: both frames of it at rest
  double dtS = 1.0 / 60.0;  ///< between the frame before the change and the first one after
  /// Flicker is what the level before the change shows over time; false: what the level after it shows
  /// against the frame before, which has the change in it.
  bool flickerOfBefore = true;
  int samples = 2;  ///< a pixel along each axis, of what is shown
  frame::ShadedSetting shaded;
  /// Its refreshHz is 1 / dtS: the rate at which displacements in pixels per frame follow one another.
  perception::DisplayProfile display;
  perception::PoppingSettings popping;

  static std::vector<Parameter> parameters();
  /// Throws Error on an unreadable display.
  static SwitchSetting from(const ParameterValues& values);

  /// Levels of all objects after and before the change: {actual, predicted}. Throws Error if the scene has no
  /// such object or the object no such level.
  std::pair<scene::LodSelection, scene::LodSelection> levels(const frame::Frame& frame) const;
  bool usesDisocclusion() const { return dynamic && popping.usesDisocclusion(); }
  bool usesFlicker() const { return dynamic && popping.usesFlicker(); }
};

}  // namespace limen::techniques
