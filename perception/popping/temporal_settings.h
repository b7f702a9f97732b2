// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"

namespace limen::perception {

// How the popping predictor sees a switch in time.

/// Both frames as lasting pictures, as Schwarz 2009 does.
struct SingleFrame {
  static constexpr const char *kKind = "single_frame",
                              *kSummary = "the frame of the switch alone, as the thesis does";
};

/// Sustained and transient mechanisms around the switch, and the display's hold blur; see
/// temporal_sensitivity.h.
struct TemporalChannels {
  static constexpr const char *kKind = "channels",
                              *kSummary =
                                  "sustained and transient channels over the frames around the switch, and "
                                  "the blur of held frames that the eye moves over";
  double windowS = 0.5;    ///< of the impulse responses, half before the switch and half after it
  double holdShare = 1.0;  ///< of a frame's time during which the display shows it; 1: LCD, 0: a flash
  static const SettingsTable<TemporalChannels>& table();
};

}  // namespace limen::perception
