// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/ray_casting/hit_counters.h"

#include "renderer/techniques/tessellation/surface_view.h"

namespace limen::techniques {

std::vector<Quantity> withHitQuantities(std::vector<Quantity> own) {
  const Direction lower = Direction::LowerIsBetter;
  const std::vector<Quantity> hits = {
      {"surface_px", "Pixels that see the surface", "px", Direction::Neither},
      {"missed_px", "Pixels that see the surface and were left empty", "px", lower},
      {"hole_px", "Missed pixels whose neighbours all see the surface", "px", lower},
      {"false_px", "Pixels filled that do not see the surface", "px", lower},
      {"wrong_place_px", "Pixels filled with another place of the surface", "px", lower}};
  own.insert(own.end(), hits.begin(), hits.end());
  return own;
}

std::vector<Counter> hitCounters(const HitErrors& errors) {
  return {{"surface_px", double(errors.exactHits)},
          {"missed_px", double(errors.missed)},
          {"hole_px", double(errors.holes)},
          {"false_px", double(errors.falseHits)},
          {"wrong_place_px", double(errors.wrongPlace)}};
}

std::vector<double> seenDistances(const Image& seen) {
  std::vector<double> out;
  for (size_t i = 0; i < seen.pixels(); ++i) out.push_back(seen.data[4 * i + 3]);
  return out;
}

std::vector<Counter> hitCounters(frame::Frame& frame, const Image& seen) {
  // Only what is not proven to cross the ray depends on it.
  constexpr double kExactPx = 1e-6;
  const surfaces::SurfaceView view = viewOf(frame);
  const ExactView exact = exactView(surfaces::movedTo(frame.scene().surfaces, frame.timeS()),
                                    surfaces::RootFinder::Intervals, view, frame.sizePx(), kExactPx);
  return hitCounters(compareHits(exact, view, seenDistances(seen)));
}

}  // namespace limen::techniques
