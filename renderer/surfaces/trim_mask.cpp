// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/trim_mask.h"

#include <algorithm>
#include <cmath>

namespace limen::surfaces {

namespace {

/// The x at which a row crosses the curves, ascending, by the rule of TrimRegion::contains().
std::vector<double> crossingsOf(const TrimRegion& region, double y) {
  std::vector<double> out;
  forSegments(region, [&](glm::dvec2 a, glm::dvec2 b) {
    if ((a.y > y) != (b.y > y)) out.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  });
  std::ranges::sort(out);
  return out;
}

bool isInside(const std::vector<double>& crossings, double x) {
  return (crossings.end() - std::ranges::upper_bound(crossings, x)) % 2 == 1;
}

}  // namespace

TrimMask::TrimMask(const TrimRegion& region, int resolution, TrimTexture texture)
    : resolution_(resolution), texture_(texture) {
  const auto middle = [&](int texel) { return (texel + 0.5) / resolution; };
  const bool distances = texture == TrimTexture::Distance;
  const double reach = 4.0 / resolution;
  for (int y = 0; y < resolution; ++y) {
    const std::vector<double> crossings = crossingsOf(region, middle(y));
    for (int x = 0; x < resolution; ++x) {
      const bool inside = isInside(crossings, middle(x));
      texels_.push_back(distances ? float(inside ? reach : -reach) : inside ? 1.0F : 0.0F);
    }
  }
  if (!distances) return;
  forSegments(region, [&](glm::dvec2 a, glm::dvec2 b) {
    const auto first = [&](double at) { return std::max(0, int(std::floor((at - reach) * resolution))); };
    const auto last = [&](double at) {
      return std::min(resolution - 1, int(std::ceil((at + reach) * resolution)));
    };
    for (int y = first(std::min(a.y, b.y)); y <= last(std::max(a.y, b.y)); ++y)
      for (int x = first(std::min(a.x, b.x)); x <= last(std::max(a.x, b.x)); ++x) {
        float& held = texels_[static_cast<size_t>(x + resolution * y)];
        const auto distance = float(distanceToSegment({middle(x), middle(y)}, a, b));
        if (distance < std::abs(held)) held = std::copysign(distance, held);
      }
  });
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
  for (int y = 0; y < samples; ++y) {
    const std::vector<double> crossings = crossingsOf(region, (y + 0.5) / samples);
    for (int x = 0; x < samples; ++x) {
      const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / double(samples);
      wrong += isInside(crossings, at.x) != mask.contains(at);
    }
  }
  return double(wrong) / (double(samples) * samples);
}

}  // namespace limen::surfaces
