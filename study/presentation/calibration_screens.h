// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "study/presentation/screen_device.h"

/// What a person sets by eye in front of a screen. Left and right move by one step, up and down by ten; Enter
/// accepts the value, Escape cancels (nullopt, as when the window is lost).
namespace limen::study {

/// Width in px of a frame that a bank card (ID-1) just covers.
std::optional<double> adjustCardWidth(ScreenDevice& screen, double startPx);

/// Shares of white rows that adjustMatch() can show.
inline constexpr double kMatchProportions[] = {0.25, 0.5, 0.75};

/// Level of a grey square that looks as bright as the surrounding field of black and white rows, from so far
/// away that rows cannot be resolved. Rows rather than columns: a display responds less quickly along a row
/// than between rows. `screen` must interpret light as pixel values (TransferCurve::Linear).
std::optional<double> adjustMatch(ScreenDevice& screen, double proportion, double startLevel);

}  // namespace limen::study
