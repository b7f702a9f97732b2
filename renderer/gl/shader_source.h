// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace limen::gl {

/// Registers a shader's text under its path from the repository root; made by cmake/embed_shaders.cmake.
struct EmbeddedShader {
  EmbeddedShader(const char* path, const char* text);
};

using ShaderDefines = std::map<std::string, std::string>;

/// Shows that a file has changed without reading it.
struct FileStamp {
  bool there = false;
  int64_t modifiedNs = 0;
  uintmax_t bytes = 0;
  /// The file was old enough when stamped for a later change to give another modification time. If not, equal
  /// stamps prove nothing.
  bool settled = false;
};

/// A shader ready for the driver.
struct ShaderText {
  std::string text;                ///< #version, defines, then the file with its includes
  std::vector<std::string> files;  ///< number in #line directives -> path; the shader's own first
  std::vector<FileStamp> stamps;   ///< of each file, from before it was read; absent: from the program itself
};

/// From now on files come from the source tree below `root`: sets LIMEN_SHADER_ROOT for this process.
void setShaderRoot(const std::string& root);

/// Folder that shader files are read from; "" if they come from the program itself.
std::string shaderRoot();

/// The file's state in the source tree; absent if shaders come from the program itself.
FileStamp shaderStamp(const std::string& path);

/// Reads shader `path` (from the repository root, e.g. "renderer/frame/g_buffer.comp.glsl"), resolves
/// `#include "path"` (each file once) and puts `#version 450 core` and the defines in front. Files come from
/// the source tree if LIMEN_SHADER_ROOT names one or the build does not embed shaders, otherwise from the
/// program itself. Throws Error: missing file, include cycle.
ShaderText loadShader(const std::string& path, const ShaderDefines& defines = {});

/// Replaces file numbers in a driver's log ("0(12)", "0:12(3)") by paths.
std::string explainLog(const std::string& log, const ShaderText& shader);

}  // namespace limen::gl
