// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <variant>

#include "renderer/scene/scene.h"

namespace limen::scene {

struct ObjectsAtRest {
  static constexpr const char *kKind = "rest", *kSummary = "nothing moves";
};
struct ObjectsInMotion {
  static constexpr const char *kKind = "moving",
                              *kSummary = "objects turn and travel to and fro, each as a rigid body";
  double timeS = 0.0, speed = 1.0;
  static const SettingsTable<ObjectsInMotion>& table();
};
/// Whether a scene's objects move. At time 0 they are where they rest.
using ObjectMotion = std::variant<ObjectsAtRest, ObjectsInMotion>;
inline constexpr const char* kMotionText = "Whether objects move while frames pass";

/// Makes the part added last move, if objects do. `motion`: its own but for the part, and for `startS`,
/// `turnDegS` and `periodS` at other speeds than 1.
void moveLastPart(Scene& scene, const ObjectMotion& choice, PartMotion motion);

/// A nearly black surface that reflects this share of the light, all channels alike; `glossRad` as in
/// Material.
Material mirrorMaterial(double reflectance, double glossRad = 0.0);

/// The ground of stage.h with a checkered pattern, in squares of this size.
void addCheckeredGround(Scene& scene, double size, double square);

/// Ellipsoid around `centre` with exact normals: 8 cells^2 triangles.
Mesh ellipsoid(glm::dvec3 centre, glm::dvec3 semiAxes, int cells);

/// Surface of revolution about the vertical axis through `base`: `profile` from bottom to top, (radius,
/// height above base), the outside to the right of its way. Its normals are those of the vertices'
/// surroundings, except that a corner given twice stays sharp. A radius of 0 at an end closes it.
Mesh lathe(glm::dvec3 base, std::span<const glm::dvec2> profile, int segments);

/// A height field over a square of the xz plane around `centre`: cells x cells squares, y = centre.y +
/// height(x, z) with x, z relative to centre, normals from the gradient (dh/dx, dh/dz) that `slope` gives.
Mesh heightSheet(glm::dvec3 centre, double size, int cells,
                 const std::function<double(double, double)>& height,
                 const std::function<glm::dvec2(double, double)>& slope);

/// A standing figure of ellipsoids with smooth normals, 1 high, feet around (0, 0, 0), facing +z: 9 * 8
/// cells^2 triangles; with 20 cells 28,800.
Mesh statue(int cells);

/// Scaled, turned about the y axis, then moved.
Mesh movedMesh(Mesh mesh, double scale, double turnDeg, glm::dvec3 to);

/// A camera that moves from one view to another in `seconds`.
void setMovingCamera(Scene& scene, const Camera& from, const Camera& to, double seconds);

}  // namespace limen::scene
