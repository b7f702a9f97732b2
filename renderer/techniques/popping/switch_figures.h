// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "perception/popping/regions.h"
#include "renderer/techniques/popping/switch_setting.h"
#include "renderer/techniques/popping/switch_views.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// A predictor's results for one level change.
struct SwitchFinding {
  perception::RegionMap regions;
  double largestJnd = 0.0;
  int64_t flushedInputs = 0, guardedContrasts = 0;
};

/// 1 channel: 1 where the object is seen before or after the change.
Image objectMask(frame::Frame& frame, const SwitchSetting& setting);

/// The figures of a change: of its regions, object and camera. All are finite.
std::vector<Counter> switchFigures(frame::Frame& frame, const SwitchSetting& setting,
                                   const SwitchImages& images, const SwitchFinding& finding);
/// Their declarations.
std::vector<Quantity> switchFigureQuantities();

/// The frame after the change in grey with its popping regions in colour (SP-50).
Image regionPicture(const SwitchImages& images, const perception::RegionMap& regions);

/// The `rating` of a change without regions: one less than that of a region of one pixel at the threshold,
/// the lowest that a region can have.
double ratingWithoutRegion(const perception::PoppingSettings& settings);

}  // namespace limen::techniques
