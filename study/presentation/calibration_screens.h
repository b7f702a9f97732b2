// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "study/presentation/screen_device.h"

/// What a person before a screen sets by eye. Left and right move by a step, up and down by ten; enter takes
/// the value, escape gives up (nullopt, as when the window is lost).
namespace limen::study {

/// Width in px of a frame that a bank card (ID-1) just covers.
std::optional<double> adjustCardWidth(ScreenDevice& screen, double startPx);

/// Shares of white rows that adjustMatch() can show.
inline constexpr double kMatchProportions[] = {0.25, 0.5, 0.75};

/// Level of a grey square that looks as bright as the field of black and white rows about it, seen from so
/// far that rows cannot be told apart. Rows rather than columns: a display changes its light less readily
/// along a row than from one to the next. `screen` must take light as pixel values (TransferCurve::Linear).
std::optional<double> adjustMatch(ScreenDevice& screen, double proportion, double startLevel);

}  // namespace limen::study
