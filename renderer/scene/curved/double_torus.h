// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/corner_normals.h"
#include "renderer/surfaces/polygon_mesh.h"

namespace limen::scene {

/// Control mesh of a surface of genus 2: 48 quads, two rings of 5 x 5 that share the four corners of the quad
/// that each of them lacks. Around the y axis, 2 high units across each ring.
surfaces::PolygonMesh doubleTorusCage();

/// 1,536 triangles with their vertices and normals on the Catmull-Clark surface of that mesh: every quad of
/// its second subdivision is split along a diagonal.
surfaces::BaseMesh doubleTorus();

}  // namespace limen::scene
