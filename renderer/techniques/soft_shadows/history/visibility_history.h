// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// The history is used as it is.
struct UnboundedPast {
  static constexpr const char *kKind = "none", *kSummary = "the history is used as it is";
};
/// The history is clamped to the current frame's values around the pixel.
struct NeighbourhoodClamp {
  static constexpr const char
      *kKind = "neighbourhood",
      *kSummary = "smallest and largest visibility of receivers around the pixel in the current frame";
  int radius = 1;  ///< px, half-width of the square, excluding the centre
  static const SettingsTable<NeighbourhoodClamp>& table();
};

struct HistorySettings {
  double alpha = 0.2;  ///< weight of the current frame
  double depthTolerance = 0.01, normalToleranceDeg = 20.0;
  std::variant<UnboundedPast, NeighbourhoodClamp> clamp;
  static const SettingsTable<HistorySettings>& table();
};

/// Visibility averaged over past frames with weights that fall exponentially. The previous position of a
/// pixel's surface point is known from the camera's motion; the light may move freely, which is what the
/// history smooths and lags behind. Source: Schwarz 2009, section 5.2.2, suggests it and leaves the rest
/// open; reprojection after Scherzer et al. 2007 (named there), rejecting points that depth or normal show to
/// be on another surface; clamping the history to the current neighbourhood after Karis 2014.
class VisibilityHistory {
 public:
  explicit VisibilityHistory(const HistorySettings& settings);

  void prepare(frame::Frame& frame);
  /// The next frame has no history.
  void forget() { hasPast_ = false; }
  /// Adds the visibility of the current frame (R32F); frames come in order. Opens its own pass. After
  /// the first frame with a moving camera, equal steps of time allocate nothing.
  void add(frame::Frame& frame, const gl::Texture& visibility);
  /// R32F: the average up to and including the last frame, and up to the one before it; 1 outside receivers.
  const gl::Texture& current() const { return *visibility_.at(latest_); }
  const gl::Texture& before() const { return *visibility_.at(1 - latest_); }

  /// Shares of receivers that have a history, and whose history is clamped, if the current frame were added
  /// once more. Changes nothing.
  std::vector<Counter> count(frame::Frame& frame, const gl::Texture& visibility);
  static std::vector<Quantity> counters();

 private:
  void run(frame::Frame& frame, const gl::Texture& visibility, const gl::Texture* fates);

  float alpha_, depthTolerance_, normalCosine_;
  int clampRadius_ = 0;  // 0: the history is used as it is
  std::array<std::optional<gl::Texture>, 2> visibility_, surface_;
  size_t latest_ = 0;
  bool hasPast_ = false;
  double timeS_ = 0.0;  // of the last frame added
};

}  // namespace limen::techniques
