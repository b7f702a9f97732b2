// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/recursion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "renderer/surfaces/blossom.h"
#include "renderer/surfaces/normal.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec3;

/// A part of a patch's domain: counter-clockwise corners, 3 of a triangle and 4 of a rectangle. Coordinates
/// of the whole; of a triangle (u, v) with w the rest.
struct Part {
  uint32_t patch = 0;
  int steps = 0;
  std::array<dvec2, 4> corners{};
  std::array<bool, 4> straight{};  ///< sides that are replaced by their chord, or part of it
};

dvec3 barycentric(dvec2 p) { return {p.x, p.y, 1.0 - p.x - p.y}; }

/// Patches on the screen: homogeneous control points in pixels from the picture's middle.
class ScreenPatches {
 public:
  ScreenPatches(const PatchSet& set, const SurfaceView& view) : set_(set), view_(view) {
    points_.reserve(set.points.size());
    for (const glm::dvec4& p : set.points) {
      const dvec3 q = dvec3(p) - p.w * view.eye;
      points_.emplace_back(view.pxAtDistance * glm::dot(view.right, q),
                           view.pxAtDistance * glm::dot(view.up, q), glm::dot(view.forward, q));
    }
  }

  const Patch& patchOf(const Part& part) const { return set_.patches[part.patch]; }

  std::span<const dvec3> pointsOf(const Part& part, std::array<dvec3, kMostPoints>& out) const {
    const Patch& patch = patchOf(part);
    const dvec3* from = points_.data() + patch.firstPoint;
    if (patch.domain == Domain::Triangle) {
      trianglePart(patch.degreeU, from,
                   {barycentric(part.corners[0]), barycentric(part.corners[1]), barycentric(part.corners[2])},
                   out.data());
    } else {
      rectanglePart(patch.degreeU, patch.degreeV, from, {part.corners[0], part.corners[2]}, out.data());
    }
    return {out.data(), static_cast<size_t>(patch.points())};
  }

  bool isBehind(std::span<const dvec3> points) const {
    return std::any_of(points.begin(), points.end(), [&](const dvec3& p) { return p.z < view_.nearest; });
  }

  /// All to one side of the view's pyramid, or before the near plane.
  bool isOutside(std::span<const dvec3> points) const {
    const dvec2 half = view_.pxAtDistance * view_.tanHalf;
    bool out[5] = {true, true, true, true, true};
    for (const dvec3& p : points) {
      out[0] &= p.x > half.x * p.z, out[1] &= p.x < -half.x * p.z;
      out[2] &= p.y > half.y * p.z, out[3] &= p.y < -half.y * p.z;
      out[4] &= p.z < view_.nearest;
    }
    return std::any_of(std::begin(out), std::end(out), [](bool one) { return one; });
  }

 private:
  const PatchSet& set_;
  const SurfaceView& view_;
  std::vector<dvec3> points_;
};

std::vector<dvec3> sideOf(const Patch& patch, std::span<const dvec3> points, int side) {
  const int m = patch.degreeU, n = patch.degreeV;
  std::vector<dvec3> out;
  const auto add = [&](int index) { out.push_back(points[static_cast<size_t>(index)]); };
  if (patch.domain == Domain::Triangle) {
    for (int i = 0; i <= m; ++i)
      add(side == 0   ? triangleIndex(m, m - i, 0)
          : side == 1 ? triangleIndex(m, 0, i)
                      : triangleIndex(m, i, m - i));
  } else if (side == 0 || side == 2) {
    for (int i = 0; i <= m; ++i) add(side == 0 ? i : m - i + (m + 1) * n);
  } else {
    for (int j = 0; j <= n; ++j) add(side == 1 ? m + (m + 1) * j : (m + 1) * (n - j));
  }
  return out;
}

/// Which vertices there are, by a name that is the same for both patches along a common side.
class VertexNames {
 public:
  explicit VertexNames(const PatchSet& set) : set_(set) {}

  using Name = std::tuple<uint32_t, int, double, double>;
  Name nameOf(uint32_t patch, dvec2 at) const {
    const Domain domain = set_.patches[patch].domain;
    for (int side = 0; side < sidesOf(domain); ++side) {
      const double t = along(domain, side, at);
      if (!(t > 0.0 && t < 1.0) || patch >= set_.neighbours.size()) continue;
      const Neighbour& other = set_.neighbours[patch][static_cast<size_t>(side)];
      const auto there = static_cast<uint32_t>(other.patch);
      if (other.patch < 0 || std::pair(patch, side) <= std::pair(there, other.side))
        return {patch, side, t, 0.0};
      return {there, other.side, other.reversed ? 1.0 - t : t, 0.0};
    }
    return {patch, -1, at.x, at.y};
  }
  void add(uint32_t patch, dvec2 at) { names_.insert(nameOf(patch, at)); }
  bool has(uint32_t patch, dvec2 at) const { return names_.contains(nameOf(patch, at)); }
  void clear() { names_.clear(); }

