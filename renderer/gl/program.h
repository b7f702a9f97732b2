// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/gl/shader_shared.h"
#include "renderer/gl/shader_source.h"

namespace limen::gl {

/// A linked program. Uniforms are set by name; one that the compiler removed is ignored.
class Program {
 public:
  /// Shader paths end in .vert.glsl, .frag.glsl, .comp.glsl, .geom.glsl, .tesc.glsl or .tese.glsl. Throws
  /// std::runtime_error with file, line and the driver's log.
  Program(const std::vector<std::string>& paths, const ShaderDefines& defines);
  /// From shader sources already read.
  explicit Program(const std::vector<ShaderText>& stages);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Replaces this program by `fresh`: users of this object render with it from now on. Uniforms have the
  /// values set on `fresh`.
  void become(Program&& fresh);

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
  void dispatch(glm::ivec2 size, glm::ivec2 localSize = glm::ivec2(kGroupSide)) const;

 private:
  int location(const char* name) const;
  uint32_t id_ = 0;
  mutable std::map<std::string, int, std::less<>> locations_;
};

/// Programs of a context, each built once.
class ProgramCache {
 public:
  /// Programs by the paths of their shaders and their defines: "a.comp.glsl (SIZE=8)".
  struct Reload {
    std::vector<std::string> rebuilt;
    std::vector<std::string> failures;  ///< the program and why: file, line and the driver's log
  };

  const Program& get(const std::vector<std::string>& paths, const ShaderDefines& defines = {});
  const Program& compute(const std::string& path, const ShaderDefines& defines = {}) {
    return get({path}, defines);
  }
  /// Time spent compiling so far, to separate it from preparation.
  double compileMs() const { return compileMs_; }
  /// Rebuilds each program whose source has changed in the source tree since it was last built or tried.
  /// References stay valid and refer to the new program, or to the old one if the build failed; a failure is
  /// reported once. Uniforms of a rebuilt program are lost: uniforms set for longer than a frame must be set
  /// again, as Technique::prepare() does. Drivers repeat the log of a failure as debug messages of the
  /// context. Without a source tree (see setShaderRoot()) nothing happens.
  Reload reloadChanged();
  /// Forgets all programs, so that changed sources are read again. References become invalid.
  void clear() { programs_.clear(); }

 private:
  struct Entry {
    std::vector<std::string> paths;
    ShaderDefines defines;
    std::unique_ptr<Program> program;
    std::string textHash;            ///< of the source last built or tried; "" if it could not be read
    std::vector<std::string> files;  ///< that it was built from
    std::vector<FileStamp> stamps;   ///< their stamps, from before they were read
    std::string unreadable;          ///< why it could not be read when last tried
  };
  static std::vector<ShaderText> read(Entry& entry);
  using Stamps = std::map<std::string, FileStamp>;
  /// `now`: stamps already taken, as most programs share files.
  static bool mayHaveChanged(const Entry& entry, Stamps& now);
  void reload(Entry& entry, Reload& out);

  std::map<std::string, Entry> programs_;
  double compileMs_ = 0.0;
};

}  // namespace limen::gl
