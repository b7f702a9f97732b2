// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/references/triangles.h"

namespace limen::references {

/// A point whose visibility is requested.
struct ReceiverPoint {
  uint32_t pixel = 0;     ///< row * width + column
  uint32_t triangle = 0;  ///< on which it lies
  glm::dvec3 position;    ///< relative to the anchor
  glm::dvec3 normal;      ///< unit, of the triangle, on the camera's side
};

/// Reads back what the GPU found at each pixel (frame::TriangleIds, Position and Receivers): references
/// evaluate exactly the points that techniques shade. Positions are then projected onto the plane of their
/// triangle in double precision, so that the float error of the position cannot place a point beneath its own
/// surface. Waits for the GPU. Call outside passes.
std::vector<ReceiverPoint> readReceiverPoints(frame::Frame& frame, const Triangles& triangles);

}  // namespace limen::references
