// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/techniques/reflections/vertex_reflection/star_surface.h"

namespace limen::reflections {

/// How a map stores directions.
enum class MapLayout {
  Cube,    ///< six square faces
  LatLong  ///< one square of azimuth (across) and polar angle from +z (down), as in the thesis
};
constexpr EnumNames<MapLayout, 2> enumNames(MapLayout) {
  return {{{{MapLayout::Cube, "cube"}, {MapLayout::LatLong, "lat_long"}}}};
}

/// A star-shaped surface sampled at the middles of texels (Roger 2008, section 2.2.1, Fig. 2.3).
struct StarMap {
  MapLayout layout = MapLayout::Cube;
  int resolution = 0;                 ///< texels along a side
  std::vector<RadialPoint> texels;    ///< faces in the order of CubePlace, rows within; radii over `unit`
  double unit = 1.0;                  ///< what radii are divided by
  std::vector<uint8_t> present = {};  ///< 0 where filled from neighbours
  double filledShare = 0.0;           ///< texels that the surface does not reach

  int layers() const { return layout == MapLayout::Cube ? 6 : 1; }
};

/// Unit direction of a texel's middle.
glm::dvec3 texelDirection(MapLayout layout, int resolution, int layer, int x, int y);

/// Texels where the surface ends are filled from their neighbours, so that a search may pass over its border.
StarMap bakeStarMap(const StarSurface& surface, MapLayout layout, int resolution, double unit);

}  // namespace limen::reflections
