// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/isocurves/scan_lines.h"

#include <algorithm>
#include <cmath>
#include <list>

#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/normal.h"
#include "renderer/surfaces/patch_convert.h"

namespace limen::techniques {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

constexpr int kMostHalvings = 24;

/// A part of a patch. Control points are homogeneous on the screen: x and y in pixels from the top left
/// corner and depth along the view, each times the weight.
struct ScanPart {
  uint32_t patch = 0;
  int m = 1, n = 1, halvings = 0;
  std::vector<dvec4> points;  // (x w d, y w d, -, w d): d the depth
  dvec2 low{0.0}, high{1.0};  // of the domain
  /// Pixels of the corners (0, 0), (1, 0), (1, 1), (0, 1), if they lie in front of the eye.
  std::array<dvec2, 4> corners{};
  /// Sides that count as straight, from one corner to the next. Parts on both sides of one see the same curve
  /// and find the same; from then on all vertices on it lie on its chord, however either part is halved, so
  /// that nothing shows between them (Lane et al. 1980; Clark 1979).
  std::array<bool, 4> straight{};
};

/// A corner of a flat part: pixels, 1 / depth, parameters.
struct ScanCorner {
  dvec2 at;
  double inverse = 0.0;
  dvec2 parameters;
};
struct ScanTriangle {
  uint32_t patch = 0;
  std::array<ScanCorner, 3> corners;
  double bottom = 0.0;
};

class ScanLines {
 public:
  ScanLines(const surfaces::PatchSet& set, const surfaces::SurfaceView& view, glm::ivec2 sizePx,
            double tolerancePx, ScanLineCounts& counts)
      : set_(set),
        view_(view),
        size_(sizePx),
        tolerance_(tolerancePx),
        counts_(counts),
        waiting_(static_cast<size_t>(sizePx.y)) {}

  ExactView run() {
    ExactView out;
    out.sizePx = size_;
    out.pixels.resize(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y));
    for (uint32_t i = 0; i < set_.patches.size(); ++i) wait(partOf(i), 0);
    for (int line = 0; line < size_.y; ++line) {
      std::vector<ScanPart> arrived = std::move(waiting_[static_cast<size_t>(line)]);
      while (!arrived.empty()) {
        ScanPart part = std::move(arrived.back());
        arrived.pop_back();
        if (isFlat(part)) {
          emit(part);
          continue;
        }
        ++counts_.splits;
        for (ScanPart& half : halves(part)) {
          const int first = firstLine(half);
          if (first > line) {
            wait(std::move(half), line);
          } else if (first >= 0) {
            arrived.push_back(std::move(half));
          }
        }
      }
      counts_.mostActive = std::max(counts_.mostActive, static_cast<int64_t>(active_.size()));
      const double y = line + 0.5;
      for (const ScanTriangle& triangle : active_) draw(triangle, y, line, out);
      active_.remove_if([&](const ScanTriangle& triangle) { return triangle.bottom < y; });
    }
    for (ExactPixel& pixel : out.pixels) finish(pixel);
    return out;
  }

 private:
  ScanPart partOf(uint32_t number) const {
    const surfaces::Patch& patch = set_.patches[number];
    surfaces::PatchSet converted;
    const bool triangle = patch.domain == surfaces::Domain::Triangle;
    const surfaces::Patch rectangle = triangle ? triangleAsRectangle(set_, patch, converted) : patch;
    const std::vector<dvec4>& points = triangle ? converted.points : set_.points;
    ScanPart out;
    out.patch = number, out.m = rectangle.degreeU, out.n = rectangle.degreeV;
    for (int i = 0; i < rectangle.points(); ++i) {
      const dvec4& p = points[rectangle.firstPoint + static_cast<uint32_t>(i)];
      const dvec3 away = dvec3(p) - p.w * view_.eye;
      const double depth = glm::dot(away, view_.forward);
      out.points.emplace_back(0.5 * size_.x * depth + glm::dot(away, view_.right) * view_.pxAtDistance,
                              0.5 * size_.y * depth - glm::dot(away, view_.up) * view_.pxAtDistance, 0.0,
                              depth);
    }
    for (size_t c = 0; c < 4; ++c) out.corners[c] = cornerOf(out, c);
    for (size_t side = 0; side < 4; ++side) out.straight[side] = isStraight(out, side);
    return out;
  }

