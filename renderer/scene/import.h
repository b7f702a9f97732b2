// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::scene {

struct ImportedMesh {
  Mesh mesh;
  std::vector<Part> parts;  ///< one for each mesh of the file's node graph, tiling the triangles in order
  std::vector<Material> materials;
};

/// Reads a mesh of any format that Assimp knows (OBJ, PLY, glTF, 3DS ...). Polygons become triangles, the
/// transforms of the node graph are applied, vertices at exactly the same position are merged, diffuse
/// colours become albedos (textures are ignored). Degenerate triangles are kept; points and lines are not
/// surfaces and are ignored. Throws Error naming the file: missing, unreadable, no triangles, a coordinate
/// that is not finite, a vertex index out of range.
ImportedMesh importMesh(const std::string& path);

/// Path of a mesh from the package glmark2-data. Throws Error if it is not installed.
std::string installedModel(const std::string& file);

/// Makes z-up coordinates y-up.
void turnZUpToYUp(Mesh& mesh);

/// Moves the mesh so that its box stands on y = 0 with its middle on the y axis, and scales it to the given
/// height. A height of 0 keeps the size.
void standOnGround(Mesh& mesh, double height);

/// Appends the imported parts and materials to the scene as casters.
void addImported(Scene& scene, const ImportedMesh& imported);

}  // namespace limen::scene
