// SPDX-License-Identifier: BSD-3-Clause
// How fine each object's field must be for its size in the picture.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/visibility_fields/field_form.h"
#include "renderer/visibility_fields/visibility_fields.h"

namespace limen::techniques {

/// Radius in pixels of the disc whose area is that of an object's sphere as the camera sees it; infinite
/// within it.
double sizePx(const scene::Camera& camera, glm::ivec2 pictureSizePx, const visibility_fields::Pose& pose);

/// Bound of the root mean square error, over the whole picture, of what an object's field says is hidden.
///
/// Rays of a field are up to half its spacing s (fieldSpacing()) beside those that are asked for. Of a
/// receiver at the distance d of an object of radius R, rays within s R / 2 of the outline, at most 2 pi R
/// long, may count either way: a share s R^2 / d^2 of the half space. Squared and summed over a plane around
/// the object from d = R on this is pi s^2 R^2, as if the disc of the object itself erred by s everywhere;
/// the object's own surface, as large in the picture, at most doubles that. With one bit distances are
/// unknown, so that any ray that hits may count as a miss by its falloff: s + 1 in place of s.
double boundBySize(const visibility_fields::FieldForm& form, double sizePx, glm::ivec2 pictureSizePx);

struct ChosenDetail {
  std::vector<visibility_fields::FieldForm> forms;  ///< of the objects
  double error = 0.0;                               ///< asked for
  double bound = 0.0;  ///< of all together; infinite if the camera is within an object's sphere
  bool kept() const { return bound <= error; }
  size_t formCount() const;  ///< different ones
};

/// A form for each object with at most as many positions, directions and bits as `finest`, so that the bound
/// of all objects together, whose squares add up, is not above `error`. From the coarsest on, the object
/// whose finer form lowers the square most for its bytes gets it. Objects for which there is no bound have
/// the finest. If even the finest of all do not keep to the error, each keeps to an equal share of its
/// square, or has the finest.
ChosenDetail formsBySize(const visibility_fields::FieldForm& finest, const std::vector<double>& sizesPx,
                         glm::ivec2 pictureSizePx, double error);

/// What was chosen for whom, and whether the error could be kept.
std::vector<std::string> detailRemarks(const ChosenDetail& detail, const std::vector<std::string>& names);

}  // namespace limen::techniques
