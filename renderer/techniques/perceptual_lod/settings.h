// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/parameter.h"
#include "perception/threshold_maps/settings.h"
#include "perception/vision/display.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/perceptual_lod/layers.h"
#include "renderer/techniques/perceptual_lod/tested_levels.h"

namespace limen::techniques {

/// What turns a picture into thresholds: the display it is seen on and the model of Schwarz 2009, section
/// 9.4. Parameters of the map carry the prefix "map_".
struct SeenOn {
  perception::DisplayProfile display;
  perception::ThresholdMapSettings map;
  perception::ThresholdMapGpuSettings mapGpu;
  static std::vector<Parameter> parameters(bool gpu);
  static SeenOn from(const ParameterValues& values);
};

/// All of the interactive perceptual pipeline (Schwarz 2009, section 9.5).
struct PerceptualLodSettings {
  enum class Count { Compute, Query };
  LayerSettings layers;
  LevelRule rule;
  int objectsPerFrame = 2;
  int startLevel = 0;
  int settleFrames = 32;
  int latencyFrames = 1;
  bool wait = false;
  double frameStepS = 0.0;
  bool shadowMask = true;
  double shadowAttenuation = 0.2;
  Count count = Count::Compute;
  bool allMaps = false;
  bool oracle = true;
  frame::ShadedSetting shading;
  SeenOn seenOn;

  static std::vector<Parameter> parameters();
  static PerceptualLodSettings from(const ParameterValues& values);
};

void appendTo(std::vector<Parameter>& to, std::vector<Parameter> more);

}  // namespace limen::techniques
