// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "renderer/scene/import.h"

namespace limen::scene {

/// importMesh() within this process, which a broken file may end. `opening` is told the size of each file
/// before it is opened, and 0 before the first. Errors name no file.
ImportedMesh readMeshFile(const std::string& path, const std::function<void(uint64_t bytes)>& opening);

}  // namespace limen::scene