 private:
  /// Place on a side in its direction; -1 off it.
  static double along(Domain domain, int side, dvec2 at) {
    if (domain == Domain::Triangle) {
      const double w = 1.0 - at.x - at.y;
      return side == 0     ? (w == 0.0 ? at.y : -1.0)
             : side == 1   ? (at.x == 0.0 ? w : -1.0)
             : at.y == 0.0 ? at.x
                           : -1.0;
    }
    switch (side) {
      case 0:
        return at.y == 0.0 ? at.x : -1.0;
      case 1:
        return at.x == 1.0 ? at.y : -1.0;
      case 2:
        return at.y == 1.0 ? 1.0 - at.x : -1.0;
      default:
        return at.x == 0.0 ? 1.0 - at.y : -1.0;
    }
  }
  const PatchSet& set_;
  std::set<Name> names_;
};

class Refinement {
 public:
  Refinement(const PatchSet& set, const SurfaceView& view, const RecursionSettings& settings,
             RecursionCounts& counts)
      : set_(set), screen_(set, view), settings_(settings), counts_(counts) {}

  void run() {
    for (uint32_t i = 0; i < set_.patches.size(); ++i) {
      const bool triangle = set_.patches[i].domain == Domain::Triangle;
      Part whole{i, 0, {dvec2{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}};
      if (triangle) whole.corners = {dvec2{1, 0}, {0, 1}, {0, 0}, {}};
      stack_.push_back(whole);
    }
    while (!stack_.empty()) {
      const Part part = stack_.back();
      stack_.pop_back();
      visit(part);
    }
    if (settings_.split == SplitPolicy::Restricted) restrict();
    counts_.faces = static_cast<int64_t>(flat_.size());
    for (const Part& part : flat_) counts_.steps = std::max(counts_.steps, part.steps);
  }

  TessellatedSurface surface(const SurfaceView& view, dvec3 anchor) {
    out_.anchor = anchor, out_.view = view;
    out_.factors.assign(set_.patches.size(), Factors{});
    names_.clear();
    if (settings_.split == SplitPolicy::Restricted)
      for (const Part& part : flat_) addCorners(part);
    for (const Part& part : flat_) draw(part);
    counts_.triangles = static_cast<int64_t>(out_.triangles.size());
    return std::move(out_);
  }

 private:
  int cornersOf(const Part& part) const { return sidesOf(set_.patches[part.patch].domain); }

  void push(const Part& parent, std::initializer_list<dvec2> corners) {
    Part part{parent.patch, parent.steps + 1, {}, {}};
    std::copy(corners.begin(), corners.end(), part.corners.begin());
    if (settings_.snap) inheritChords(parent, part);
    stack_.push_back(part);
  }

  /// Sides of the part on a straight side of its parent are straight, and a new corner there lies on the
  /// chord.
  void inheritChords(const Part& parent, Part& part) {
    const int count = cornersOf(parent);
    for (int s = 0; s < count; ++s) {
      if (!parent.straight[static_cast<size_t>(s)]) continue;
      const dvec2 a = onSide(parent, s, 0.0), b = onSide(parent, s, 1.0), middle = onSide(parent, s, 0.5);
      for (int side = 0; side < count; ++side) {
        const dvec2 from = onSide(part, side, 0.0), to = onSide(part, side, 1.0);
        const auto lies = [&](dvec2 p) { return p == a || p == b || p == middle; };
        if (lies(from) && lies(to)) part.straight[static_cast<size_t>(side)] = true;
        if (from == middle)
          snapped_.try_emplace({part.patch, middle.x, middle.y},
                               0.5 * (placeOf(part.patch, a) + placeOf(part.patch, b)));
      }
    }
  }

  dvec3 placeOf(uint32_t patch, dvec2 at) const {
    const auto found = snapped_.find({patch, at.x, at.y});
    if (found != snapped_.end()) return found->second;
    const Patch& shape = set_.patches[patch];
    return evaluate(set_, shape, domainPoint(shape.domain, at.x, at.y), Order::Position).p;
  }

  void visit(Part part) {
    ++counts_.tests;
    std::array<dvec3, kMostPoints> storage;
    const std::span<const dvec3> points = screen_.pointsOf(part, storage);
    if (settings_.cull && screen_.isOutside(points)) {
      ++counts_.culled;
      return;
    }
    const Patch& patch = screen_.patchOf(part);
    const int sides = sidesOf(patch.domain);
    std::array<bool, 4> bent{};
    bool inside = true;
    if (screen_.isBehind(points)) {
      bent.fill(true);
    } else {
      for (int side = 0; side < sides; ++side)
        bent[static_cast<size_t>(side)] =
            curveFlatness(settings_.flatness, sideOf(patch, points, side)) > settings_.tolerancePx;
      inside = (patch.domain == Domain::Triangle
                    ? triangleFlatness(settings_.flatness, patch.degreeU, points)
                    : rectangleFlatness(settings_.flatness, patch.degreeU, patch.degreeV, points)) >
               settings_.tolerancePx;
    }
    for (size_t side = 0; side < static_cast<size_t>(sides) && settings_.snap; ++side) {
      part.straight[side] |= !bent[side];
      bent[side] &= !part.straight[side];
    }
    const bool any = inside || std::any_of(bent.begin(), bent.begin() + sides, [](bool one) { return one; });
    if (!any || part.steps >= settings_.mostSteps) {
      counts_.cutShort += any;
      flat_.push_back(part);
      return;
    }
    if (settings_.split == SplitPolicy::Quarters || settings_.split == SplitPolicy::Restricted) {
      splitInFour(part);
    } else if (patch.domain == Domain::Triangle) {
      splitSides(part, bent);
    } else {
      splitRectangle(part, bent, points);
    }
  }

  void splitInFour(const Part& part) {
    const auto& c = part.corners;
    if (cornersOf(part) == 3) {
      const dvec2 ab = 0.5 * (c[0] + c[1]), bc = 0.5 * (c[1] + c[2]), ca = 0.5 * (c[2] + c[0]);
      push(part, {c[0], ab, ca}), push(part, {ab, c[1], bc}), push(part, {ca, bc, c[2]}),
          push(part, {bc, ca, ab});
      return;
    }
    const dvec2 s = 0.5 * (c[0] + c[1]), e = 0.5 * (c[1] + c[2]), n = 0.5 * (c[2] + c[3]),
                w = 0.5 * (c[3] + c[0]), m = 0.5 * (s + n);
    push(part, {c[0], s, m, w}), push(part, {s, c[1], e, m}), push(part, {m, e, c[2], n}),
        push(part, {w, m, n, c[3]});
  }

  void splitRectangle(const Part& part, const std::array<bool, 4>& bent, std::span<const dvec3> points) {
    const bool alongU = bent[0] || bent[2], alongV = bent[1] || bent[3];
    if (settings_.split == SplitPolicy::Mixed && alongU && alongV) return splitInFour(part);
    bool splitU = alongU;
    if (!alongU && !alongV) {
      // The interior alone: across the longer sides on the screen.
      const Patch& patch = screen_.patchOf(part);
      const auto length = [&](int side) {
        const std::vector<dvec3> curve = sideOf(patch, points, side);
        return glm::length(dvec2(curve.back()) / curve.back().z - dvec2(curve.front()) / curve.front().z);
      };
      splitU = length(0) + length(2) >= length(1) + length(3);
    }
    const auto& c = part.corners;
    if (splitU) {
      const dvec2 s = 0.5 * (c[0] + c[1]), n = 0.5 * (c[2] + c[3]);
      push(part, {c[0], s, n, c[3]}), push(part, {s, c[1], c[2], n});
    } else {
      const dvec2 e = 0.5 * (c[1] + c[2]), w = 0.5 * (c[3] + c[0]);
      push(part, {c[0], c[1], e, w}), push(part, {w, e, c[2], c[3]});
    }
  }

  /// A triangle at the sides that are not flat; if all are, at its middle.
  void splitSides(const Part& part, const std::array<bool, 4>& bent) {
    const int many = bent[0] + bent[1] + bent[2];
    if (many == 3) return splitInFour(part);
    if (many == 0) {
      const dvec2 m = (part.corners[0] + part.corners[1] + part.corners[2]) / 3.0;
      for (size_t s = 0; s < 3; ++s) push(part, {part.corners[s], part.corners[(s + 1) % 3], m});
      return;
    }
    // Turned so that side 0 is split, and with two of them side 1 as well.
    size_t turn = 0;
    while (!(bent[turn] && (many == 1 || bent[(turn + 1) % 3]))) ++turn;
    const dvec2 a = part.corners[turn], b = part.corners[(turn + 1) % 3], c = part.corners[(turn + 2) % 3];
    const dvec2 ab = 0.5 * (a + b), bc = 0.5 * (b + c);
    if (many == 1) {
      push(part, {a, ab, c}), push(part, {ab, b, c});
    } else {
      push(part, {ab, b, bc}), push(part, {a, ab, bc}), push(part, {a, bc, c});
    }
  }

  dvec2 onSide(const Part& part, int side, double t) const {
    const auto s = static_cast<size_t>(side), next = static_cast<size_t>((side + 1) % cornersOf(part));
    return (1.0 - t) * part.corners[s] + t * part.corners[next];
  }

  void addCorners(const Part& part) {
    for (int side = 0; side < cornersOf(part); ++side) names_.add(part.patch, onSide(part, side, 0.0));
  }

  /// Splits parts until no neighbour is two levels finer.
  void restrict() {
    for (bool changed = true; changed;) {
      changed = false;
      names_.clear();
      for (const Part& part : flat_) addCorners(part);
      std::vector<Part> parts;
      for (const Part& part : flat_) {
        bool tooCoarse = false;
        for (int side = 0; side < cornersOf(part); ++side)
          for (const double t : {0.25, 0.75}) tooCoarse |= names_.has(part.patch, onSide(part, side, t));
        if (!tooCoarse) {
          parts.push_back(part);
          continue;
        }
        changed = true;
        splitInFour(part);
        parts.insert(parts.end(), stack_.begin(), stack_.end());
        stack_.clear();
      }
      flat_ = std::move(parts);
    }
  }

  uint32_t vertex(uint32_t patch, dvec2 at) {
    const auto [found, fresh] =
        vertices_.try_emplace({patch, at.x, at.y}, static_cast<uint32_t>(out_.positions.size()));
    if (fresh) {
      const Patch& shape = set_.patches[patch];
      const DomainPoint place = domainPoint(shape.domain, at.x, at.y);
      out_.positions.emplace_back(placeOf(patch, at) - out_.anchor);
      out_.normals.emplace_back(normalAt(set_, shape, place).direction);
      out_.parameters.push_back(place);
      out_.patches.push_back(patch);
    }
    return found->second;
  }

  void draw(const Part& part) {
    const int count = cornersOf(part);
    out_.factors[part.patch].fill(1);  // drawn
    std::vector<dvec2> outline;
    for (int side = 0; side < count; ++side) {
      outline.push_back(onSide(part, side, 0.0));
      const dvec2 middle = onSide(part, side, 0.5);
      if (settings_.split == SplitPolicy::Restricted && names_.has(part.patch, middle))
        outline.push_back(middle);
    }
    const auto triangle = [&](dvec2 a, dvec2 b, dvec2 c) {
      out_.triangles.emplace_back(vertex(part.patch, a), vertex(part.patch, b), vertex(part.patch, c));
    };
    const size_t n = outline.size();
    if (count == 4 && n > 4) {
      const dvec2 middle = 0.5 * (part.corners[0] + part.corners[2]);
      for (size_t i = 0; i < n; ++i) triangle(outline[i], outline[(i + 1) % n], middle);
    } else if (count == 4) {
      triangle(outline[0], outline[1], outline[2]), triangle(outline[0], outline[2], outline[3]);
    } else {
      drawRed(outline, part, triangle);
    }
  }

  /// A triangle with middles on some of its sides: no fan, which would have triangles without area.
  template <class Add>
  void drawRed(const std::vector<dvec2>& outline, const Part& part, const Add& add) const {
    const auto& c = part.corners;
    std::array<bool, 3> split{};
    int many = 0;
    for (size_t s = 0, at = 1; s < 3; ++s, ++at)
      if (at < outline.size() && outline[at] == 0.5 * (c[s] + c[(s + 1) % 3])) split[s] = true, ++many, ++at;
    if (many == 0) return add(c[0], c[1], c[2]);
    const auto middle = [&](size_t s) { return 0.5 * (c[s % 3] + c[(s + 1) % 3]); };
    if (many == 3) {
      add(c[0], middle(0), middle(2)), add(middle(0), c[1], middle(1)), add(middle(2), middle(1), c[2]);
      return add(middle(1), middle(2), middle(0));
    }
    size_t turn = 0;
    while (!(split[turn] && (many == 1 || split[(turn + 1) % 3]))) ++turn;
    const dvec2 a = c[turn], b = c[(turn + 1) % 3], d = c[(turn + 2) % 3];
    if (many == 1) return add(a, middle(turn), d), add(middle(turn), b, d);
    add(middle(turn), b, middle(turn + 1)), add(a, middle(turn), middle(turn + 1)),
        add(a, middle(turn + 1), d);
  }

  const PatchSet& set_;
  ScreenPatches screen_;
  RecursionSettings settings_;
  RecursionCounts& counts_;
  std::vector<Part> stack_, flat_;
  VertexNames names_{set_};
  TessellatedSurface out_;
  std::map<std::tuple<uint32_t, double, double>, uint32_t> vertices_;
  std::map<std::tuple<uint32_t, double, double>, dvec3> snapped_;  ///< places on chords
};

}  // namespace

TessellatedSurface refined(const PatchSet& set, const SurfaceView& view, const RecursionSettings& settings,
                           glm::dvec3 anchor, RecursionCounts* counts) {
  RecursionCounts own;
  Refinement refinement(set, view, settings, counts ? *counts : own);
  refinement.run();
  return refinement.surface(view, anchor);
}

}  // namespace limen::surfaces
