// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

/// The same surfaces with rectangles of at least the given degrees, which are at most kMaxDegree; triangles
/// stay. Sides that had the same control points still do, bit by bit.
PatchSet elevated(const PatchSet& set, int degreeU, int degreeV);

/// SC-06 (Schwarz 2009, section 6.1.2). Rectangle of the triangle's degree whose side v = 1 is collapsed to
/// the triangle's corner v = 1: its point (x, y) is the triangle's u = x (1 - y), v = y. Normal fields are
/// lost. The patch must be a triangle.
Patch triangleAsRectangle(const PatchSet& set, const Patch& patch, PatchSet& out);

/// The two triangles of degree m + n <= kMaxDegree of an m x n rectangle on either side of the diagonal from
/// (0, 0) to (1, 1), with corners (0,0), (1,0), (1,1) and (0,0), (1,1), (0,1) in the order u, v, w = 1.
std::array<Patch, 2> rectangleAsTriangles(const PatchSet& set, const Patch& patch, PatchSet& out);

}  // namespace limen::surfaces
