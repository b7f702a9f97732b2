// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/tessellated_surface.h"

namespace limen::surfaces {

/// Mean, 99th percentile (nearest rank) and largest of some values; 0 of none.
struct Spread {
  double mean = 0.0, p99 = 0.0, most = 0.0;
};

struct DeviationSettings {
  int steps = 8;             ///< of the barycentric grid on each triangle: (steps + 1) (steps + 2) / 2 points
  int64_t samples = 200000;  ///< at most about so many: of more, triangles at regular intervals are taken
};

/// Distances between a tessellation and the surface that it stands for, in double precision.
struct Deviation {
  Spread atParameters;  ///< to the surface's point at equal parameters; world units
  Spread closest;       ///< from points of the triangles to the closest point of their patch found from there
  Spread
      atParametersPx;  ///< size of the same distances, as seen across the view at the surface's point's depth
  Spread closestPx;    ///< (never nearer than the near plane); of samples in the view alone
  int64_t samples = 0, samplesInView = 0;
};
Deviation deviationOf(const PatchSet& set, const TessellatedSurface& tessellation,
                      const DeviationSettings& settings = {});

/// Which normals of a patch vertices are compared with.
enum class NormalsOf {
  Field,    ///< those that it is shaded with: its own normal field, if it has one
  Geometry  ///< those of its derivatives
};
/// Angles [degree] between vertex normals and those of the surface; of vertices where it has one.
Spread normalErrors(const PatchSet& set, const TessellatedSurface& tessellation,
                    NormalsOf of = NormalsOf::Field);

/// What would let the background through, or draw a place twice. Of patches that were drawn.
struct Cracks {
  int64_t sides = 0;            ///< common sides that were compared
  int64_t unequalVertices = 0;  ///< vertices on both sides whose positions differ in any bit
  int64_t loneVertices = 0;     ///< T-vertices: those on one of the two sides alone
  int64_t openEdges = 0;        ///< triangle edges inside a patch with no triangle beyond
  int64_t openSides = 0;  ///< without a patch that has all of the side: boundaries, and sides shared in part
  int64_t foldOvers = 0;  ///< triangles that are turned over or without area in the domain
};
Cracks cracksOf(const PatchSet& set, const TessellatedSurface& tessellation);

}  // namespace limen::surfaces
