// SPDX-License-Identifier: BSD-3-Clause
#include "tests/renderer/techniques/quad_mask_twin.h"

#include <algorithm>
#include <cmath>

namespace limen::techniques {

Step toStep(glm::vec2 corner, int side) {
  // Exact but for the rounding itself: a float times a power of two.
  return {std::llrint(double(corner.x) * side * 4096.0), std::llrint(double(corner.y) * side * 4096.0)};
}

__int128 doubledArea(Step a, Step b, Step c) {
  return static_cast<__int128>(b.x - a.x) * (c.y - a.y) - static_cast<__int128>(b.y - a.y) * (c.x - a.x);
}

std::vector<Step> monotoneChain(std::vector<Step> points) {
  std::sort(points.begin(), points.end(),
            [](Step a, Step b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Step> hull;
  for (int half = 0; half < 2; ++half) {
    const size_t start = hull.size();
    for (const Step& point : points) {
      while (hull.size() >= start + 2 && doubledArea(hull[hull.size() - 2], hull.back(), point) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    if (!hull.empty()) hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::vector<bool> samplesWithin(const std::vector<Step>& hull, const SamplePattern& pattern) {
  std::vector<bool> within(static_cast<size_t>(pattern.samples()), hull.size() >= 3);
  if (hull.size() < 3) return within;
  for (int j = 0; j < pattern.side; ++j)
    for (int i = 0; i < pattern.side; ++i)
      for (size_t k = 0; k < hull.size(); ++k) {
        const Step a = hull[k], b = hull[(k + 1) % hull.size()];
        const __int128 area = doubledArea(a, b, Step(pattern.quarters(i, j)) * int64_t{1024});
        // Left of its place is to the left of an edge that points upwards; below it, of one that points to
        // -x.
        const bool tieIsLeft = b.y > a.y || (b.y == a.y && b.x < a.x);
        if (area < 0 || (area == 0 && !tieIsLeft)) within[static_cast<size_t>(j * pattern.side + i)] = false;
      }
  return within;
}

double distanceFromEdges(const std::vector<Step>& hull, glm::dvec2 sample, int side) {
  double nearest = 1e300;
  for (size_t k = 0; k < hull.size(); ++k) {
    const glm::dvec2 a = glm::dvec2(hull[k]) / (4096.0 * side),
                     b = glm::dvec2(hull[(k + 1) % hull.size()]) / (4096.0 * side);
    const glm::dvec2 along = glm::normalize(b - a);
    nearest = std::min(nearest, std::abs(along.x * (sample.y - a.y) - along.y * (sample.x - a.x)));
  }
  return nearest;
}

std::vector<Quad> hardQuads(const SamplePattern& pattern, int count) {
  std::mt19937 random(20260303);
  std::uniform_real_distribution<float> around(-0.6F, 1.6F), small(-1.0F, 1.0F);
  std::uniform_int_distribution<int> onGrid(-2 * pattern.side, 6 * pattern.side), two(0, 1);
  const auto anywhere = [&] { return glm::vec2(around(random), around(random)); };
  const auto gridPoint = [&] {
    return glm::vec2(onGrid(random), onGrid(random)) / static_cast<float>(4 * pattern.side);
  };
  const auto beside = [&](float v) { return std::nextafter(v, two(random) ? 9.0F : -9.0F); };
  std::vector<Quad> out;
  for (int n = 0; n < count; ++n) {
    Quad q;
    switch (n % 9) {
      case 0:
        for (glm::vec2& corner : q) corner = anywhere();
        break;
      case 1:
        for (glm::vec2& corner : q) corner = gridPoint();
        break;
      case 2:
        for (glm::vec2& corner : q) {
          corner = gridPoint();
          corner = {beside(corner.x), beside(corner.y)};
        }
        break;
      case 3: {  // smaller than the distance between two samples
        const glm::vec2 middle = two(random) ? anywhere() : gridPoint();
        for (glm::vec2& corner : q)
          corner = middle + glm::vec2(small(random), small(random)) / static_cast<float>(pattern.side);
        break;
      }
      case 4: {  // a sliver: two edges almost parallel
        const glm::vec2 a = anywhere(), b = anywhere();
        q = {a, b, b + 1e-4F * glm::vec2(small(random), small(random)),
             a + 1e-4F * glm::vec2(small(random), small(random))};
        break;
      }
      case 5: {  // three on a line
        const glm::vec2 a = gridPoint(), b = gridPoint();
        q = {a, b, 0.5F * (a + b), gridPoint()};
        std::shuffle(q.begin(), q.end(), random);
        break;
      }
      case 6: {  // four on a line
        const glm::vec2 a = gridPoint(), b = gridPoint();
        q = {a, b, 0.5F * (a + b), 2.0F * b - a};
        std::shuffle(q.begin(), q.end(), random);
        break;
      }
      case 7: {  // repeated corners: a triangle, a line or a point
        const glm::vec2 a = gridPoint(), b = anywhere(), c = gridPoint();
        const int kind = n / 9 % 4;
        q = kind == 0   ? Quad{a, b, c, c}
            : kind == 1 ? Quad{a, a, b, c}
            : kind == 2 ? Quad{a, b, a, b}
                        : Quad{a, a, a, a};
        if (kind < 2) std::shuffle(q.begin(), q.end(), random);
        break;
      }
      default: {  // parallel to the light's edges
        const glm::vec2 a = two(random) ? gridPoint() : anywhere(),
                        b = two(random) ? gridPoint() : anywhere();
        q = {a, glm::vec2(b.x, a.y), b, glm::vec2(a.x, b.y)};
        break;
      }
    }
    out.push_back(q);
  }
  return out;
}

std::vector<Quad> meshQuads(int perLight, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F), jitter(-0.2F, 0.2F), turn(-1.6F, 1.6F);
  std::vector<Quad> out;
  for (int n = 0; n < count; ++n) {
    // A mesh turned and sheared as that of a tilted surface.
    const float angle = 0.3F * turn(random), shear = 0.3F * turn(random);
    const float cell = 1.0F / static_cast<float>(perLight);
    const glm::mat2 axes = glm::mat2(std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle)) *
                           glm::mat2(cell, 0.0F, shear * cell, cell);
    const glm::vec2 middle(unit(random), unit(random));
    Quad q{glm::vec2(-0.5F, -0.5F), glm::vec2(0.5F, -0.5F), glm::vec2(0.5F, 0.5F), glm::vec2(-0.5F, 0.5F)};
    for (glm::vec2& corner : q) corner = middle + axes * (corner + glm::vec2(jitter(random), jitter(random)));
    out.push_back(q);
  }
  return out;
}

}  // namespace limen::techniques
