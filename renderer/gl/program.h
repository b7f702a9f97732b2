// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/shader_source.h"

namespace limen::gl {

/// A linked program. Uniforms are set by name; one that the compiler removed is ignored.
class Program {
 public:
  /// Shader paths end in .vert.glsl, .frag.glsl, .comp.glsl, .geom.glsl, .tesc.glsl or .tese.glsl. Throws
  /// std::runtime_error with file, line and the driver's log.
  Program(const std::vector<std::string>& paths, const ShaderDefines& defines);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  uint32_t id() const { return id_; }
  void use() const;
  void set(const char* name, int value) const;
  void set(const char* name, uint32_t value) const;
  void set(const char* name, float value) const;
  void set(const char* name, glm::vec2 value) const;
  void set(const char* name, glm::vec3 value) const;
  void set(const char* name, glm::vec4 value) const;
  void set(const char* name, glm::ivec2 value) const;
  void set(const char* name, const glm::mat3& value) const;
  void set(const char* name, const glm::mat4& value) const;

  /// Runs a compute program over at least `size` invocations, given its local size.
  void dispatch(glm::ivec2 size, glm::ivec2 localSize = {8, 8}) const;
  /// Runs a compute program over the groups that the three first words of `arguments` count. Whoever wrote
  /// them puts a barrier with GL_COMMAND_BARRIER_BIT in between.
  void dispatchIndirect(const Buffer& arguments) const;

 private:
  int location(const char* name) const;
  uint32_t id_ = 0;
  mutable std::map<std::string, int, std::less<>> locations_;
};

/// Programs of a context, each built once.
class ProgramCache {
 public:
  const Program& get(const std::vector<std::string>& paths, const ShaderDefines& defines = {});
  const Program& compute(const std::string& path, const ShaderDefines& defines = {}) {
    return get({path}, defines);
  }
  /// Time spent compiling so far; lets preparation be told from it.
  double compileMs() const { return compileMs_; }
  /// Forgets all programs, so that changed sources are read again. References die.
  void clear() { programs_.clear(); }

 private:
  std::map<std::string, std::unique_ptr<Program>> programs_;
  double compileMs_ = 0.0;
};

}  // namespace limen::gl
