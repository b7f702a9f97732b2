// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/scene/scene.h"
#include "renderer/surfaces/normal.h"

namespace limen::scene {

/// Uniform tessellation of every patch: `factor` segments along each side, two triangles a cell. Patches
/// share no vertices, but positions along common boundaries are bitwise the same. Unit normals; triangles
/// with two corners in one place, as along collapsed sides, are left out, and those of trimmed patches end
/// where their edges meet the curves. `histogram`, if given, counts the
/// vertices by where their normals came from.
Mesh patchMesh(const surfaces::PatchSet& set, int factor, surfaces::NormalHistogram* histogram = nullptr);

/// Adds a part made of patches: to Scene::surfaces and, tessellated as at time 0, to Scene::mesh. Neighbours
/// of the set are found.
void addSurface(Scene& scene, const std::string& name, surfaces::PatchSet set, int factor, glm::vec3 albedo);

}  // namespace limen::scene
