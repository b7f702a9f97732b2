// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace limen {

/// Paths of the files that a mesh file takes materials or geometry from: the `mtllib` of an OBJ file, the
/// buffers of a glTF or GLB file. Whether they exist is not asked; none for other files, nor for one that
/// cannot be read. An import opens no other files (renderer/scene/import.h), so nothing decides a mesh that
/// is not named here. Textures are not imported.
std::vector<std::string> referencedFiles(const std::string& path);

/// SHA-256 of a file and of those that it refers to; that of the file alone if it refers to none. Throws
/// Error if the file cannot be read.
std::string sha256WithReferences(const std::string& path);

}  // namespace limen
