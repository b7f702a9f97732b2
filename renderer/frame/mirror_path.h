// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"

namespace limen::frame {

/// Of the parameter "refraction" of techniques that follow rays.
inline constexpr const char* kRefractionText =
    "Follow the refracted ray in place of the mirrored one where materials let light through";
inline constexpr const char* kRefractionSource = "named in Roger 2008, section 3.3.5; the bench's own";

/// How far light is followed from mirror to mirror: the same for all techniques of the family that follow
/// rays. Roger counts bounces and levels of shadows apart in one table and together in another (section 3.5);
/// here they are two numbers.
struct MirrorPathSettings {
  int bounces = 1;
  double leastShare = 0.0;
  int shadows = 0;
  static const SettingsTable<MirrorPathSettings>& table() {
    using S = MirrorPathSettings;
    static const SettingsTable<S> kTable = {
        {&S::bounces,
         "bounces",
         {1, 16},
         "",
         "Mirrors that light meets on its way to the eye at most",
         "Roger 2008, section 3.5"},
        {&S::leastShare,
         "least_share",
         {0.0, 1.0},
         "",
         "A ray whose light adds this share of itself to the picture, or less, is not followed",
         "Roger 2008, section 1.2.2"},
        {&S::shadows,
         "shadows",
         {0, 16},
         "",
         "Bounces that end on a surface which a ray to the light's centre tests for shadow; the first ones",
         "Roger 2008, section 3.3.3"}};
    return kTable;
  }
};

}  // namespace limen::frame
