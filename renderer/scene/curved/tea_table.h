// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"

namespace limen::scene {

/// A round table, 1 high, laid for four: teapot, cups on saucers, a sugar bowl, a plate and two balls. 332
/// bicubic rational patches: 83 bands of four around an axis, raised to degree 3.
surfaces::PatchSet teaTable();

}  // namespace limen::scene
