// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/techniques/soft_shadows/scene_needs/probe.h"

namespace limen::techniques {

/// When a feature is worth its cost. Source of the rules: Schwarz 2009, sections 3.3, 4.2 to 4.7 and 5.1, as
/// collected for this bench; the numbers are the bench's own.
struct NeedThresholds {
  /// Mean change of visibility in shadow up to which a feature is left out.
  double tolerance = 1.0 / 256.0;
  double hardPenumbraTexels = 1.0;  ///< up to this widest penumbra a hard shadow is shown
  double coarseShare = 0.25;        ///< of pixels with level 2 or coarser, from which microrects are used
  double blendShare = 0.05;         ///< of neighbours with different levels, from which levels are blended
  double buildWeight = 1.0;         ///< micro-occluders that cost as much as one texel of a structure
  static const SettingsTable<NeedThresholds>& table();
};

/// What a scene's view was found to need, and why.
struct Decision {
  ShadowSetting setting;
  std::vector<std::string> remarks;  ///< a sentence for each choice
  std::vector<Counter> evidence;     ///< the figures that decided
};

/// The figures in Decision::evidence.
std::vector<Quantity> evidenceQuantities();

/// Settings common to all methods that can be chosen.
struct CommonNeeds {
  MapSettings map;
  int budget = 256;  ///< micro-occluders allowed per pixel; 0: no limit
  static const SettingsTable<CommonNeeds>& table();
};

/// Starts from everything (bitmask with jittered samples over two peeled layers) and leaves out whatever
/// hardly changes a small picture of the scene; then chooses the structure by counted work. `common` is part
/// of every setting. Waits for the GPU.
Decision decideNeeds(frame::Frame& frame, ShadowProbe& probe, const CommonNeeds& common,
                     const NeedThresholds& thresholds);

}  // namespace limen::techniques
