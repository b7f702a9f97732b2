// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"

namespace limen::techniques {

/// How far surfaces occlude ambient light: a share of the scene's diagonal, so that scale does not matter.
struct OcclusionRadius {
  double radius = 0.03;
  static const SettingsTable<OcclusionRadius>& table() {
    static const SettingsTable<OcclusionRadius> kTable = {
        {&OcclusionRadius::radius,
         "radius",
         {0.0001, 10.0},
         "",
         "Distance beyond which nothing occludes, as a share of the scene's diagonal",
         "Holländer 2013, section 7.2.1 (value not given there)"}};
    return kTable;
  }
  float of(const frame::Frame& frame) const {
    return static_cast<float>(radius * frame.gpuScene().diagonal());
  }
};

}  // namespace limen::techniques
