// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"

namespace limen::scene {

/// Newell's teapot as 32 bicubic patches that face outwards, y up, standing on y = 0, the spout towards +x;
/// 3.15 high, in the original units. The body's axis is the y axis. Neighbours are not filled in.
surfaces::PatchSet teapot();

}  // namespace limen::scene
