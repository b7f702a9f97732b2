// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/yaml_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <system_error>

#include "experiments/base/error.h"

namespace limen {
namespace {

constexpr size_t kMaxDepth = 16;       // a descriptor needs six
constexpr size_t kMaxBytes = 4 << 20;  // a descriptor is written by hand
constexpr size_t kMaxBracketDepth =
    64;  // keeps the scanner, which works ahead of the depth check, from quadratic time
constexpr size_t kMaxCommentBrackets = 4096;  // the same, for what is taken for a comment

Mark toMark(const YAML::Mark& mark) { return mark.is_null() ? Mark{} : Mark{mark.line + 1, mark.column + 1}; }

/// Builds the tree from the parser's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const std::string& file) : file_(file), text_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    lineStarts_.push_back(text.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0 ? kByteOrderMark.size()
                                                                                      : 0);
    for (size_t at = 0; at < text.size(); ++at)
      if (text[at] == '\n') lineStarts_.push_back(at + 1);
  }

  YamlNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1)
      throw refuse("a second document begins here", mark, "one file holds one descriptor");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    place(make(YamlNode::Kind::Null, mark, "", anchor));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw refuse("an alias ('*name')", mark, "descriptors are explicit: write the value itself");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlNode node = make(YamlNode::Kind::Scalar, mark, tag, anchor);
    node.text = value;
    node.quoted = tag == "!";
    if (node.quoted && isNeverClosed(mark)) throw refuse("a quote that is never closed", mark, "close it");
    if (!node.quoted && (value.empty() || value == "~" || value == "null")) node.kind = YamlNode::Kind::Null;
    place(std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(make(YamlNode::Kind::List, mark, tag, anchor), mark);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(make(YamlNode::Kind::Map, mark, tag, anchor), mark);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    YamlNode node;
    YamlNode key;
    bool keyPending = false;
    std::set<std::string> keys;
  };

  Error refuse(const std::string& what, const YAML::Mark& mark, const std::string& hint) const {
    return Error(what, location(file_, toMark(mark)), hint);
  }

  YamlNode make(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (anchor != 0)
      throw refuse("an anchor ('&name')", mark, "descriptors are explicit: write the value itself");
    // yaml-cpp gives "?" to plain nodes and "!" to quoted scalars; anything else is a tag in the file.
    if (!tag.empty() && tag != "?" && tag != "!") throw refuse("a tag ('" + tag + "')", mark, "leave it out");
    YamlNode node;
    node.kind = kind;
    node.mark = toMark(mark);
    return node;
  }

  /// yaml-cpp accepts a quoted scalar that runs to the end of the file.
  bool isNeverClosed(const YAML::Mark& mark) const {
    const auto line = static_cast<size_t>(std::max(0, mark.line));
    if (line >= lineStarts_.size()) return false;
    const size_t start = lineStarts_[line] + static_cast<size_t>(std::max(0, mark.column));
    if (start >= text_.size() || (text_[start] != '"' && text_[start] != '\'')) return false;
    for (size_t at = start + 1; at < text_.size(); ++at) {
      const bool escaped =
          text_[start] == '"' ? text_[at] == '\\' : text_[at] == '\'' && text_.compare(at, 2, "''") == 0;
      if (escaped)
        ++at;
      else if (text_[at] == text_[start])
        return false;
    }
    return true;
  }

  void open(YamlNode node, const YAML::Mark& mark) {
    if (levels_.size() >= kMaxDepth)
      throw refuse(fmt::format("more than {} levels of nesting", kMaxDepth), mark,
                   "no part of a descriptor is that deep");
    if (!levels_.empty() && levels_.back().node.kind == YamlNode::Kind::Map && !levels_.back().keyPending)
      throw refuse("a key that is not a word", mark, "keys are plain words");
    levels_.push_back({std::move(node), {}, false, {}});
  }

  void close() {
    YamlNode node = std::move(levels_.back().node);
    levels_.pop_back();
    place(std::move(node));
  }

  void place(YamlNode node) {
    if (levels_.empty()) {
      root_ = std::move(node);
      return;
    }
    Level& level = levels_.back();
    if (level.node.kind == YamlNode::Kind::List) {
      level.node.items.push_back(std::move(node));
    } else if (level.keyPending) {
      // The parser places "nothing" at the next token.
      if (node.kind == YamlNode::Kind::Null) node.mark = level.key.mark;
      level.node.members.push_back({std::move(level.key), std::move(node)});
      level.keyPending = false;
    } else {
      const std::string where = location(file_, node.mark);
      if (node.kind != YamlNode::Kind::Scalar) throw Error("an empty key", where, "keys are plain words");
      if (!level.keys.insert(node.text).second)
        throw Error("key '" + node.text + "' is given twice", where,
                    fmt::format("first in line {}; keep one", level.node.find(node.text)->mark.line));
      level.key = std::move(node);
      level.keyPending = true;
    }
  }

  std::string file_;
  const std::string& text_;
  std::vector<size_t> lineStarts_;
  YamlNode root_;
  std::vector<Level> levels_;
  int documents_ = 0;
};

