// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace limen::study {

/// How a frame reached the screen, inferred from the times at which buffer swaps returned.
enum class SwapKind {
  OnTime,  ///< at the vertical blank after its predecessor's
  Late,    ///< also at that blank, but the program noticed late and caught up before the next one
  Missed,  ///< blanks passed in between: the predecessor stayed on screen too long
  Early    ///< the swap returned without waiting for a blank of its own: the frame may never have been seen
};

struct Swap {
  SwapKind kind = SwapKind::OnTime;
  int64_t blank = 0;      ///< vertical blank that it took, counted from the first swap's
  int missed = 0;         ///< blanks that passed
  double latenessMs = 0;  ///< time at which it returned, against its blank
};

struct SwapSetting {
  double nominalHz = 60.0;
  /// In periods. A swap that returns at most this much before a blank is assigned to that blank.
  double earlyTolerance = 0.3;
  /// A swap that returns later than this after its blank cannot have left time for the next frame.
  double latestRecovery = 0.8;
};

/// Swaps of one run, in order.
struct SwapReport {
  /// False: swaps return at once, or at irregular times; nothing can then be said about blanks.
  bool waits = false;
  double periodMs = 0.0;  ///< the display's true one; the nominal one with fewer than three swaps
  double refreshHz() const { return periodMs > 0.0 ? 1000.0 / periodMs : 0.0; }
  std::vector<Swap> swaps;
  int missedBlanks = 0, lateSwaps = 0, earlySwaps = 0;
};

/// `returnedNs`: when each swap returned, steady clock, ascending. The period is that of the grid that fits
/// the times best, which neither missed blanks nor late wake-ups shift, refined by least squares. Each swap
/// takes one blank, no two the same; if a time alone would fit two blanks, the one left free by its
/// successors is taken, so that a late wake-up is not a missed frame. No clock can distinguish a late wake-up
/// of the last swap from one just before a missed blank (which is counted, but may be assigned to the earlier
/// of the two).
SwapReport classifySwaps(const std::vector<int64_t>& returnedNs, const SwapSetting& setting);

}  // namespace limen::study
