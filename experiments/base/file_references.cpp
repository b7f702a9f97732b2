// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/file_references.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/base/hash.h"

namespace limen {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string extensionOf(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

/// A line ends with LF, CR or both; one that ends with a backslash goes on.
bool readLogicalLine(std::istream& file, std::string& line) {
  line.clear();
  bool any = false;
  for (std::string piece; std::getline(file, piece);) {
    any = true;
    if (!piece.empty() && piece.back() == '\r') piece.pop_back();
    const bool goesOn = !piece.empty() && piece.back() == '\\';
    if (goesOn) piece.back() = ' ';
    line += piece;
    if (!goesOn) break;
  }
  return any;
}

std::vector<std::string> materialLibraries(const std::string& path) {
  std::vector<std::string> names;
  std::ifstream file(path, std::ios::binary);
  constexpr const char* kWord = "mtllib";
  for (std::string line; readLogicalLine(file, line);) {
    const size_t word = line.find(kWord);
    if (word == std::string::npos) continue;
    std::string name = line.substr(word + std::strlen(kWord));
    // Files with bare CR are one line.
    name = name.substr(0, name.find('\r'));
    name = trimmed(name);
    if (!name.empty()) names.push_back(name);
  }
  // What importers take in place of a library that is missing.
  if (!names.empty()) names.push_back(fs::path(path).stem().string() + ".mtl");
  return names;
}

std::string percentDecoded(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool coded = text[i] == '%' && i + 2 < text.size() &&
                       std::isxdigit(static_cast<unsigned char>(text[i + 1])) != 0 &&
                       std::isxdigit(static_cast<unsigned char>(text[i + 2])) != 0;
    out += coded ? static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16)) : text[i];
    if (coded) i += 2;
  }
  return out;
}

/// The JSON of a glTF file, or of the first chunk of a binary one.
std::string gltfText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  constexpr size_t kHead = 20;
  std::string head(kHead, '\0');
  file.read(head.data(), kHead);
  head.resize(static_cast<size_t>(file.gcount()));
  if (head.size() == kHead && head.compare(0, 4, "glTF") == 0) {
    uint32_t length = 0;  // of the JSON, in versions 1 and 2
    std::memcpy(&length, head.data() + 12, sizeof length);
    std::error_code code;
    const auto size = fs::file_size(path, code);
    if (code || length > size) return {};
    std::string text(length, '\0');
    file.read(text.data(), length);
    return text;
  }
  return head + std::string(std::istreambuf_iterator<char>(file), {});
}

std::vector<std::string> gltfBuffers(const std::string& path) {
  // All but the buffers is dropped as it is read.
  const auto wanted = [](int depth, json::parse_event_t event, json& parsed) {
    return depth != 1 || event != json::parse_event_t::key || parsed == "buffers";
  };
  const json file = json::parse(gltfText(path), wanted, false);
  std::vector<std::string> names;
  if (!file.is_object() || !file.contains("buffers")) return names;
  for (const auto& [key, buffer] : file["buffers"].items()) {
    if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
    const auto uri = buffer["uri"].get<std::string>();
    if (uri.empty() || uri.compare(0, 5, "data:") == 0) continue;
    names.push_back(uri);
    names.push_back(percentDecoded(uri));
  }
  return names;
}

}  // namespace

std::vector<std::string> referencedFiles(const std::string& path) {
  const std::string extension = extensionOf(path);
  std::vector<std::string> names;
  if (extension == ".obj") names = materialLibraries(path);
  if (extension == ".gltf" || extension == ".glb") names = gltfBuffers(path);
  for (std::string& name : names)
    if (name.find('\0') == std::string::npos)
      name = (fs::path(path).parent_path() / name).lexically_normal().string();
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::string sha256WithReferences(const std::string& path) {
  const std::vector<std::string> references = referencedFiles(path);
  std::string all = sha256File(path);
  if (references.empty()) return all;
  for (const std::string& reference : references) {
    // By the name that the file uses, so that a moved folder is the same.
    const std::string name = fs::path(reference).lexically_relative(fs::path(path).parent_path()).string();
    std::error_code code;
    const bool there = fs::is_regular_file(reference, code);
    all += "\n" + (name.empty() ? reference : name) + "\n" + (there ? sha256File(reference) : "absent");
  }
  return sha256(all);
}

}  // namespace limen