  static const dvec4& pointAt(const ScanPart& part, int i, int j) {
    return part.points[static_cast<size_t>(i + (part.m + 1) * j)];
  }
  static dvec2 cornerOf(const ScanPart& part, size_t corner) {
    const dvec4& p = pointAt(part, corner == 1 || corner == 2 ? part.m : 0, corner >= 2 ? part.n : 0);
    return dvec2(p) / p.w;
  }

  bool isStraight(const ScanPart& part, size_t side) const {
    const bool alongU = side % 2 == 0;
    const int degree = alongU ? part.m : part.n, across = side == 1 ? part.m : side == 2 ? part.n : 0;
    const auto at = [&](int k) -> const dvec4& {
      return alongU ? pointAt(part, k, across) : pointAt(part, across, k);
    };
    for (int k = 0; k <= degree; ++k)
      if (!(at(k).w > 0.0)) return false;
    const dvec2 first = dvec2(at(0)) / at(0).w, last = dvec2(at(degree)) / at(degree).w;
    for (int k = 1; k < degree; ++k)
      if (glm::length(dvec2(at(k)) / at(k).w - glm::mix(first, last, double(k) / degree)) > tolerance_)
        return false;
    return true;
  }

  /// Corners and sides of both halves.
  void joinHalves(const ScanPart& part, bool alongU, std::array<ScanPart, 2>& halves) const {
    // Corners of the first half, that of the second, and the side from the one to the other that is cut.
    constexpr size_t kCuts[2][2][3] = {{{1, 0, 0}, {2, 3, 2}}, {{2, 1, 1}, {3, 0, 3}}};
    for (const size_t(&cut)[3] : kCuts[alongU ? 0 : 1]) {
      const dvec2 middle = part.straight[cut[2]] ? 0.5 * (part.corners[cut[0]] + part.corners[cut[1]])
                                                 : cornerOf(halves[0], cut[0]);
      halves[0].corners[cut[0]] = middle, halves[1].corners[cut[1]] = middle;
      for (ScanPart& half : halves) half.straight[cut[2]] = part.straight[cut[2]] || isStraight(half, cut[2]);
    }
    halves[0].straight[alongU ? 1 : 2] = halves[1].straight[alongU ? 3 : 0] =
        isStraight(halves[0], alongU ? 1 : 2);
  }

  /// Weights times depths are positive in front of the eye; the near plane as a share of them is not known,
  /// so that parts that reach behind the eye are halved further.
  static bool inFront(const ScanPart& part) {
    return std::ranges::all_of(part.points, [](const dvec4& p) { return p.w > 0.0; });
  }

  /// The first line whose centre the box of the control points and corners reaches; -1: none.
  int firstLine(const ScanPart& part) const {
    if (std::ranges::all_of(part.points, [](const dvec4& p) { return p.w <= 0.0; })) return -1;
    if (!inFront(part)) return 0;
    dvec2 low(1e300), high(-1e300);
    for (const dvec4& p : part.points)
      low = glm::min(low, dvec2(p) / p.w), high = glm::max(high, dvec2(p) / p.w);
    for (const dvec2& corner : part.corners) low = glm::min(low, corner), high = glm::max(high, corner);
    if (high.x < 0.5 || low.x > size_.x - 0.5) return -1;
    const double first = std::max(std::ceil(low.y - 0.5), 0.0);
    return first + 0.5 > high.y || first > size_.y - 1 ? -1 : static_cast<int>(first);
  }

  void wait(ScanPart part, int line) {
    const int first = firstLine(part);
    if (first >= 0) waiting_[static_cast<size_t>(std::max(first, line))].push_back(std::move(part));
  }

