// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/tessellated_surface.h"
#include "renderer/techniques/ray_casting/view_rays.h"

namespace limen::techniques {

/// What the scan lines of Lane and Carpenter took.
struct ScanLineCounts {
  int64_t splits = 0;      ///< of parts into two
  int64_t polygons = 0;    ///< flat parts
  int64_t mostActive = 0;  ///< parts and polygons that a line had at once, at most
};

/// A picture of patches line by line from the top (Lane, Carpenter, Whitted and Blinn 1980; Schwarz 2009,
/// section 6.5.3): a part waits until the line reaches the box of its projected control points, and is then
/// halved until these lie within `tolerancePx` of the places that a bilinear quad gives them; quads are
/// rasterised as two triangles by pixel centres. A side that is straight to within the tolerance is drawn as
/// its chord by the parts on both sides, so that neighbours of the same control points leave no cracks,
/// wherever they stop (Clark 1979). Triangles are halved as rectangles with a collapsed side. Weights must be positive;
/// what lies nearer than the near plane is left out.
ExactView scanLineView(const surfaces::PatchSet& set, const surfaces::SurfaceView& view, glm::ivec2 sizePx,
                       double tolerancePx, ScanLineCounts& counts);

}  // namespace limen::techniques
