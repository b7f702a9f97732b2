// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/trim_mask.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limen::surfaces {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * along);
}

template <class Visit>
void forSegments(const TrimRegion& region, Visit visit) {
  for (const std::vector<glm::dvec2>& loop : region.loops)
    for (size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[(i + 1) % loop.size()]);
}

}  // namespace

bool TrimRegion::contains(glm::dvec2 at) const {
  bool inside = false;
  forSegments(*this, [&](glm::dvec2 a, glm::dvec2 b) {
    if ((a.y > at.y) == (b.y > at.y)) return;
    if (at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  });
  return inside;
}

double TrimRegion::area() const {
  // A loop inside an odd number of others is a hole.
  double sum = 0.0;
  for (size_t i = 0; i < loops.size(); ++i) {
    double twice = 0.0;
    for (size_t k = 0; k < loops[i].size(); ++k)
      twice += cross(loops[i][k], loops[i][(k + 1) % loops[i].size()]);
    TrimRegion others = *this;
    others.loops.erase(others.loops.begin() + static_cast<long>(i));
    sum += 0.5 * std::abs(twice) * (others.contains(loops[i][0]) ? -1.0 : 1.0);
  }
  return sum;
}

std::vector<glm::dvec2> trimLoop(std::span<const std::vector<glm::dvec3>> curves, int segments) {
  std::vector<glm::dvec2> out;
  for (const std::vector<glm::dvec3>& curve : curves)
    for (int i = 0; i < segments; ++i) {
      const double t = double(i) / segments;
      std::vector<glm::dvec3> points = curve;
      for (size_t n = points.size() - 1; n > 0; --n)
        for (size_t k = 0; k < n; ++k) points[k] = glm::mix(points[k], points[k + 1], t);
      out.push_back(glm::dvec2(points[0]) / points[0].z);
    }
  return out;
}

TrimMask::TrimMask(const TrimRegion& region, int resolution, TrimTexture texture)
    : resolution_(resolution), texture_(texture) {
  for (int y = 0; y < resolution; ++y)
    for (int x = 0; x < resolution; ++x) {
      const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / double(resolution);
      const bool inside = region.contains(at);
      if (texture == TrimTexture::Inside) {
        texels_.push_back(inside ? 1.0F : 0.0F);
        continue;
      }
      double nearest = std::numeric_limits<double>::max();
      forSegments(region, [&](glm::dvec2 a, glm::dvec2 b) {
        nearest = std::min(nearest, distanceToSegment(at, a, b));
      });
      texels_.push_back(float(inside ? nearest : -nearest));
    }
}

float TrimMask::texel(int x, int y) const {
  const int last = resolution_ - 1;
  return texels_[static_cast<size_t>(std::clamp(x, 0, last) + resolution_ * std::clamp(y, 0, last))];
}

bool TrimMask::contains(glm::dvec2 at) const {
  const glm::dvec2 place = at * double(resolution_);
  if (texture_ == TrimTexture::Inside)
    return texel(int(std::floor(place.x)), int(std::floor(place.y))) > 0.5F;
  const glm::dvec2 low = glm::floor(place - 0.5), share = place - 0.5 - low;
  const int x = int(low.x), y = int(low.y);
  const double below = glm::mix(double(texel(x, y)), double(texel(x + 1, y)), share.x),
               above = glm::mix(double(texel(x, y + 1)), double(texel(x + 1, y + 1)), share.x);
  return glm::mix(below, above, share.y) > 0.0;
}

double trimError(const TrimRegion& region, const TrimMask& mask, int samples) {
  int64_t wrong = 0;
  for (int y = 0; y < samples; ++y)
    for (int x = 0; x < samples; ++x) {
      const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / double(samples);
      wrong += region.contains(at) != mask.contains(at);
    }
  return double(wrong) / (double(samples) * samples);
}

}  // namespace limen::surfaces
