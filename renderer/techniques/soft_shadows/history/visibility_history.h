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

/// The past is taken as it is.
struct UnboundedPast {
  static constexpr const char *kKind = "none", *kSummary = "the past is taken as it is";
};
/// The past lies within what the present has around the pixel.
struct NeighbourhoodClamp {
  static constexpr const char *kKind = "neighbourhood",
                              *kSummary =
                                  "least and greatest visibility of receivers around the pixel in the "
                                  "present frame";
  int radius = 1;  ///< px, half the side of the square without its middle
  static const SettingsTable<NeighbourhoodClamp>& table();
};

struct HistorySettings {
  double alpha = 0.2;  ///< weight of the present frame
  double depthTolerance = 0.01, normalToleranceDeg = 20.0;
  std::variant<UnboundedPast, NeighbourhoodClamp> clamp;
  static const SettingsTable<HistorySettings>& table();
};

/// Visibility averaged over past frames with weights that fall exponentially. Where a pixel's surface point
/// lay in the frame before is known from the camera's motion; the light may move as it likes, which is what
/// the history smooths and what it lags behind. Source: Schwarz 2009, section 5.2.2, suggests it and leaves
/// all else open; reprojection after Scherzer et al. 2007 (named there), rejecting what depth or normal show
/// to be another surface; bounding the past by the present's neighbourhood after Karis 2014.
class VisibilityHistory {
 public:
  explicit VisibilityHistory(const HistorySettings& settings);

  void prepare(frame::Frame& frame);
  /// The next frame has no past.
  void forget() { hasPast_ = false; }
  /// Adds the visibility of the frame at hand (R32F); frames come in order. Opens a pass of its own. After
  /// the first frame with a moving camera, equal steps of time allocate nothing.
  void add(frame::Frame& frame, const gl::Texture& visibility);
  /// R32F: the average up to the frame last added, and up to the one before it; 1 outside receivers.
  const gl::Texture& current() const { return *visibility_.at(latest_); }
  const gl::Texture& before() const { return *visibility_.at(1 - latest_); }

  /// Shares of receivers that find a past, and whose past is bounded by the present, were the frame at hand
  /// added once more. Changes nothing.
  std::vector<Counter> count(frame::Frame& frame, const gl::Texture& visibility);
  static std::vector<Quantity> counters();

 private:
  void run(frame::Frame& frame, const gl::Texture& visibility, const gl::Texture* fates);

  float alpha_, depthTolerance_, normalCosine_;
  int clampRadius_ = 0;  // 0: the past is taken as it is
  std::array<std::optional<gl::Texture>, 2> visibility_, surface_;
  size_t latest_ = 0;
  bool hasPast_ = false;
  double timeS_ = 0.0;  // of the frame last added
};

}  // namespace limen::techniques
