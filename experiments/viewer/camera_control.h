// SPDX-License-Identifier: BSD-3-Clause
// How drags and keys move a camera. Pure functions: each returns the moved camera, or the same camera if
// there is nothing to do. `up` never changes, so that the picture never rolls; the view stays at least
// kPoleDeg away from it, so that it never flips. All angles and positions are doubles relative to eye or
// target: far from the origin the only error of a step is the rounding of the coordinates. That adds up over
// steps, so a drag is best applied as a whole to the camera it began with.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/scene.h"

namespace limen::viewer {

/// Smallest angle between the view and the up axis that a drag can reach.
inline constexpr double kPoleDeg = 0.5;
/// Fields of view that zoom() stays within.
inline constexpr double kNarrowestFovDeg = 0.1, kWidestFovDeg = 150.0;
/// Distances of eye and target that dolly() stays within, in scene diagonals.
inline constexpr double kNearestShare = 1e-4, kFarthestShare = 1e4;

/// How far drags, wheel and keys move the camera.
struct ControlSpeeds {
  double orbitRad = 3.141592653589793;  ///< by a drag over the height of the window
  double lookRad = 1.5;                 ///< likewise
  double dollyFactor = 1.1;             ///< of the distance, by one step of the wheel; > 1
  double zoomFactor = 1.1;              ///< of the picture's size, by one step of the wheel; > 1
  double flyShare = 0.25;               ///< of the scene's diagonal in a second
};

/// Moves the eye around the target, which stays, as does their distance. `drag` in heights of the window, x
/// to the right, y down: the scene follows the mouse.
scene::Camera orbit(const scene::Camera& camera, glm::dvec2 drag, const ControlSpeeds& speeds = {});

/// Turns the view about the eye, which stays, as does the target's distance. `drag` as for orbit(): the view
/// follows the mouse.
scene::Camera look(const scene::Camera& camera, glm::dvec2 drag, const ControlSpeeds& speeds = {});

/// Moves eye and target together in the picture plane so that objects at the target's depth follow the mouse;
/// `drag` as for orbit().
scene::Camera pan(const scene::Camera& camera, glm::dvec2 drag);

/// Moves the eye towards the target for positive `steps`, by a factor of their distance per step, so that it
/// never reaches it. `diagonal` of the scene's bounds, world units.
scene::Camera dolly(const scene::Camera& camera, double steps, double diagonal,
                    const ControlSpeeds& speeds = {});

/// Enlarges the picture for positive `steps` by narrowing the field of view; the eye stays.
scene::Camera zoom(const scene::Camera& camera, double steps, const ControlSpeeds& speeds = {});

/// Which ways keys fly, -1 to 1 each: along the view, to its right, along the up axis.
struct FlyKeys {
  double forward = 0.0, right = 0.0, up = 0.0;
};

/// Moves eye and target together for `seconds`. One long step equals many short ones; two keys are no faster
/// than one.
scene::Camera fly(const scene::Camera& camera, const FlyKeys& keys, double seconds, double diagonal,
                  const ControlSpeeds& speeds = {});

/// Looks at the middle of `bounds` from where the camera looks now, so far away that the whole of their
/// bounding sphere is in the picture. `aspect`: width by height, > 0. Empty bounds change nothing.
scene::Camera frameAll(const scene::Camera& camera, const scene::Bounds& bounds, double aspect);

}  // namespace limen::viewer
