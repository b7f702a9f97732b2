// SPDX-License-Identifier: BSD-3-Clause
// How drags and keys move a camera. Pure functions: each gives the moved camera, and the camera itself if
// there is nothing to move by. `up` never changes, so that the picture never rolls; the view comes no nearer
// to it than kPoleDeg, so that it never flips. All angles and positions are doubles relative to eye or
// target: far from the origin a step is wrong by the rounding of the coordinates alone. That rounding adds up
// over steps, so a drag is best applied as a whole to the camera that it began with.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/scene.h"

namespace limen::viewer {

/// Smallest angle between the view and the up axis that a drag leads to.
inline constexpr double kPoleDeg = 0.5;
/// Fields of view that zoom() keeps to.
inline constexpr double kNarrowestFovDeg = 0.1, kWidestFovDeg = 150.0;
/// Distances of eye and target that dolly() keeps to, in diagonals of the scene.
inline constexpr double kNearestShare = 1e-4, kFarthestShare = 1e4;

/// How far drags, wheels and keys go.
struct ControlSpeeds {
  double orbitRad = 3.141592653589793;  ///< by a drag as long as the window is high
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

/// Moves eye and target alike within the picture's plane so that what lies at the target's depth follows the
/// mouse; `drag` as for orbit().
scene::Camera pan(const scene::Camera& camera, glm::dvec2 drag);

/// Moves the eye towards the target for positive `steps`, by a factor of their distance for each: it never
/// reaches it. `diagonal` of the scene's bounds, world units.
scene::Camera dolly(const scene::Camera& camera, double steps, double diagonal,
                    const ControlSpeeds& speeds = {});

/// Enlarges the picture for positive `steps` by a narrower field of view; the eye stays.
scene::Camera zoom(const scene::Camera& camera, double steps, const ControlSpeeds& speeds = {});

/// Which ways keys fly, -1 to 1 each: along the view, to its right, along the up axis.
struct FlyKeys {
  double forward = 0.0, right = 0.0, up = 0.0;
};

/// Moves eye and target alike for `seconds`. The same in one long step or many short ones; two keys are no
/// faster than one.
scene::Camera fly(const scene::Camera& camera, const FlyKeys& keys, double seconds, double diagonal,
                  const ControlSpeeds& speeds = {});

/// Looks at the middle of `bounds` from where the camera looks now, so far away that all of their bounding
/// sphere is in the picture. `aspect`: width by height, > 0. Empty bounds change nothing.
scene::Camera frameAll(const scene::Camera& camera, const scene::Bounds& bounds, double aspect);

}  // namespace limen::viewer
