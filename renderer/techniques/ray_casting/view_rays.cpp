// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/ray_casting/view_rays.h"

#include <algorithm>
#include <cmath>

#include "renderer/surfaces/normal.h"

namespace limen::techniques {

ViewRay viewRay(const surfaces::SurfaceView& view, glm::ivec2 pixel, glm::ivec2 sizePx) {
  const glm::dvec2 ndc = {2.0 * (pixel.x + 0.5) / sizePx.x - 1.0, 1.0 - 2.0 * (pixel.y + 0.5) / sizePx.y};
  const glm::dvec3 along =
      view.forward + ndc.x * view.tanHalf.x * view.right + ndc.y * view.tanHalf.y * view.up;
  ViewRay out;
  out.length = glm::length(along);
  out.start = view.nearest * out.length;
  out.ray = {view.eye + view.nearest * along, along / out.length};
  return out;
}

ExactView exactView(const surfaces::PatchSet& set, surfaces::RootFinder finder,
                    const surfaces::SurfaceView& view, glm::ivec2 sizePx, double tolerancePx) {
  return exactView(set, surfaces::PatchTracer(set, finder), view, sizePx, tolerancePx);
}

ExactView exactView(const surfaces::PatchSet& set, const surfaces::PatchTracer& tracer,
                    const surfaces::SurfaceView& view, glm::ivec2 sizePx, double tolerancePx) {
  double depth = 1e300;
  for (const glm::dvec4& p : set.points)
    depth = std::min(depth, glm::dot(glm::dvec3(p) / p.w - view.eye, view.forward));
  const double tolerance = tolerancePx * std::max(depth, view.nearest) / view.pxAtDistance;
  ExactView out;
  out.sizePx = sizePx;
  out.pixels.resize(static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y));
  std::vector<surfaces::RootCounts> counts(coresForRays());
  forAllPixels(out.pixels.size(), [&](size_t thread, size_t i) {
    const auto number = static_cast<int>(i);
    const ViewRay ray = viewRay(view, {number % sizePx.x, number / sizePx.x}, sizePx);
    const auto hit = tracer.nearest(ray.ray, tolerance, &counts[thread]);
    if (!hit) return;
    ExactPixel& pixel = out.pixels[i];
    pixel.hit = true, pixel.at = *hit, pixel.distance = ray.distanceAt(hit->t);
    const surfaces::Patch& patch = set.patches[hit->patch];
    const glm::dvec3 geometric = surfaces::geometricNormal(set, patch, hit->at).direction;
    const double cosine = glm::dot(geometric, ray.ray.direction);
    pixel.normal = surfaces::normalAt(set, patch, hit->at).direction;
    if (cosine > 0.0) pixel.normal = -pixel.normal;
    pixel.slope = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / std::max(std::abs(cosine), 1e-9);
  });
  for (const surfaces::RootCounts& one : counts) {
    out.counts.steps += one.steps, out.counts.splits += one.splits;
    out.counts.duplicates += one.duplicates, out.counts.falseReports += one.falseReports;
    out.counts.unproven += one.unproven;
  }
  return out;
}

HitErrors compareHits(const ExactView& exact, const surfaces::SurfaceView& view,
                      const std::vector<double>& distances) {
  HitErrors out;
  const glm::ivec2 size = exact.sizePx;
  const auto surrounded = [&](int x, int y) {
    for (int j = y - 1; j <= y + 1; ++j)
      for (int i = x - 1; i <= x + 1; ++i)
        if (i >= 0 && j >= 0 && i < size.x && j < size.y && !exact.at(i, j).hit) return false;
    return true;
  };
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const ExactPixel& known = exact.at(x, y);
      const double found = distances[static_cast<size_t>(y * size.x + x)];
      out.exactHits += known.hit;
      if (known.hit && !(found > 0.0)) {
        ++out.missed;
        out.holes += surrounded(x, y);
      }
      if (!known.hit && found > 0.0) ++out.falseHits;
      if (known.hit && found > 0.0) {
        const double pixel = known.distance / view.pxAtDistance;
        out.wrongPlace += std::abs(found - known.distance) > 4.0 * pixel * (1.0 + known.slope);
      }
    }
  return out;
}

}  // namespace limen::techniques
