// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace limen::scene {

struct Scene;

/// A part that moves as a rigid body: it turns about an axis through a pivot, and travels to and fro.
struct PartMotion {
  uint32_t part = 0;  ///< of Scene::parts; shares no vertex with others
  glm::dvec3 pivot{0.0};
  glm::dvec3 axis{0.0, 1.0, 0.0};  ///< unit
  double turnDegS = 0.0;           ///< counter-clockwise seen from the axis' tip
  glm::dvec3 travel{0.0};          ///< at most this far to both sides of its place, world units
  double periodS = 1.0;            ///< of the travel, > 0
  double startS = 0.0;             ///< its own time when the frame's is 0

  /// World space at rest to world space at a time of the frame: about the pivot by turnDegS t, then by travel
  /// sin(2 pi t / period), t = startS + timeS.
  glm::dmat4 at(double timeS) const;
};

/// For each vertex of Scene::mesh 0 if it rests, or 1 + the number of its motion. Throws std::logic_error if
/// a vertex belongs to several parts that do not all move alike, or a moving part has a pattern, which is one
/// of space.
std::vector<uint32_t> motionsOfVertices(const Scene& scene);

/// The scene as it is at a time, at rest.
Scene movedTo(const Scene& scene, double timeS);

}  // namespace limen::scene
