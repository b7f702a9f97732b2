// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/recursion.h"

#include <algorithm>
#include <cmath>

#include "renderer/surfaces/central_differences.h"
#include "renderer/surfaces/path_refinement.h"
#include "renderer/surfaces/refined_parts.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec3;

class Refinement {
 public:
  Refinement(const PatchSet& set, const SurfaceView& view, const RecursionSettings& settings, dvec3 anchor,
             RecursionCounts& counts)
      : set_(set), screen_(set, view), settings_(settings), counts_(counts), vertices_(set, view, anchor) {}

  void run() {
    for (uint32_t i = 0; i < set_.patches.size(); ++i) {
      const bool triangle = set_.patches[i].domain == Domain::Triangle;
      Part whole{i, 0, {dvec2{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}, {}};
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

  TessellatedSurface surface() {
    names_.clear();
    if (settings_.split == SplitPolicy::Restricted)
      for (const Part& part : flat_) addCorners(part);
    for (const Part& part : flat_) draw(part);
    TessellatedSurface out = vertices_.take();
    counts_.triangles = static_cast<int64_t>(out.triangles.size());
    return out;
  }

 private:
  int cornersOf(const Part& part) const { return sidesOf(set_.patches[part.patch].domain); }

  void push(const Part& parent, std::initializer_list<dvec2> corners) {
    Part part{parent.patch, parent.steps + 1, {}, {}, {}};
    std::copy(corners.begin(), corners.end(), part.corners.begin());
    if (parent.altered) {
      addAlteredCorners(parent);  // ends of chords
      part.altered = alteredPart(parent, part);
    }
    if (settings_.cracks != CrackHandling::None) inheritChords(parent, part);
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

  /// Puts the side's control points on its chord (Clark 1979). The part's interior moves along.
  void alter(Part& part, int side) const {
    const Patch& patch = set_.patches[part.patch];
    auto points = std::make_shared<std::vector<glm::dvec4>>(pointsOf(part));
    const std::vector<size_t> places = sidePlaces(patch, side);
    const glm::dvec4 from = (*points)[places.front()], to = (*points)[places.back()];
    for (size_t i = 1; i + 1 < places.size(); ++i) {
      const double t = double(i) / double(places.size() - 1);
      // Of the chord between the ends without their weights, so that its middle is that of snapped vertices.
      (*points)[places[i]] =
          glm::dvec4(glm::mix(dvec3(from) / from.w, dvec3(to) / to.w, t), 1.0) * (*points)[places[i]].w;
    }
    part.altered = points;
  }

  std::vector<glm::dvec4> pointsOf(const Part& part) const {
    if (part.altered) return *part.altered;
    Part whole = part;
    const Patch& patch = set_.patches[part.patch];
    whole.corners = {dvec2{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (patch.domain == Domain::Triangle) whole.corners = {dvec2{1, 0}, {0, 1}, {0, 0}, {}};
    const glm::dvec4* from = set_.points.data() + patch.firstPoint;
    return partOf(whole, {from, from + patch.points()}, part);
  }

  std::shared_ptr<const std::vector<glm::dvec4>> alteredPart(const Part& parent, const Part& part) const {
    return std::make_shared<std::vector<glm::dvec4>>(partOf(parent, *parent.altered, part));
  }

  /// Control points of a part within one whose control points these are.
  std::vector<glm::dvec4> partOf(const Part& outer, const std::vector<glm::dvec4>& points,
                                 const Part& part) const {
    const Patch& patch = set_.patches[part.patch];
    std::vector<glm::dvec4> out(points.size());
    if (patch.domain == Domain::Rectangle) {
      const dvec2 low = outer.corners[0], extent = outer.corners[2] - low;
      rectanglePart(patch.degreeU, patch.degreeV, points.data(),
                    {(part.corners[0] - low) / extent, (part.corners[2] - low) / extent}, out.data());
      return out;
    }
    const dvec2 a = outer.corners[0] - outer.corners[2], b = outer.corners[1] - outer.corners[2];
    const double det = a.x * b.y - a.y * b.x;
    TrianglePart inner;
    for (size_t c = 0; c < 3; ++c) {
      const dvec2 p = part.corners[c] - outer.corners[2];
      const double u = (p.x * b.y - p.y * b.x) / det, v = (a.x * p.y - a.y * p.x) / det;
      inner[c] = {u, v, 1.0 - u - v};
    }
    trianglePart(patch.degreeU, points.data(), inner, out.data());
    return out;
  }

  /// Corners of altered parts lie where their own control points are, if no chord has them already.
  void addAlteredCorners(const Part& part) {
    const Patch& patch = set_.patches[part.patch];
    for (int side = 0; side < cornersOf(part); ++side) {
      const dvec2 at = onSide(part, side, 0.0);
      const glm::dvec4 p = (*part.altered)[sidePlaces(patch, side).front()];
      snapped_.try_emplace({part.patch, at.x, at.y}, dvec3(p) / p.w);
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
    for (size_t side = 0; side < static_cast<size_t>(sides) && settings_.cracks != CrackHandling::None;
         ++side) {
      if (settings_.cracks == CrackHandling::Alter && !bent[side] && !part.straight[side])
        alter(part, static_cast<int>(side));
      part.straight[side] |= !bent[side];
      bent[side] &= !part.straight[side];
    }
    const bool any = inside || std::any_of(bent.begin(), bent.begin() + sides, [](bool one) { return one; });
    if (!any || part.steps >= settings_.mostSteps) {
      counts_.cutShort += any;
      if (part.altered) addAlteredCorners(part);
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

  void draw(const Part& part) {
    const int count = cornersOf(part);
    std::vector<dvec2> outline;
    for (int side = 0; side < count; ++side) {
      outline.push_back(onSide(part, side, 0.0));
      const dvec2 middle = onSide(part, side, 0.5);
      if (settings_.split == SplitPolicy::Restricted && names_.has(part.patch, middle))
        outline.push_back(middle);
    }
    const auto triangle = [&](dvec2 a, dvec2 b, dvec2 c) {
      const auto vertex = [&](dvec2 at) { return vertices_.add(part.patch, at, placeOf(part.patch, at)); };
      vertices_.addTriangle(part.patch, {vertex(a), vertex(b), vertex(c)});
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
  SurfaceVertices vertices_;
  std::map<std::tuple<uint32_t, double, double>, dvec3> snapped_;  ///< places on chords
};

}  // namespace

TessellatedSurface refined(const PatchSet& set, const SurfaceView& view, const RecursionSettings& settings,
                           glm::dvec3 anchor, RecursionCounts* counts) {
  RecursionCounts own;
  RecursionCounts& used = counts ? *counts : own;
  if (settings.split == SplitPolicy::Paths) return refinedAlongPaths(set, view, settings, anchor, used);
  if (settings.split == SplitPolicy::CentralDifferences)
    return refinedByCentralDifferences(set, view, settings, anchor, used);
  Refinement refinement(set, view, settings, anchor, used);
  refinement.run();
  return refinement.surface();
}

}  // namespace limen::surfaces
