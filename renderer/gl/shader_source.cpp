// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/shader_source.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "experiments/base/error.h"

namespace limen::gl {
namespace {

std::map<std::string, std::string>& embedded() {
  static std::map<std::string, std::string> shaders;
  return shaders;
}

std::string readShaderFile(const std::string& path, const std::string& includedFrom) {
  const std::string root = shaderRoot();
  if (root.empty()) {
    const auto found = embedded().find(path);
    if (found != embedded().end()) return found->second;
    throw Error("no shader '" + path + "' in the program", includedFrom, "is it listed in limen_shaders()?");
  }
  std::ifstream in(root + "/" + path);
  if (!in) throw Error("cannot read shader '" + root + "/" + path + "'", includedFrom, "check the path");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void append(const std::string& path, const std::string& includedFrom, ShaderText& out) {
  // Once per program: headers need no include guards, and a cycle terminates.
  if (std::find(out.files.begin(), out.files.end(), path) != out.files.end()) return;
  const size_t number = out.files.size();
  out.files.push_back(path);
  out.stamps.push_back(shaderStamp(path));  // before reading, so that no change in between goes unnoticed
  std::istringstream in(readShaderFile(path, includedFrom));
  std::string line;
  out.text += "#line 1 " + std::to_string(number) + "\n";
  for (int lineNumber = 1; std::getline(in, line); ++lineNumber) {
    static const std::regex kInclude(R"re(^\s*#include\s+"([^"]+)"\s*$)re");
    std::smatch match;
    if (std::regex_match(line, match, kInclude)) {
      append(match[1], path + ":" + std::to_string(lineNumber), out);
      out.text += "#line " + std::to_string(lineNumber + 1) + " " + std::to_string(number) + "\n";
    } else if (line == "#pragma once") {
      out.text += "\n";  // of a header that C++ shares
    } else {
      out.text += line + "\n";
    }
  }
}

}  // namespace

EmbeddedShader::EmbeddedShader(const char* path, const char* text) { embedded()[path] = text; }

void setShaderRoot(const std::string& root) { ::setenv("LIMEN_SHADER_ROOT", root.c_str(), 1); }

std::string shaderRoot() {
  if (const char* root = std::getenv("LIMEN_SHADER_ROOT")) return root;
#ifdef LIMEN_SHADER_ROOT_DEFAULT
  return LIMEN_SHADER_ROOT_DEFAULT;
#else
  return {};
#endif
}

FileStamp shaderStamp(const std::string& path) {
  namespace fs = std::filesystem;
  const std::string root = shaderRoot();
  if (root.empty()) return {};
  std::error_code code;
  const fs::path file = fs::path(root) / path;
  const fs::file_time_type modified = fs::last_write_time(file, code);
  if (code) return {};
  const uintmax_t bytes = fs::file_size(file, code);
  if (code) return {};
  // The coarsest clock of a common file system (FAT) has steps of 2 s.
  const bool settled = fs::file_time_type::clock::now() - modified > std::chrono::seconds(3);
  const auto sinceEpoch = std::chrono::duration_cast<std::chrono::nanoseconds>(modified.time_since_epoch());
  return {true, sinceEpoch.count(), bytes, settled};
}

ShaderText loadShader(const std::string& path, const ShaderDefines& defines) {
  ShaderText out;
  out.text = "#version 450 core\n";
  for (const auto& [name, value] : defines) out.text += "#define " + name + " " + value + "\n";
  append(path, {}, out);
  return out;
}

std::string explainLog(const std::string& log, const ShaderText& shader) {
  std::istringstream in(log);
  std::string out, line;
  while (std::getline(in, line)) {
    // Mesa: "2:14(7): error"; NVIDIA: "2(14) : error".
    static const std::regex kPlace(R"(^(\d+)(:|\()(\d+)\)?)");
    std::smatch match;
    if (std::regex_search(line, match, kPlace) && std::stoul(match[1]) < shader.files.size())
      line = shader.files[std::stoul(match[1])] + ":" + match[3].str() + match.suffix().str();
    out += line + "\n";
  }
  return out;
}

}  // namespace limen::gl
