// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/program.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>
#include <utility>

namespace limen::gl {
namespace {

GLenum stageOf(const std::string& path) {
  static const std::map<std::string, GLenum> kStages = {
      {".vert.glsl", GL_VERTEX_SHADER},       {".frag.glsl", GL_FRAGMENT_SHADER},
      {".comp.glsl", GL_COMPUTE_SHADER},      {".geom.glsl", GL_GEOMETRY_SHADER},
      {".tesc.glsl", GL_TESS_CONTROL_SHADER}, {".tese.glsl", GL_TESS_EVALUATION_SHADER}};
  for (const auto& [suffix, stage] : kStages)
    if (path.ends_with(suffix)) return stage;
  throw std::logic_error("shader '" + path + "' names no shader stage");
}

std::string shaderLog(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader, length, nullptr, log.data());
  return log;
}

std::string programLog(GLuint program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(program, length, nullptr, log.data());
  return log;
}

std::vector<ShaderText> loadAll(const std::vector<std::string>& paths, const ShaderDefines& defines) {
  std::vector<ShaderText> stages;
  for (const std::string& path : paths) stages.push_back(loadShader(path, defines));
  return stages;
}

}  // namespace

Program::Program(const std::vector<std::string>& paths, const ShaderDefines& defines)
    : Program(loadAll(paths, defines)) {}

Program::Program(const std::vector<ShaderText>& stages) {
  const GLuint program = glCreateProgram();
  std::string names;
  for (const ShaderText& source : stages) {
    const std::string& path = source.files.front();
    names += (names.empty() ? "" : ", ") + path;
    const GLuint shader = glCreateShader(stageOf(path));
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
      const std::string log = explainLog(shaderLog(shader), source);
      glDeleteShader(shader);
      glDeleteProgram(program);
      throw std::runtime_error("shader " + path + " does not compile:\n" + log);
    }
    glAttachShader(program, shader);
    glDeleteShader(shader);  // stays alive with the program
  }
  glLinkProgram(program);
  GLint ok = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &ok);
  if (!ok) {
    const std::string log = programLog(program);
    glDeleteProgram(program);
    throw std::runtime_error("program of " + names + " does not link:\n" + log);
  }
  id_ = program;
}

void Program::become(Program&& fresh) {
  std::swap(id_, fresh.id_);
  locations_.clear();
  fresh.locations_.clear();
}

Program::~Program() { glDeleteProgram(id_); }

void Program::use() const { glUseProgram(id_); }

int Program::location(const char* name) const {
  const auto known = locations_.find(name);
  if (known != locations_.end()) return known->second;
  return locations_[name] = glGetUniformLocation(id_, name);
}

void Program::set(const char* name, int value) const { glProgramUniform1i(id_, location(name), value); }
void Program::set(const char* name, uint32_t value) const { glProgramUniform1ui(id_, location(name), value); }
void Program::set(const char* name, float value) const { glProgramUniform1f(id_, location(name), value); }
void Program::set(const char* name, glm::vec2 value) const {
  glProgramUniform2fv(id_, location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, glm::vec3 value) const {
  glProgramUniform3fv(id_, location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, glm::vec4 value) const {
  glProgramUniform4fv(id_, location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, glm::ivec2 value) const {
  glProgramUniform2iv(id_, location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat3& value) const {
  glProgramUniformMatrix3fv(id_, location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat4& value) const {
  glProgramUniformMatrix4fv(id_, location(name), 1, GL_FALSE, glm::value_ptr(value));
}

void Program::dispatch(glm::ivec2 size, glm::ivec2 localSize) const {
  use();
  const glm::ivec2 groups = (size + localSize - 1) / localSize;
  glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y), 1);
}

}  // namespace limen::gl
