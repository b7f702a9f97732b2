// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <set>

#include "perception/popping/regions.h"
#include "perception/vision/display.h"
#include "renderer/frame/frame.h"
#include "study/stimulus/stimulus.h"
#include "study/stimulus/timeline.h"

namespace limen::study {

/// Where a cued viewer looks when a stimulus changes. Window pixels, from the upper left corner.
struct CuedPlace {
  glm::dvec2 centrePx{0.0};
  double radiusPx = 0.0;
};

/// An arrow asks about what is seen sharply at its tip: the fovea is about 2 degrees across (Schwarz 2009,
/// section 8.2). A circle asks about its inside.
inline constexpr double kArrowRadiusDeg = 1.0;

/// A cue lies over the sequence's first frame. The place is where the surface that it points to there is seen
/// in the frame of the change; of a cue over the background, the same direction. Nothing without a cue, or if
/// that point is then behind the eye. `frame` has the levels that the first frame shows; its time is changed
/// and put back.
std::optional<CuedPlace> cuedPlace(frame::Frame& frame, const Stimulus& stimulus, const Timeline& timeline,
                                   const perception::DisplayProfile& display);

/// Labels of the regions with a pixel centre within the place.
std::set<uint32_t> regionsAt(const perception::RegionMap& regions, const CuedPlace& place);

}  // namespace limen::study