  bool isFlat(const ScanPart& part) const {
    if (part.halvings >= kMostHalvings) return true;
    if (!inFront(part)) return false;
    const auto at = [&](int i, int j) {
      const dvec4& p = part.points[static_cast<size_t>(i + (part.m + 1) * j)];
      return dvec2(p) / p.w;
    };
    const dvec2 a = at(0, 0), b = at(part.m, 0), c = at(part.m, part.n), d = at(0, part.n);
    for (int j = 0; j <= part.n; ++j)
      for (int i = 0; i <= part.m; ++i) {
        const double u = double(i) / part.m, v = double(j) / part.n;
        if (glm::length(at(i, j) - glm::mix(glm::mix(a, b, u), glm::mix(d, c, u), v)) > tolerance_)
          return false;
      }
    // The twist of the quad, which its two triangles leave out.
    return 0.25 * glm::length(a - b + c - d) <= tolerance_;
  }

  /// Along the direction that is longer on the screen.
  std::array<ScanPart, 2> halves(const ScanPart& part) const {
    double u = 0.0, v = 0.0;
    const auto at = [&](int i, int j) -> const dvec4& {
      return part.points[static_cast<size_t>(i + (part.m + 1) * j)];
    };
    const auto length = [](const dvec4& p, const dvec4& q) {
      return p.w > 0.0 && q.w > 0.0 ? glm::length(dvec2(p) / p.w - dvec2(q) / q.w) : 1e6;
    };
    for (int j = 0; j <= part.n; ++j)
      for (int i = 0; i < part.m; ++i) u = std::max(u, part.m * length(at(i, j), at(i + 1, j)));
    for (int j = 0; j < part.n; ++j)
      for (int i = 0; i <= part.m; ++i) v = std::max(v, part.n * length(at(i, j), at(i, j + 1)));
    const bool alongU = u != v ? u > v : part.halvings % 2 == 0;
    std::array<ScanPart, 2> out = {part, part};
    for (ScanPart& half : out) ++half.halvings;
    const int degree = alongU ? part.m : part.n, lines = alongU ? part.n : part.m;
    const int step = alongU ? 1 : part.m + 1, across = alongU ? part.m + 1 : 1;
    for (int line = 0; line <= lines; ++line) {
      std::vector<dvec4> b(static_cast<size_t>(degree) + 1);
      for (int k = 0; k <= degree; ++k)
        b[static_cast<size_t>(k)] = part.points[static_cast<size_t>(line * across + k * step)];
      for (int r = 0; r <= degree; ++r) {
        out[0].points[static_cast<size_t>(line * across + r * step)] = b[0];
        out[1].points[static_cast<size_t>(line * across + (degree - r) * step)] =
            b[static_cast<size_t>(degree - r)];
        for (int k = 0; k < degree - r; ++k)
          b[static_cast<size_t>(k)] = 0.5 * (b[static_cast<size_t>(k)] + b[static_cast<size_t>(k) + 1]);
      }
    }
    const int axis = alongU ? 0 : 1;
    out[0].high[axis] = out[1].low[axis] = 0.5 * (part.low[axis] + part.high[axis]);
    joinHalves(part, alongU, out);
    return out;
  }

