// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// Loads a module of Limen, a shared library that lies beside the running program, and returns the address of
/// its function `entry`. It is never unloaded. Throws Error; `purpose` completes "cannot ...".
void* loadModule(const std::string& fileName, const char* entry, const std::string& purpose);

}  // namespace limen
