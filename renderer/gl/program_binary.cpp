// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/program_binary.h"

#include <epoxy/gl.h>

#include <cstdlib>
#include <filesystem>

#include "experiments/base/hash.h"
#include "experiments/base/replace_file.h"

namespace limen::gl {
std::string programBinaryFolder() {
  const char* folder = std::getenv("LIMEN_PROGRAM_BINARIES");
  return folder ? folder : "";
}

void writeProgramBinary(const Program& program, const std::string& folder,
                        const std::vector<std::string>& paths, const std::string& description) {
  GLint length = 0;
  glGetProgramiv(program.id(), GL_PROGRAM_BINARY_LENGTH, &length);
  if (length <= 0) return;
  std::string bytes(static_cast<size_t>(length), '\0');
  GLenum format = 0;
  GLsizei written = 0;
  glGetProgramBinary(program.id(), length, &written, &format, bytes.data());
  bytes.resize(static_cast<size_t>(written));
  const std::string name =
      std::filesystem::path(paths.front()).stem().stem().string() + "." + sha256(description).substr(0, 8);
  const std::string base = (std::filesystem::path(folder) / name).string();
  replaceFile(base + ".bin", bytes);
  replaceFile(base + ".txt", description + "\n");
}

}  // namespace limen::gl