  void emit(const ScanPart& part) {
    if (!inFront(part)) return;
    ++counts_.polygons;
    const auto corner = [&](size_t c) {
      return ScanCorner{part.corners[c],
                        0.0,
                        {c == 1 || c == 2 ? part.high.x : part.low.x, c >= 2 ? part.high.y : part.low.y}};
    };
    std::array<ScanCorner, 4> corners = {corner(0), corner(1), corner(2), corner(3)};
    for (ScanCorner& c : corners) c.inverse = 1.0 / depthAt(part.patch, c.parameters);
    for (const std::array<size_t, 3>& t : {std::array<size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
      ScanTriangle triangle{part.patch, {corners[t[0]], corners[t[1]], corners[t[2]]}, 0.0};
      triangle.bottom =
          std::max({triangle.corners[0].at.y, triangle.corners[1].at.y, triangle.corners[2].at.y});
      active_.push_back(triangle);
    }
  }

  surfaces::DomainPoint placeOf(uint32_t patch, dvec2 at) const {
    // A triangle's u and v of the rectangle's x and y: see triangleAsRectangle().
    return set_.patches[patch].domain == surfaces::Domain::Triangle
               ? surfaces::trianglePoint(at.x * (1.0 - at.y), at.y)
               : surfaces::rectanglePoint(at.x, at.y);
  }

  double depthAt(uint32_t patch, dvec2 at) const {
    const dvec3 p =
        surfaces::evaluate(set_, set_.patches[patch], placeOf(patch, at), surfaces::Order::Position).p;
    return glm::dot(p - view_.eye, view_.forward);
  }

  void draw(const ScanTriangle& triangle, double y, int line, ExactView& out) const {
    // Where the line crosses the sides.
    std::array<ScanCorner, 2> ends;
    size_t found = 0;
    for (size_t k = 0; k < 3 && found < 2; ++k) {
      const ScanCorner *a = &triangle.corners[k], *b = &triangle.corners[(k + 1) % 3];
      if ((a->at.y > y) == (b->at.y > y)) continue;
      if (a->at.y > b->at.y) std::swap(a, b);  // the same bits whichever way the side runs
      const double t = (y - a->at.y) / (b->at.y - a->at.y);
      ends[found++] = {glm::mix(a->at, b->at, t), glm::mix(a->inverse, b->inverse, t),
                       glm::mix(a->parameters, b->parameters, t)};
    }
    if (found < 2) return;
    if (ends[0].at.x > ends[1].at.x) std::swap(ends[0], ends[1]);
    const int first = std::max(0, static_cast<int>(std::ceil(ends[0].at.x - 0.5))),
              last = std::min(size_.x - 1, static_cast<int>(std::ceil(ends[1].at.x - 0.5)) - 1);
    for (int x = first; x <= last; ++x) {
      const double t = (x + 0.5 - ends[0].at.x) / (ends[1].at.x - ends[0].at.x);
      const double inverse = glm::mix(ends[0].inverse, ends[1].inverse, t);
      ExactPixel& pixel = out.pixels[static_cast<size_t>(line * size_.x + x)];
      if (!(inverse > 0.0) || inverse * view_.nearest > 1.0 || (pixel.hit && pixel.distance * inverse <= 1.0))
        continue;
      const dvec2 at = glm::mix(ends[0].parameters, ends[1].parameters, t);
      pixel.hit = true, pixel.distance = 1.0 / inverse;
      pixel.at = {0.0, triangle.patch, placeOf(triangle.patch, at)};
    }
  }

  void finish(ExactPixel& pixel) const {
    if (!pixel.hit) return;
    const surfaces::Patch& patch = set_.patches[pixel.at.patch];
    const dvec3 away = surfaces::evaluate(set_, patch, pixel.at.at, surfaces::Order::Position).p - view_.eye;
    pixel.normal = surfaces::normalAt(set_, patch, pixel.at.at).direction;
    if (glm::dot(surfaces::geometricNormal(set_, patch, pixel.at.at).direction, away) > 0.0)
      pixel.normal = -pixel.normal;
  }

  const surfaces::PatchSet& set_;
  const surfaces::SurfaceView& view_;
  glm::ivec2 size_;
  double tolerance_;
  ScanLineCounts& counts_;
  std::vector<std::vector<ScanPart>> waiting_;  // by the line that they wait for
  std::list<ScanTriangle> active_;
};

}  // namespace

ExactView scanLineView(const surfaces::PatchSet& set, const surfaces::SurfaceView& view, glm::ivec2 sizePx,
                       double tolerancePx, ScanLineCounts& counts) {
  return ScanLines(set, view, sizePx, tolerancePx, counts).run();
}

}  // namespace limen::techniques
