// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/gl/program.h"

namespace limen::gl {

/// Folder for binaries of programs: the environment variable LIMEN_PROGRAM_BINARIES; empty if it is not set.
std::string programBinaryFolder();

/// Writes what the driver compiled `program` to into `folder`, which must exist, as NAME.HASH.bin with NAME
/// from the first path and HASH from `description`, and `description` itself beside it, as .txt. NVIDIA's
/// driver includes the assembly text (`strings`). Throws Error if a file cannot be written; drivers without
/// binary formats write none.
void writeProgramBinary(const Program& program, const std::string& folder,
                        const std::vector<std::string>& paths, const std::string& description);

}  // namespace limen::gl
