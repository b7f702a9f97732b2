// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::scene {

struct ImportedMesh {
  Mesh mesh;
  std::vector<Part> parts;  ///< one for each mesh of the file's node graph, tiling the triangles in order
  std::vector<Material> materials;
};

/// Endings of the formats that are imported: OBJ, PLY, glTF, OFF, STL, 3DS and COLLADA.
inline constexpr std::array<const char*, 8> kMeshExtensions = {".obj", ".ply", ".gltf", ".glb",
                                                               ".off", ".stl", ".3ds",  ".dae"};

/// Resources that an import may use. Files come from anywhere, and a few bytes can ask for anything.
struct ImportLimits {
  double memoryMiB = 1024.0;    ///< plus memoryPerByte
  double memoryPerByte = 40.0;  ///< for each byte of the files that are read
  double seconds = 60.0;        ///< CPU time, plus secondsPerMiB
  double secondsPerMiB = 1.0;   ///< for each MiB of the file
  double patience = 4.0;        ///< wall-clock limit as a multiple of the CPU limit
};

/// Reads a mesh in one of the formats above. Polygons become triangles, the transforms of the node graph are
/// applied, vertices at exactly the same position are merged, diffuse colours become albedos (textures are
/// ignored). Degenerate triangles are kept; polygons with fewer than three distinct corners, points and lines
/// are not surfaces and are ignored. Besides the file itself, only those named by referencedFiles() are
/// opened.
///
/// The file is read in a process of its own (the program limen_import_mesh, beside this one), since
/// importers of hostile or broken files crash or take all memory. Throws Error naming the file: missing,
/// unreadable, another format, no triangles, a coordinate that is not finite, a vertex index out of range,
/// beyond the limits, the importer's crash. Throws Interrupted after a signal (experiments/base/interrupt.h).
ImportedMesh importMesh(const std::string& path, const ImportLimits& limits = {});

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
