// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/chosen_entry.h"
#include "perception/vision/display.h"

namespace limen::perception {

/// How a picture is viewed: `display: desktop_24` for a preset, `display: {kind: desktop_24, distance_m:
/// 0.4}`, or `display: {kind: file, file: my_display.yaml}` for a profile.
struct ViewingSettings {
  ChosenEntry display{"schwarz_2009", {}};  ///< with PresetViewing or FileViewing
  static const SettingsTable<ViewingSettings>& table();
  /// Throws Error on an unreadable profile.
  DisplayProfile profile() const;
};

struct PresetViewing {
  double distanceM = 0.6;  ///< viewing distance
  static const SettingsTable<PresetViewing>& table();
};

struct ProfileDistance {
  static constexpr const char *kKind = "of_profile", *kSummary = "the profile's";
};
struct GivenDistance {
  static constexpr const char *kKind = "given", *kSummary = "a given one";
  double m = 0.6;
  static const SettingsTable<GivenDistance>& table();
};
struct FileViewing {
  FilePath file;
  std::variant<ProfileDistance, GivenDistance> distance;
  static const SettingsTable<FileViewing>& table();
};

}  // namespace limen::perception
