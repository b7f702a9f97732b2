// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/central_differences.h"

#include <algorithm>

#include "experiments/base/error.h"
#include "renderer/surfaces/refined_parts.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using Record = CentralRecord<dvec4>;

/// Corners counter-clockwise from (0, 0).
struct CentralPart {
  uint32_t patch = 0;
  int steps = 0;
  dvec2 low{0.0}, high{1.0};
  std::array<Record, 4> corners;
};

class CentralRefinement : ScreenRefinement {
 public:
  using ScreenRefinement::ScreenRefinement;

  TessellatedSurface run() {
    for (uint32_t i = 0; i < set_.patches.size(); ++i) {
      const Patch& patch = set_.patches[i];
      if (patch.domain != Domain::Rectangle || patch.degreeU != 3 || patch.degreeV != 3)
        throw Error("the scene has patches that are not bicubic", "split",
                    "other ways to split take patches of any degree");
      std::array<dvec3, kMostPoints> storage;
      if (settings_.cull && screen_.isOutside(screen_.pointsOf(
                                {i, 0, {dvec2{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}, {}}, storage))) {
        ++counts_.culled;
        continue;
      }
      stack_.push_back(wholeOf(i));
    }
    while (!stack_.empty()) {
      const CentralPart part = stack_.back();
      stack_.pop_back();
      visit(part);
    }
    TessellatedSurface out = vertices_.take();
    counts_.triangles = static_cast<int64_t>(out.triangles.size());
    return out;
  }

 private:
  CentralPart wholeOf(uint32_t number) const {
    const dvec4* b = set_.points.data() + set_.patches[number].firstPoint;
    const auto at = [&](int i, int j) { return b[i + 4 * j]; };
    CentralPart out;
    out.patch = number;
    for (int c = 0; c < 4; ++c) {
      // At an end of a cubic the second derivative is six times the difference of the next control points.
      const int i = c == 1 || c == 2 ? 3 : 0, j = c >= 2 ? 3 : 0, di = i ? -1 : 1, dj = j ? -1 : 1;
      const auto alongU = [&](int row) {
        return 6.0 * (at(i, row) - 2.0 * at(i + di, row) + at(i + 2 * di, row));
      };
      out.corners[static_cast<size_t>(c)] = {at(i, j), alongU(j),
                                             6.0 * (at(i, j) - 2.0 * at(i, j + dj) + at(i, j + 2 * dj)),
                                             6.0 * (alongU(j) - 2.0 * alongU(j + dj) + alongU(j + 2 * dj))};
    }
    return out;
  }

  /// Deviation from a chord that a second difference may cause, in pixels.
  double deviation(const Record& corner, const dvec4& second) const {
    const dvec3 p = dvec3(corner.p) / corner.p.w;
    const double depth = std::max(glm::dot(p - view_.eye, view_.forward), view_.nearest);
    return glm::length((dvec3(second) - second.w * p) / corner.p.w) / 8.0 * view_.pxAtDistance / depth;
  }

  void visit(const CentralPart& part) {
    ++counts_.tests;
    double alongU = 0.0, alongV = 0.0;
    for (const Record& corner : part.corners) {
      alongU = std::max(alongU, deviation(corner, corner.uu));
      alongV = std::max(alongV, deviation(corner, corner.vv));
    }
    const double tolerance = settings_.tolerancePx;
    if (std::max(alongU, alongV) <= tolerance || part.steps >= settings_.mostSteps) {
      counts_.cutShort += std::max(alongU, alongV) > tolerance;
      draw(part);
      return;
    }
    const auto& c = part.corners;
    const dvec2 middle = 0.5 * (part.low + part.high);
    CentralPart first = part, second = part;
    first.steps = second.steps = part.steps + 1;
    if (alongU > tolerance) {
      const Record s = halvedAlongU(middleAlongU(c[0], c[1])), n = halvedAlongU(middleAlongU(c[3], c[2]));
      first.corners = {halvedAlongU(c[0]), s, n, halvedAlongU(c[3])};
      second.corners = {s, halvedAlongU(c[1]), halvedAlongU(c[2]), n};
      first.high.x = second.low.x = middle.x;
    } else {
      const Record w = halvedAlongV(middleAlongV(c[0], c[3])), e = halvedAlongV(middleAlongV(c[1], c[2]));
      first.corners = {halvedAlongV(c[0]), halvedAlongV(c[1]), e, w};
      second.corners = {w, e, halvedAlongV(c[2]), halvedAlongV(c[3])};
      first.high.y = second.low.y = middle.y;
    }
    stack_.push_back(first);
    stack_.push_back(second);
  }

  void draw(const CentralPart& part) {
    ++counts_.faces;
    counts_.steps = std::max(counts_.steps, part.steps);
    const std::array<dvec2, 4> places = {
        part.low, {part.high.x, part.low.y}, part.high, {part.low.x, part.high.y}};
    std::array<uint32_t, 4> v;
    for (size_t c = 0; c < 4; ++c)
      v[c] = vertices_.add(part.patch, places[c], dvec3(part.corners[c].p) / part.corners[c].p.w);
    vertices_.addTriangle(part.patch, {v[0], v[1], v[2]});
    vertices_.addTriangle(part.patch, {v[0], v[2], v[3]});
  }

  std::vector<CentralPart> stack_;
};

}  // namespace

TessellatedSurface refinedByCentralDifferences(const PatchSet& set, const SurfaceView& view,
                                               const RecursionSettings& settings, dvec3 anchor,
                                               RecursionCounts& counts) {
  return CentralRefinement(set, view, settings, anchor, counts).run();
}

}  // namespace limen::surfaces
