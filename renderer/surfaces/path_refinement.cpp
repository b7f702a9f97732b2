// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/path_refinement.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/refined_parts.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec3;

using Samples = std::vector<dvec2>;

/// A triangle of the domain; side i runs from corner i to the next one, with its samples in that order.
struct Cell {
  uint32_t patch = 0;
  int steps = 0;
  std::array<dvec2, 3> corners;
  std::array<Samples, 3> samples;
};

class PathRefinement : ScreenRefinement {
 public:
  using ScreenRefinement::ScreenRefinement;

  TessellatedSurface run() {
    for (uint32_t i = 0; i < set_.patches.size(); ++i) addPatch(i);
    while (!stack_.empty()) {
      Cell cell = std::move(stack_.back());
      stack_.pop_back();
      visit(cell);
    }
    TessellatedSurface out = vertices_.take();
    counts_.faces = counts_.triangles = static_cast<int64_t>(out.triangles.size());
    return out;
  }

 private:
  void addPatch(uint32_t i) {
    const Patch& patch = set_.patches[i];
    const bool triangle = patch.domain == Domain::Triangle;
    std::array<dvec3, kMostPoints> storage;
    Part whole{i, 0, {dvec2{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}, {}};
    if (triangle) whole.corners = {dvec2{1, 0}, {0, 1}, {0, 0}, {}};
    if (settings_.cull && screen_.isOutside(screen_.pointsOf(whole, storage))) {
      ++counts_.culled;
      return;
    }
    const auto& c = whole.corners;
    if (triangle) {
      stack_.push_back({i,
                        0,
                        {c[0], c[1], c[2]},
                        {samples(i, c[0], c[1]), samples(i, c[1], c[2]), samples(i, c[2], c[0])}});
      return;
    }
    Samples diagonal = samples(i, c[2], c[0]);
    stack_.push_back({i, 0, {c[0], c[1], c[2]}, {samples(i, c[0], c[1]), samples(i, c[1], c[2]), diagonal}});
    std::reverse(diagonal.begin(), diagonal.end());
    stack_.push_back({i, 0, {c[0], c[2], c[3]}, {diagonal, samples(i, c[2], c[3]), samples(i, c[3], c[0])}});
  }

  /// In pixels; none behind the near plane.
  std::optional<dvec2> onScreen(uint32_t patch, dvec2 at) const {
    const Patch& shape = set_.patches[patch];
    const dvec3 p = evaluate(set_, shape, domainPoint(shape.domain, at.x, at.y), Order::Position).p;
    const dvec3 q = screen_.onScreen(glm::dvec4(p, 1.0));
    if (q.z < view_.nearest) return std::nullopt;
    return dvec2(q) / q.z;
  }

  Samples samples(uint32_t patch, dvec2 from, dvec2 to, int depth = 0) {
    // The same from both ends, bit by bit.
    const bool turned = to.x < from.x || (to.x == from.x && to.y < from.y);
    Samples out;
    sample(patch, turned ? to : from, turned ? from : to, depth, out);
    if (turned) std::reverse(out.begin(), out.end());
    return out;
  }

  void sample(uint32_t patch, dvec2 from, dvec2 to, int depth, Samples& out) {
    ++counts_.tests;
    if (isFlat(patch, from, to)) return;
    if (depth >= settings_.mostSteps) {
      ++counts_.cutShort;
      return;
    }
    const dvec2 middle = 0.5 * (from + to);
    sample(patch, from, middle, depth + 1, out);
    out.push_back(middle);
    sample(patch, middle, to, depth + 1, out);
  }

  bool isFlat(uint32_t patch, dvec2 from, dvec2 to) const {
    const std::optional<dvec2> a = onScreen(patch, from), b = onScreen(patch, to);
    if (!a || !b) return !a && !b;
    const dvec2 chord = *b - *a;
    const double squared = glm::dot(chord, chord);
    for (const double t : {0.25, 0.5, 0.75}) {
      const std::optional<dvec2> p = onScreen(patch, glm::mix(from, to, t));
      if (!p) return false;
      const double along = squared > 0.0 ? std::clamp(glm::dot(*p - *a, chord) / squared, 0.0, 1.0) : 0.0;
      if (glm::length(*p - *a - along * chord) > settings_.tolerancePx) return false;
    }
    return true;
  }

  void visit(const Cell& cell) {
    size_t side = 0;
    for (size_t s = 1; s < 3; ++s)
      if (cell.samples[s].size() > cell.samples[side].size()) side = s;
    const Samples& most = cell.samples[side];
    counts_.steps = std::max(counts_.steps, cell.steps);
    if (most.empty()) {
      const auto vertex = [&](size_t c) { return vertices_.add(cell.patch, cell.corners[c]); };
      vertices_.addTriangle(cell.patch, {vertex(0), vertex(1), vertex(2)});
      return;
    }
    const size_t next = (side + 1) % 3, last = (side + 2) % 3, at = most.size() / 2;
    const dvec2 middle = most[at], opposite = cell.corners[last];
    const auto cut = static_cast<ptrdiff_t>(at);
    // Two splits of cells take the place of one of curves: at last new curves get no samples, and those that
    // are left are used up.
    const Samples across = samples(cell.patch, middle, opposite, (cell.steps + 1) / 2);
    Cell first{cell.patch,
               cell.steps + 1,
               {cell.corners[side], middle, opposite},
               {Samples(most.begin(), most.begin() + cut), across, cell.samples[last]}};
    Cell second{cell.patch,
                cell.steps + 1,
                {middle, cell.corners[next], opposite},
                {Samples(most.begin() + cut + 1, most.end()), cell.samples[next], across}};
    std::reverse(second.samples[2].begin(), second.samples[2].end());
    stack_.push_back(std::move(first));
    stack_.push_back(std::move(second));
  }

  std::vector<Cell> stack_;
};

}  // namespace

TessellatedSurface refinedAlongPaths(const PatchSet& set, const SurfaceView& view,
                                     const RecursionSettings& settings, dvec3 anchor,
                                     RecursionCounts& counts) {
  return PathRefinement(set, view, settings, anchor, counts).run();
}

}  // namespace limen::surfaces
