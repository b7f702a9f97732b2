// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask_coloured/light_colours.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "renderer/scene/light.h"

namespace limen::techniques {
namespace {

using Polygon = std::vector<glm::dvec2>;

/// The part of a polygon with sign * coordinate <= sign * bound (Sutherland and Hodgman 1974). For a
/// non-convex polygon, several pieces may be connected by degenerate edges.
Polygon clip(const Polygon& polygon, int axis, double sign, double bound) {
  Polygon out;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double outsideA = sign * (a[axis] - bound), outsideB = sign * (b[axis] - bound);
    if (outsideA <= 0.0) out.push_back(a);
    if ((outsideA < 0.0 && outsideB > 0.0) || (outsideA > 0.0 && outsideB < 0.0))
      out.push_back(glm::mix(a, b, outsideA / (outsideA - outsideB)));
  }
  return out;
}

double areaWithin(Polygon polygon, glm::dvec2 low, glm::dvec2 high) {
  for (int axis = 0; axis < 2; ++axis) {
    polygon = clip(polygon, axis, -1.0, low[axis]);
    polygon = clip(polygon, axis, 1.0, high[axis]);
  }
  return polygon.size() < 3 ? 0.0 : scene::signedArea(polygon);
}

/// Box around a polygon.
struct Bounds2 {
  glm::dvec2 low{1e300}, high{-1e300};
  explicit Bounds2(const Polygon& polygon) {
    for (const glm::dvec2 vertex : polygon) low = glm::min(low, vertex), high = glm::max(high, vertex);
  }
};

/// Share of a sample's cell, or of the sample itself, that lies in a part.
double shareIn(const scene::LightPart& part, const Bounds2& bounds, glm::dvec2 sample, int cells) {
  if (part.outline.empty()) return 1.0;
  if (cells == 0) {
    // A sample on the edge between two parts belongs to the one to its right or above.
    const glm::dvec2 inside = sample + glm::dvec2(0x1p-30, 0x1p-31);
    return scene::polygonContains(part.outline, inside) ? 1.0 : 0.0;
  }
  const glm::dvec2 low = glm::floor(sample * double(cells)) / double(cells), high = low + 1.0 / cells;
  return bounds.low.x >= high.x || bounds.low.y >= high.y || bounds.high.x <= low.x || bounds.high.y <= low.y
             ? 0.0
             : areaWithin(part.outline, low, high) * cells * cells;
}

}  // namespace

std::vector<glm::dvec3> emissionShares(const scene::AreaLight& light, const std::vector<glm::dvec2>& samples,
                                       int cells) {
  std::vector<Bounds2> bounds;
  for (const scene::LightPart& part : light.parts) bounds.emplace_back(part.outline);
  std::vector<glm::dvec3> emitted(samples.size(), glm::dvec3(0.0));
  glm::dvec3 sum(0.0);
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!light.contains(samples[i])) continue;
    for (size_t part = 0; part < light.parts.size(); ++part)
      emitted[i] += glm::dvec3(light.parts[part].radiance) *
                    shareIn(light.parts[part], bounds[part], samples[i], cells);
    sum += emitted[i];
  }
  for (glm::dvec3& share : emitted)
    for (int channel = 0; channel < 3; ++channel)
      share[channel] = sum[channel] > 0.0 ? share[channel] / sum[channel] : 0.0;
  return emitted;
}

std::vector<ColourMask> colourMasks(const std::vector<glm::dvec3>& shares) {
  std::vector<ColourMask> out;
  for (size_t i = 0; i < shares.size(); ++i) {
    if (shares[i] == glm::dvec3(0.0)) continue;
    // Cells of one colour may differ by the rounding of their areas.
    auto known = std::find_if(out.begin(), out.end(), [&](const ColourMask& colour) {
      return glm::all(glm::lessThanEqual(glm::abs(colour.share - shares[i]), 1e-9 * colour.share));
    });
    if (known == out.end())
      known = out.insert(out.end(), {shares[i], std::vector<uint32_t>((shares.size() + 31) / 32, 0)});
    known->mask[i / 32] |= 1U << (i % 32);
  }
  return out;
}

std::vector<glm::uvec2> colourTable(const std::vector<glm::dvec3>& shares, int groupBits) {
  const size_t bits = static_cast<size_t>(groupBits), patterns = size_t{1} << bits;
  const size_t groups = (shares.size() + bits - 1) / bits;
  std::vector<glm::uvec2> table;
  table.reserve(groups * patterns);
  std::vector<glm::dvec3> sums(patterns);
  for (size_t group = 0; group < groups; ++group)
    for (size_t pattern = 0; pattern < patterns; ++pattern) {
      glm::dvec3 sum(0.0);
      if (pattern > 0) {
        // A known pattern plus one bit.
        size_t bit = 0;
        while (!(pattern >> bit & 1U)) ++bit;
        const size_t sample = group * bits + bit;
        sum = sums[pattern & (pattern - 1)];
        if (sample < shares.size()) sum += shares[sample] * double(shares.size());
      }
      sums[pattern] = sum;
      table.emplace_back(glm::packHalf2x16(glm::vec2(sum)), glm::packHalf2x16(glm::vec2(sum.z, 0.0)));
    }
  return table;
}

}  // namespace limen::techniques
