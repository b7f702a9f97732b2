// SPDX-License-Identifier: BSD-3-Clause
// What a step and a pixel need to know of each voxel and its neighbours, in one word each. Faces: 2 * axis, + 1 on the low side.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(binding = kLightCellsUnit) uniform usampler2DArray lightCells;

bool besideSurface(uint cell, int face) { return (cell >> (kCellBesideSurface + face) & 1u) != 0u; }
bool besideLight(uint cell, int face) { return (cell >> (kCellBesideLight + face) & 1u) != 0u; }
bool holdsSurface(uint cell) { return (cell >> kCellSurface & 1u) != 0u; }
bool holdsEdge(uint cell) { return (cell >> kCellEdge & 1u) != 0u; }
bool holdsLight(uint cell) { return (cell >> kCellLight & 1u) != 0u; }
