// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "experiments/runner.h"

namespace limen::experiments {

/// A bar that is redrawn in place, with what is being measured and the time left; failed runs get their own
/// line.
std::unique_ptr<SweepObserver> makeProgressBar(std::FILE* terminal);

/// One plain line per run.
std::unique_ptr<SweepObserver> makeLinePrinter(std::FILE* out);

/// One JSON object per run: key, status, technique, scene, label, setting, measurements {name: value}, error.
std::unique_ptr<SweepObserver> makeJsonPrinter(std::FILE* out);

/// Notifies two observers.
std::unique_ptr<SweepObserver> makePair(std::unique_ptr<SweepObserver> first,
                                        std::unique_ptr<SweepObserver> second);

/// "soft_shadows/bitmask pattern=regular_8 · grid light_size=2 · 1.23 ms · rmse 0.0123", or the error.
std::string describeFinished(const PlannedRun& run, const store::Run& row);

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string describeDuration(double seconds);

/// Cuts UTF-8 text to `columns` terminal columns, ending in "…" if anything was cut. Counts code points,
/// which is right for everything that the bench prints.
std::string cutToColumns(const std::string& text, size_t columns);

/// The bar's text: "[####----] 12/40 2 failed, 3 min 20 s left, soft_shadows/bitmask · grid", at most
/// `columns` wide.
std::string barText(size_t done, size_t total, size_t failed, double secondsLeft, const std::string& current,
                    size_t columns);

}  // namespace limen::experiments
