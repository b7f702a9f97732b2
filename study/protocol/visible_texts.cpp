// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/visible_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "experiments/base/error.h"
#include "experiments/base/yaml_tree.h"

namespace limen::study {
namespace {

using Kind = YamlNode::Kind;

/// The scalars of a tree.
void collect(const YamlNode& node, const std::string& file, const std::string& key,
             std::vector<VisibleText>& out) {
  if (node.kind == Kind::Scalar) out.push_back({file, key, node.mark, node.text});
  for (const YamlNode& item : node.items) collect(item, file, key, out);
  for (const YamlMember& member : node.members) collect(member.value, file, key + "." + member.key.text, out);
}

void collectKey(const YamlNode& map, const std::string& name, const std::string& file,
                const std::string& prefix, std::vector<VisibleText>& out) {
  if (const YamlNode* node = map.find(name)) collect(*node, file, prefix + name, out);
}

void collectTask(const YamlNode& part, const std::string& file, std::vector<VisibleText>& out) {
  const YamlNode* task = part.find("task");
  if (!task) return;
  for (const char* key : {"question", "answers"}) collectKey(*task, key, file, "task.", out);
  for (const char* scale : {"severity", "confidence"})
    if (const YamlNode* node = task->find(scale))
      for (const char* key : {"question", "labels"})
        collectKey(*node, key, file, std::string("task.") + scale + ".", out);
}

/// Where a character stands in a file, from a mark on.
Mark placeOf(const std::string& source, Mark from, const std::string& character) {
  size_t at = 0;
  for (int line = 1; line < from.line && at != std::string::npos; ++line) {
    at = source.find('\n', at);
    if (at != std::string::npos) ++at;
  }
  if (at == std::string::npos) return from;
  // Columns may count characters or bytes: the lesser begins no later than the text.
  at = std::min(at + static_cast<size_t>(std::max(from.column - 1, 0)), source.size());
  const size_t found = source.find(character, at);
  if (found == std::string::npos) return from;  // written as an escape sequence
  Mark place;
  for (size_t i = 0; i < found; ++i) {
    if (source[i] == '\n') {
      ++place.line;
      place.column = 1;
    } else if ((static_cast<unsigned char>(source[i]) & 0xC0U) != 0x80U) {
      ++place.column;
    }
  }
  return place;
}

}  // namespace

std::u32string codePoints(const std::string& text) {
  std::u32string out;
  for (size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const size_t length = first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 0;
    char32_t code = length == 1 ? first : first & (0x7FU >> length);
    bool valid = length > 0 && i + length <= text.size();
    for (size_t k = 1; valid && k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      valid = (next & 0xC0U) == 0x80U;
      code = (code << 6U) | (next & 0x3FU);
    }
    out += valid ? code : U'\uFFFD';
    i += valid ? length : 1;
  }
  return out;
}

std::string toUtf8(char32_t c) {
  const auto part = [](char32_t value) { return static_cast<char>(value); };
  if (c < 0x80) return {part(c)};
  if (c < 0x800) return {part(0xC0U | (c >> 6U)), part(0x80U | (c & 0x3FU))};
  if (c < 0x10000)
    return {part(0xE0U | (c >> 12U)), part(0x80U | ((c >> 6U) & 0x3FU)), part(0x80U | (c & 0x3FU))};
  return {part(0xF0U | (c >> 18U)), part(0x80U | ((c >> 12U) & 0x3FU)), part(0x80U | ((c >> 6U) & 0x3FU)),
          part(0x80U | (c & 0x3FU))};
}

std::vector<VisibleText> visibleTexts(const Protocol& protocol) {
  std::vector<VisibleText> out;
  const YamlNode root = parseYaml(protocol.text, protocol.path);
  collectTask(root, protocol.path, out);
  if (const YamlNode* parts = root.find("parts"))
    for (const YamlNode& part : parts->items) collectTask(part, protocol.path, out);
  collectKey(root, "texts", protocol.path, "", out);
  if (const YamlNode* form = root.find("form"))
    for (const YamlNode& field : form->items)
      for (const char* key : {"label", "choices"}) collectKey(field, key, protocol.path, "form.", out);
  if (protocol.words.path().empty()) {
    for (const auto& [key, text] : protocol.words.all()) out.push_back({"", key, {}, text});
    return out;
  }
  const std::string& file = protocol.words.path();
  for (const YamlMember& member : parseYaml(readTextFile(file), file).members)
    if (member.value.kind == Kind::Scalar)
      out.push_back({file, member.key.text, member.value.mark, member.value.text});
  return out;
}

void refuseCharacters(const Protocol& protocol, const std::u32string& lacking, const std::string& hint) {
  if (lacking.empty()) return;
  constexpr size_t kMostLines = 20;
  std::vector<std::string> lines;
  std::set<std::pair<std::string, char32_t>> said;
  for (const VisibleText& text : visibleTexts(protocol))
    for (const char32_t c : codePoints(text.text)) {
      if (lacking.find(c) == std::u32string::npos || !said.emplace(text.file, c).second) continue;
      const std::string character = toUtf8(c);
      const std::string source = text.file == protocol.path ? protocol.text
                                 : text.file.empty()        ? std::string()
                                                            : readTextFile(text.file);
      lines.push_back(fmt::format("{}: '{}' (U+{:04X}) in '{}': the fonts lack this character",
                                  location(text.file, placeOf(source, text.mark, character)), character,
                                  static_cast<uint32_t>(c), text.key));
    }
  const size_t all = lines.size();
  if (all > kMostLines) {
    lines.resize(kMostLines);
    lines.push_back(fmt::format("and {} more characters", all - kMostLines));
  }
  std::string message;
  for (const std::string& line : lines) message += (message.empty() ? "" : "\n") + line;
  if (!message.empty()) throw Error(message, {}, hint);
}

}  // namespace limen::study
