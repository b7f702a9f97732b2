// SPDX-License-Identifier: BSD-3-Clause
// How fine fields must be for objects of a size in the picture.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/visibility_fields/field_form.h"
#include "renderer/visibility_fields/rigid_objects.h"

namespace limen::techniques {

/// Radius in pixels of the disc whose area is that of the objects' spheres together, as the camera sees them;
/// infinite within one.
double objectsSizePx(const scene::Camera& camera, glm::ivec2 sizePx,
                     const std::vector<visibility_fields::RigidObject>& objects);

/// Bound of the root mean square error, over the whole picture, of what a field says is hidden.
///
/// Rays of a field are up to half its spacing s (fieldSpacing()) beside those that are asked for. Of a
/// receiver at the distance d of an object of radius R, rays within s R / 2 of the outline, at most 2 pi R
/// long, may count either way: a share s R^2 / d^2 of the half space. Squared and summed over a plane around
/// the object from d = R on this is pi s^2 R^2, as if the disc of the object itself erred by s everywhere;
/// the object's own surface, as large in the picture, at most doubles that. With one bit distances are
/// unknown, so that any ray that hits may count as a miss by its falloff: s + 1 in place of s.
double boundBySize(const visibility_fields::FieldForm& form, double objectsSizePx, glm::ivec2 sizePx);

/// Of the forms with at most as many positions, directions and bits as `finest` the one of the fewest bytes
/// whose bound is not above `error`; `finest` if there is none.
visibility_fields::FieldForm formBySize(const visibility_fields::FieldForm& finest, double objectsSizePx,
                                        glm::ivec2 sizePx, double error);

}  // namespace limen::techniques
