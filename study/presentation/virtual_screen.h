// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>

#include "perception/psychometrics/random.h"
#include "study/presentation/screen_device.h"

namespace limen::study {

/// A display of known behaviour with its own clock, on which a second takes no real time: to test the
/// detection of bad frames, and to run trials without a window.
struct VirtualDisplay {
  double refreshHz = 60.0;  ///< true rate
  double nominalHz = 0.0;   ///< as reported by the system; 0: the true one
  glm::ivec2 sizePx{1920, 1080};
  double jitterMs = 0.0;              ///< swaps return up to this long before or after the blank
  double lateChance = 0.0;            ///< of a wake-up that is late, but in time for the next frame
  double latestPeriods = 0;           ///< of such wake-ups
  std::map<int, int> drops;           ///< number of the swap, from 0 -> blanks that pass before it
  std::set<int> early;                ///< swaps that return at once
  int lostAt = -1;                    ///< number of the swap after which the window is lost
  std::map<int, ScreenEvent> events;  ///< number of the swap after which it is noticed; its time is filled in
  uint64_t seed = 0;
};

class VirtualScreen : public ScreenDevice {
 public:
  explicit VirtualScreen(VirtualDisplay display);

  /// The content of one frame.
  struct Drawn {
    double background = 0.0;
    struct Item {
      enum class Kind { Picture, Fill, Ring, Arrow } kind;
      Picture picture;
      glm::dvec2 atPx{0.0}, sizePx{0.0};
      double light = 0.0;
    };
    std::vector<Item> items;
  };
  const std::vector<Drawn>& shown() const { return shown_; }  ///< one per swap

  double refreshHz() const override;
  glm::ivec2 sizePx() const override { return display_.sizePx; }
  void clear(double light) override;
  void draw(const Picture& picture, glm::ivec2 topLeftPx, glm::ivec2 sizePx) override;
  void fill(glm::ivec2 topLeftPx, glm::ivec2 sizePx, double light) override;
  void ring(glm::dvec2 centrePx, double radiusPx, double widthPx, double light) override;
  void arrow(glm::dvec2 tipPx, double lengthPx, double light) override;
  int64_t swap() override;
  bool lost() const override;
  std::vector<ScreenEvent> poll() override;

 private:
  VirtualDisplay display_;
  psychometrics::Random random_;
  Drawn next_;
  std::vector<Drawn> shown_;
  double blank_ = 0.0, timeNs_ = 1e9;
  std::vector<ScreenEvent> waiting_;
};

}  // namespace limen::study
