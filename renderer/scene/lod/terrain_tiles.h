// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/scene/lod/aperture.h"
#include "renderer/scene/lod/height_field.h"
#include "renderer/scene/lod_set.h"

namespace limen::scene {

struct TileSetting {
  int tiles = 8;   ///< per side of the terrain
  int cells = 16;  ///< per side of a tile's finest level; field.side = tiles * cells + 1
  int levels = 4;  ///< level i takes every 2^i-th point: cells is divisible by 2^(levels - 1)
  bool skirts = true;
};

/// A terrain in square tiles whose coarser levels subsample the finest regularly (SP-55; chunked LOD, Schwarz
/// 2009, section 10.3.5), tile by tile in the field's order. Vertices carry the field's normals and
/// apertures.
///
/// deviation and statedError: largest difference of height from the finest level, exact, since both are
/// linear over the cells of the finest. Morph targets: straight up or down to the next level's surface, into
/// which a tile morphs exactly. With skirts, a strip hangs from each border between tiles to below anything
/// that any level of the neighbour may show, so that no pair of levels leaves a gap; the terrain's outer edge
/// has none.
std::vector<LodSet> terrainTiles(const HeightField& field, const std::vector<Aperture>& apertures,
                                 const TileSetting& setting);

}  // namespace limen::scene
