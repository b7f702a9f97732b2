// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"

/// Area of the stimulus, of which some contrast sensitivities make use.
namespace limen::perception {

struct ImageArea {
  static constexpr const char *kKind = "image", *kSummary = "that of the images on the display";
};
struct FixedArea {
  static constexpr const char *kKind = "fixed", *kSummary = "a given one";
  /// A Gabor patch of sigma 1.5 degrees, about which ColorVideoVDP reads castleCSF.
  double deg2 = 7.07;
  static const SettingsTable<FixedArea>& table();
};

}  // namespace limen::perception
