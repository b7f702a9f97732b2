// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "experiments/base/enum_names.h"
#include "renderer/surfaces/ray_roots.h"
#include "renderer/surfaces/trim_test.h"

namespace limen::surfaces {

enum class RootFinder { Clipping, Hulls, Intervals };
constexpr EnumNames<RootFinder, 3> enumNames(RootFinder) {
  return {{{{RootFinder::Clipping, "bezier_clipping"},
            {RootFinder::Hulls, "hull_subdivision"},
            {RootFinder::Intervals, "interval_arithmetic"}}}};
}

struct PatchHit {
  double t = 0.0;
  uint32_t patch = 0;
  DomainPoint at;
};

/// First places where rays meet a scene's patches, in double precision. Weights must be positive. Threads may
/// share it.
class PatchTracer {
 public:
  PatchTracer(const PatchSet& set, RootFinder finder);
  /// `trims`: which places are left, in place of the set's own curves.
  PatchTracer(const PatchSet& set, RootFinder finder, TrimTest trims);

  /// `tolerance`: largest distance of the surface from the ray that may count as a hit.
  std::optional<PatchHit> nearest(const Ray& ray, double tolerance, RootCounts* counts = nullptr) const;

 private:
  struct Node {
    glm::dvec3 low{1e300}, high{-1e300};
    uint32_t first = 0, count = 0;  ///< patches of a leaf
    uint32_t right = 0;             ///< the left child follows its parent
  };
  uint32_t build(uint32_t first, uint32_t count);

  const PatchSet& set_;
  RootFinder finder_;
  TrimTest trims_;
  PatchSet rectangles_;  ///< triangles as rectangles, for clipping
  std::vector<Patch> searched_;
  std::vector<glm::dvec3> low_, high_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace limen::surfaces
