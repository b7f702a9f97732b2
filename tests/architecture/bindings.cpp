// SPDX-License-Identifier: BSD-3-Clause
#include "tests/architecture/bindings.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>

namespace limen::architecture {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> kFolders{"renderer", "perception", "experiments", "study", "tests"};

// Tests of the binding calls themselves, with shaders that stand in the test.
constexpr std::array<std::string_view, 3> kOwnShaders{"tests/renderer/gl/context_test.cpp",
                                                      "tests/renderer/gl/program_reload_test.cpp",
                                                      "tests/renderer/gl/program_test.cpp"};

std::string fileText(const fs::path& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

bool endsWith(const std::string& text, std::string_view end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// A file that a program names, not a part of one.
bool isStage(const std::string& file) {
  return endsWith(file, ".comp.glsl") || endsWith(file, ".vert.glsl") || endsWith(file, ".frag.glsl");
}

void append(Violations& all, Violations more) { all.insert(all.end(), more.begin(), more.end()); }

Violations findEach(const std::string& file, const std::string& text, const std::regex& pattern,
                    const std::string& rule) {
  Violations out;
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::smatch match;
    if (std::regex_search(line, match, pattern))
      out.push_back(file + ":" + std::to_string(number) + ": " + match.str() + ": " + rule);
  }
  return out;
}

/// Quoted includes of a text with the depth of the #if that each stands in.
std::vector<std::pair<std::string, int>> includesOf(const std::string& text) {
  static const std::regex kInclude(R"re(^\s*#\s*include\s+"([^"]+)")re"), kOpen(R"(^\s*#\s*if)"),
      kClose(R"(^\s*#\s*endif)");
  std::vector<std::pair<std::string, int>> out;
  std::istringstream in(text);
  std::string line;
  int depth = 0;
  while (std::getline(in, line)) {
    std::smatch match;
    if (std::regex_search(line, kOpen)) ++depth;
    if (std::regex_search(line, kClose)) --depth;
    if (std::regex_search(line, match, kInclude)) out.emplace_back(match[1], depth);
  }
  return out;
}

/// The header's path stands in the nearest CMakeLists.txt with a list of shaders.
bool isListed(const fs::path& root, const std::string& header) {
  for (fs::path folder = fs::path(header).parent_path(); !folder.empty(); folder = folder.parent_path()) {
    const std::string list = fileText(root / folder / "CMakeLists.txt");
    if (list.find("limen_shaders(") == std::string::npos) continue;
    return list.find(fs::path(header).lexically_relative(folder).generic_string()) != std::string::npos;
  }
  return false;
}

}  // namespace

Violations checkLayouts(const std::string& file, const std::string& shader) {
  static const std::regex kLayout(R"(layout\s*\([^)]*\bbinding\s*=\s*\d+)"),
      kDefine(R"(#\s*define\s+\w*(UNIT|BINDING|IMAGE)\s+\d+)");
  const std::string rule = "name the unit in a header that C++ and GLSL share";
  Violations out = findEach(file, shader, kLayout, rule);
  append(out, findEach(file, shader, kDefine, rule));
  return out;
}

Violations checkBindCalls(const std::string& file, const std::string& source) {
  static const std::regex kCall(
      R"(\b(bindTexture|bindImage|bindStorage|bindUniform|glBindTextureUnit|glBindImageTexture)\s*\(\s*\d)"
      R"(|\bglBindBufferBase\s*\(\s*\w+\s*,\s*\d|[.>]bind\s*\(\s*\d+U?\s*\))");
  return findEach(file, source, kCall, "name the unit in a header that C++ and GLSL share");
}

Violations checkUnits(const std::string& file, const std::string& header) {
  static const std::regex kUnit(R"(\bk\w+(Unit|Image)\s*=\s*(\d+)u?\s*;)");
  Violations out;
  for (auto it = std::sregex_iterator(header.begin(), header.end(), kUnit); it != std::sregex_iterator();
       ++it) {
    const int granted = (*it)[1] == "Image" ? 8 : 16;
    if (std::stoi((*it)[2]) >= granted)
      out.push_back(file + ": " + it->str() + ": drivers need not grant more than " +
                    std::to_string(granted));
  }
  return out;
}

Violations checkConditionalIncludes(const std::string& shader,
                                    const std::function<std::string(const std::string&)>& read) {
  Violations out;
  std::set<std::string> seen;
  const std::function<void(const std::string&, int)> visit = [&](const std::string& file, int depth) {
    if (!seen.insert(file).second) return;
    const bool isHeader = endsWith(file, ".h");
    if (isHeader && depth > 0)
      out.push_back(shader + ": " + file + " is first included within an #if: include it above");
    // What a header includes within __cplusplus is skipped by shaders; the rest stands outside.
    for (const auto& [included, within] : includesOf(read(file))) visit(included, depth + within);
  };
  visit(shader, 0);
  return out;
}

Violations checkBindings(const fs::path& root) {
  Violations out;
  std::set<std::string> shared;
  for (const std::string_view folder : kFolders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string file = entry.path().lexically_relative(root).generic_string();
      const bool isShader = endsWith(file, ".glsl"), isHeader = endsWith(file, ".h");
      if (!isShader && !isHeader && !endsWith(file, ".cpp")) continue;
      if (file.rfind("tests/architecture/", 0) == 0) continue;  // the planted violations
      const std::string text = fileText(entry.path());
      if (isShader) {
        append(out, checkLayouts(file, text));
        if (isStage(file))
          append(out, checkConditionalIncludes(
                          file, [&](const std::string& path) { return fileText(root / path); }));
        for (const auto& [included, depth] : includesOf(text))
          if (endsWith(included, ".h")) shared.insert(included);
      } else if (std::find(kOwnShaders.begin(), kOwnShaders.end(), file) == kOwnShaders.end()) {
        append(out, checkBindCalls(file, text));
      }
      if (endsWith(file, "_bindings.h")) append(out, checkUnits(file, text));
    }
  if (shared.empty()) out.push_back("no shader includes a header: is this the root?");
  shared.insert("renderer/gl/shader_shared.h");
  for (const std::string& header : shared)
    if (!isListed(root, header)) out.push_back(header + ": not listed in limen_shaders(), so not embedded");
  return out;
}

}  // namespace limen::architecture
