// SPDX-License-Identifier: BSD-3-Clause
// Recursive refinement of patches until each part is flat on the screen, on the CPU in double precision
// (Schwarz 2009, section 7.2; SC-37 to 43, 46).
#pragma once

#include "renderer/surfaces/flatness.h"
#include "renderer/surfaces/tessellated_surface.h"

namespace limen::surfaces {

enum class SplitPolicy {
  Halves,    ///< rectangle: into two, by the sides that are not flat; triangle: at each side that is not flat
  Quarters,  ///< into four
  Mixed,     ///< rectangle: into four if sides of both directions are not flat, otherwise as Halves
  Restricted,  ///< Quarters with neighbours that differ by one level at most: restricted quadtree, red-green
               ///< triangles
  Paths,       ///< at samples of curves across the surface: see path_refinement.h
  CentralDifferences  ///< bicubic rectangles into halves: see central_differences.h
};
constexpr EnumNames<SplitPolicy, 6> enumNames(SplitPolicy) {
  return {{{{SplitPolicy::Halves, "halves"},
            {SplitPolicy::Quarters, "quarters"},
            {SplitPolicy::Mixed, "mixed"},
            {SplitPolicy::Restricted, "restricted"},
            {SplitPolicy::Paths, "paths"},
            {SplitPolicy::CentralDifferences, "central_differences"}}}};
}

/// What becomes of a side that is flat, whatever the part beyond does. T-vertices remain, cracks do not
/// (section 7.2.4; SC-43).
enum class CrackHandling {
  None,
  Snap,  ///< later vertices on it lie on its chord; the surface within stays as it is
  Alter  ///< its control points are put on the chord, and the part with them (Clark 1979)
};
constexpr EnumNames<CrackHandling, 3> enumNames(CrackHandling) {
  return {{{{CrackHandling::None, "none"}, {CrackHandling::Snap, "snap"}, {CrackHandling::Alter, "alter"}}}};
}

struct RecursionSettings {
  Flatness flatness = Flatness::Control;
  SplitPolicy split = SplitPolicy::Halves;
  double tolerancePx = 0.5;
  int mostSteps = 14;
  bool cull = true;  ///< parts outside the view are left out
  CrackHandling cracks = CrackHandling::None;
};

struct RecursionCounts {
  int64_t tests = 0;      ///< parts tested
  int64_t faces = 0;      ///< flat parts: quads, or triangles
  int64_t triangles = 0;  ///< of the surface
  int64_t culled = 0;     ///< parts
  int64_t cutShort = 0;   ///< parts that are drawn although not flat, as mostSteps is reached
  int steps = 0;          ///< from a patch to its smallest part
};

/// The refined surface: positions of vertices relative to `anchor`. Vertices are shared within a patch alone.
TessellatedSurface refined(const PatchSet& set, const SurfaceView& view, const RecursionSettings& settings,
                           glm::dvec3 anchor = glm::dvec3(0.0), RecursionCounts* counts = nullptr);

}  // namespace limen::surfaces