/// Length of the well-formed UTF-8 sequence at `at` (RFC 3629), 0 if there is none.
size_t utf8Length(std::string_view text, size_t at) {
  const auto byte = [&](size_t index) {
    return index < text.size() ? static_cast<unsigned char>(text[index]) : 0U;
  };
  const unsigned first = byte(at);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                        : (first & 0xF0) == 0xE0         ? 3
                        : first >= 0xF0 && first <= 0xF4 ? 4
                                                         : 0;
  for (size_t i = 1; i < length; ++i)
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  const unsigned second = byte(at + 1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool surrogate = first == 0xED && second > 0x9F;
  const bool tooLarge = first == 0xF4 && second > 0x8F;
  return overlong || surrogate || tooLarge ? 0 : length;
}

void checkBytes(const std::string& text, const std::string& file) {
  Mark mark;
  bool indentation = true;
  bool comment = false;
  size_t depth = 0, inComments = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t length = utf8Length(text, at);
    const auto byte = static_cast<unsigned char>(text[at]);
    if (length == 0)
      throw Error(fmt::format("byte 0x{:02x} is not UTF-8", byte), location(file, mark),
                  "descriptors are UTF-8 text");
    if ((byte < 0x20 && byte != '\n' && byte != '\r' && byte != '\t') || byte == 0x7F)
      throw Error(fmt::format("control character 0x{:02x}", byte), location(file, mark),
                  "descriptors are text; is this a binary file?");
    if (byte == '\t' && indentation)
      throw Error("a tab as indentation", location(file, mark), "indent with spaces");
    const bool spaced = at == 0 || text[at - 1] == ' ' || text[at - 1] == '\t' || text[at - 1] == '\n';
    comment = (comment || (byte == '#' && spaced)) && byte != '\n';
    // "[0, 1)" in comments opens nothing; what looks like a comment may be the inside of a text, though.
    size_t& open = comment ? inComments : depth;
    if (byte == '[' || byte == '{') ++open;
    if ((byte == ']' || byte == '}') && open > 0) --open;
    if (depth > kMaxBracketDepth || inComments > kMaxCommentBrackets)
      throw Error(fmt::format("more than {} open brackets", kMaxBracketDepth), location(file, mark),
                  "close them; no part of a descriptor is that deep");
    if (byte != ' ' && byte != '\t') indentation = false;
    if (byte == '\n') {
      ++mark.line;
      mark.column = 0;
      indentation = true;
    }
    ++mark.column;
    at += length;
  }
}

}  // namespace

std::string location(const std::string& file, Mark mark) {
  return fmt::format("{}:{}:{}", file, mark.line, mark.column);
}

const YamlNode* YamlNode::find(std::string_view key) const {
  for (const auto& [name, value] : members)
    if (name.text == key) return &value;
  return nullptr;
}

std::string YamlNode::describe() const {
  constexpr size_t kShown = 60;
  switch (kind) {
    case Kind::Null:
      return "nothing";
    case Kind::List:
      return "a list";
    case Kind::Map:
      return "a map";
    case Kind::Scalar:
      break;
  }
  size_t cut = std::min(kShown, text.size());
  while (cut < text.size() && cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
  std::string shown = text.substr(0, cut) + (cut < text.size() ? "..." : "");
  for (char& character : shown)
    if (character == '\n' || character == '\r') character = ' ';
  return quoted ? "the text \"" + shown + "\"" : "'" + shown + "'";
}

YamlNode parseYaml(const std::string& text, const std::string& file) {
  checkBytes(text, file);
  std::istringstream stream(text);
  TreeBuilder builder(text, file);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw Error("not readable as YAML: " + error.msg, location(file, toMark(error.mark)), "fix the syntax");
  }
  return builder.take();
}

std::string readTextFile(const std::string& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (status.type() == std::filesystem::file_type::not_found)
    throw Error("no such file", path, "check the path");
  if (std::filesystem::is_directory(status)) throw Error("is a folder", path, "name a file in it");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw Error(std::string("cannot be read: ") + std::strerror(errno), path, "check its permissions");
  std::string text;
  std::vector<char> buffer(1 << 16);
  while (stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || stream.gcount() > 0) {
    text.append(buffer.data(), static_cast<size_t>(stream.gcount()));
    if (text.size() > kMaxBytes)
      throw Error(fmt::format("is larger than {} bytes", kMaxBytes), path, "is this the file you meant?");
  }
  if (stream.bad()) throw Error("cannot be read to the end", path, "check the disk");
  return text;
}

}  // namespace limen
