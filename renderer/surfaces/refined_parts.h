// SPDX-License-Identifier: BSD-3-Clause
// What the ways of recursive refinement share: parts of domains, and patches on the screen.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <tuple>

#include "renderer/surfaces/blossom.h"
#include "renderer/surfaces/recursion.h"
#include "renderer/surfaces/tessellated_surface.h"

namespace limen::surfaces {

/// A part of a patch's domain: counter-clockwise corners, 3 of a triangle and 4 of a rectangle. Coordinates
/// of the whole; of a triangle (u, v) with w the rest.
struct Part {
  uint32_t patch = 0;
  int steps = 0;
  std::array<glm::dvec2, 4> corners{};
  std::array<bool, 4> straight{};  ///< sides that are replaced by their chord, or part of it
  /// Control points of the part where a side was altered; otherwise they are the patch's.
  std::shared_ptr<const std::vector<glm::dvec4>> altered;
};

/// Patches on the screen: homogeneous control points in pixels from the picture's middle.
class ScreenPatches {
 public:
  ScreenPatches(const PatchSet& set, const SurfaceView& view);
  const Patch& patchOf(const Part& part) const { return set_.patches[part.patch]; }
  std::span<const glm::dvec3> pointsOf(const Part& part, std::array<glm::dvec3, kMostPoints>& out) const;
  /// Of a homogeneous point in the world.
  glm::dvec3 onScreen(const glm::dvec4& p) const;
  bool isBehind(std::span<const glm::dvec3> points) const;
  /// All to one side of the view's pyramid, or before the near plane.
  bool isOutside(std::span<const glm::dvec3> points) const;

 private:
  const PatchSet& set_;
  const SurfaceView& view_;
  std::vector<glm::dvec3> points_;
};

/// Places of a side's control points among those of the patch, in the side's direction.
std::vector<size_t> sidePlaces(const Patch& patch, int side);
std::vector<glm::dvec3> sideOf(const Patch& patch, std::span<const glm::dvec3> points, int side);

/// Which vertices there are, by a name that is the same for both patches along a common side.
class VertexNames {
 public:
  explicit VertexNames(const PatchSet& set) : set_(set) {}

  using Name = std::tuple<uint32_t, int, double, double>;
  Name nameOf(uint32_t patch, glm::dvec2 at) const {
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
  void add(uint32_t patch, glm::dvec2 at) { names_.insert(nameOf(patch, at)); }
  bool has(uint32_t patch, glm::dvec2 at) const { return names_.contains(nameOf(patch, at)); }
  void clear() { names_.clear(); }

 private:
  /// Place on a side in its direction; -1 off it.
  static double along(Domain domain, int side, glm::dvec2 at) {
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

/// Vertices as they come, once for each place on a patch.
class SurfaceVertices {
 public:
  SurfaceVertices(const PatchSet& set, const SurfaceView& view, glm::dvec3 anchor);
  /// `place`: in the world.
  uint32_t add(uint32_t patch, glm::dvec2 at, const glm::dvec3& place);
  /// On the surface.
  uint32_t add(uint32_t patch, glm::dvec2 at);
  void addTriangle(uint32_t patch, glm::uvec3 corners);
  TessellatedSurface take() { return std::move(out_); }

 private:
  const PatchSet& set_;
  TessellatedSurface out_;
  std::map<std::tuple<uint32_t, double, double>, uint32_t> vertices_;
};

/// What refinements of patches on the screen work with.
class ScreenRefinement {
 public:
  ScreenRefinement(const PatchSet& set, const SurfaceView& view, const RecursionSettings& settings,
                   glm::dvec3 anchor, RecursionCounts& counts)
      : set_(set),
        screen_(set, view),
        view_(view),
        settings_(settings),
        counts_(counts),
        vertices_(set, view, anchor) {}

 protected:
  const PatchSet& set_;
  ScreenPatches screen_;
  const SurfaceView& view_;
  const RecursionSettings& settings_;
  RecursionCounts& counts_;
  SurfaceVertices vertices_;
};

}  // namespace limen::surfaces
