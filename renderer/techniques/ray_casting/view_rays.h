// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "renderer/surfaces/patch_tracer.h"
#include "renderer/surfaces/tessellated_surface.h"

namespace limen::techniques {

/// The ray through a pixel's centre from the near plane on.
struct ViewRay {
  surfaces::Ray ray;
  double start = 0.0;   ///< distance of the ray's origin from the eye along the ray
  double length = 1.0;  ///< along the ray, of a unit of distance along the view
  /// Distance along the view of a place at `t` from the ray's origin.
  double distanceAt(double t) const { return (start + t) / length; }
};
ViewRay viewRay(const surfaces::SurfaceView& view, glm::ivec2 pixel, glm::ivec2 sizePx);

inline size_t coresForRays() { return std::max<size_t>(std::thread::hardware_concurrency(), 1); }

/// work(thread, pixel) for all pixels on all cores; `thread` is below coresForRays(). Must not throw.
template <class Work>
void forAllPixels(size_t pixels, const Work& work) {
  constexpr size_t kPiece = 64;  // small: costs of rays differ widely
  std::atomic<size_t> next = 0;
  const auto run = [&](size_t thread) {
    for (size_t first = next.fetch_add(kPiece); first < pixels; first = next.fetch_add(kPiece))
      for (size_t i = first; i < std::min(first + kPiece, pixels); ++i) work(thread, i);
  };
  std::vector<std::jthread> helpers;
  for (size_t thread = 1; thread < coresForRays(); ++thread) helpers.emplace_back(run, thread);
  run(0);
}

/// What each pixel of a picture sees of a scene's patches alone, by a root finder in double precision.
struct ExactPixel {
  bool hit = false;
  surfaces::PatchHit at;
  double distance = 0.0;   ///< along the view
  glm::dvec3 normal{0.0};  ///< unit, of the patch's normal field if it has one; turned to the camera
  double slope = 0.0;      ///< tangent of the angle between the ray and the surface's geometric normal
};
struct ExactView {
  glm::ivec2 sizePx{0};
  std::vector<ExactPixel> pixels;  ///< row 0 at the top
  surfaces::RootCounts counts;
  const ExactPixel& at(int x, int y) const { return pixels[static_cast<size_t>(y * sizePx.x + x)]; }
};
/// `tolerancePx`: distance from the ray, in pixels where the surface is nearest, at which it counts as hit.
ExactView exactView(const surfaces::PatchSet& set, surfaces::RootFinder finder,
                    const surfaces::SurfaceView& view, glm::ivec2 sizePx, double tolerancePx);
/// The same with a tracer of the set.
ExactView exactView(const surfaces::PatchSet& set, const surfaces::PatchTracer& tracer,
                    const surfaces::SurfaceView& view, glm::ivec2 sizePx, double tolerancePx);

/// A picture's hits compared with the exact ones.
struct HitErrors {
  int64_t exactHits = 0;
  int64_t missed = 0;     ///< pixels that see the surface and were left empty
  int64_t holes = 0;      ///< of those, pixels whose eight neighbours see the surface as well
  int64_t falseHits = 0;  ///< pixels that do not see the surface and were filled
  int64_t wrongPlace =
      0;  ///< pixels filled with another place: more than four pixels' width away on the surface
};
/// `distances`: along the view, of each pixel; 0: no hit.
HitErrors compareHits(const ExactView& exact, const surfaces::SurfaceView& view,
                      const std::vector<double>& distances);

}  // namespace limen::techniques
