// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"

namespace limen::scene {

/// A four-legged animal of 11,532 bicubic patches that stands on y = 0 and looks towards +x: closed tubes of
/// uniform B-splines for body, neck, head, ears, legs and tail, which pierce one another, with wrinkles that
/// give the patches something to do. About 1.6 long and 1.3 high.
surfaces::PatchSet herdAnimal();

}  // namespace limen::scene
