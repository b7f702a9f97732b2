// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// A shader ready for the driver.
struct ShaderText {
  std::string text;                ///< #version, defines, then the file with its includes
  std::vector<std::string> files;  ///< number in #line directives -> path
};

/// Reads shader `path` (from the repository root, e.g. "renderer/frame/g_buffer.comp.glsl"), resolves
/// `#include "path"` (each file once) and puts `#version 450 core` and the defines in front. Files come from
/// the source tree if LIMEN_SHADER_ROOT names one or the build does not embed shaders, else from the program
/// itself. Throws Error: missing file, include cycle.
ShaderText loadShader(const std::string& path, const ShaderDefines& defines = {});

/// Replaces the file numbers of a driver's log ("0(12)", "0:12(3)") by paths.
std::string explainLog(const std::string& log, const ShaderText& shader);

}  // namespace limen::gl
