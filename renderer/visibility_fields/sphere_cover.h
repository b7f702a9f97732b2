// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/visibility_fields/rigid_objects.h"

namespace limen::visibility_fields {

/// An object in pieces with a sphere each, at most `spheres` of them: the piece with the largest sphere is
/// cut in the middle across its longest principal axis, triangles included, again and again. The object as it
/// is where that would not help: where the spheres have a larger volume together than the one around all. So
/// long and hollow objects are cut, round ones are not. Pieces have their object's owner. Source: Gaitatzes
/// 2012, section 4.8 (suggested, not tried; how to cut is the bench's own).
std::vector<RigidObject> coverWithSpheres(const RigidObject& object, int spheres);

}  // namespace limen::visibility_fields
