// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/scene/import.h"

namespace limen::scene {

/// Starts limen_import_mesh, which lies beside this program, for a regular file and takes the mesh from it.
/// It dies alone: with this process, at its limits, or by what the file makes of it. Errors as importMesh().
ImportedMesh importInProcess(const std::string& path, const ImportLimits& limits);

/// The file on which limen_import_mesh writes what it found.
inline constexpr int kMeshStream = 3;
/// Its exit codes beside 0.
inline constexpr int kImportOutOfMemory = 3;

}  // namespace limen::scene
