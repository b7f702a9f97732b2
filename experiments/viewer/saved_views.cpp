// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/saved_views.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

#include "experiments/base/error.h"
#include "experiments/base/problems.h"
#include "experiments/base/replace_file.h"
#include "experiments/base/text.h"
#include "experiments/base/value_reader.h"
#include "experiments/base/yaml_tree.h"
#include "renderer/scene/camera_text.h"

namespace limen::viewer {
namespace {

using Kind = YamlNode::Kind;

const char* const kExample = "views: [{name: ..., scene: ..., camera: eye X Y Z target X Y Z}]";

/// Any `text` as a YAML scalar in double quotes.
std::string quoted(const std::string& text) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string out = "\"";
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (character == '"' || character == '\\')
      out += '\\', out += character;
    else if (byte < 0x20 || byte == 0x7F)
      out += "\\x", out += kDigits[byte >> 4], out += kDigits[byte & 15];
    else
      out += character;
  }
  return out + "\"";
}

std::string toYaml(const std::vector<SavedView>& views) {
  if (views.empty()) return "views: []\n";
  std::string out = "views:\n";
  for (const SavedView& view : views)
    out += "  - {name: " + quoted(view.name) + ", scene: " + quoted(view.scene) +
           ", camera: " + quoted(view.camera) + "}\n";
  return out;
}

class ViewsReader {
 public:
  explicit ViewsReader(const std::string& file) : problems_(file), files_(file), values_(problems_, files_) {}

  std::vector<SavedView> read(const YamlNode& root) {
    std::vector<SavedView> out;
    if (root.kind != Kind::Map)
      problems_.add(root.mark, "the file holds " + root.describe(), std::string("write ") + kExample);
    checkKeys(root, "a file of views", {"views"});
    const YamlNode* views = root.find("views");
    if (root.kind == Kind::Map && (!views || views->kind != Kind::List))
      problems_.add(views ? views->mark : root.mark, "'views' is not a list",
                    std::string("write ") + kExample);
    problems_.throwIfAny();
    for (const YamlNode& item : views->items) readView(item, out);
    problems_.throwIfAny();
    return out;
  }

 private:
  void checkKeys(const YamlNode& map, const std::string& what, const std::vector<std::string>& known) {
    for (const auto& [key, value] : map.members)
      if (std::find(known.begin(), known.end(), key.text) == known.end())
        problems_.add(key.mark, "unknown key '" + key.text + "' of " + what,
                      problems_.crowded() ? "" : suggest(key.text, known));
  }

  void readView(const YamlNode& item, std::vector<SavedView>& out) {
    if (item.kind != Kind::Map) {
      problems_.add(item.mark, "a view is " + item.describe(), std::string("write ") + kExample);
      return;
    }
    checkKeys(item, "a view", {"name", "scene", "camera"});
    const auto take = [&](const char* key) {
      const YamlNode* node = item.find(key);
      if (!node) problems_.add(item.mark, std::string("'") + key + "' of a view is missing", "give it: text");
      return node ? values_.text(*node, key).value_or("") : std::string();
    };
    SavedView view{take("name"), take("scene"), take("camera")};
    try {
      if (!view.camera.empty()) scene::parseCamera(view.camera);
    } catch (const Error& error) {
      problems_.add(item.find("camera")->mark, error.message(), error.hint());
    }
    const auto [first, fresh] = names_.emplace(view.name, item.mark.line);
    if (!fresh && !view.name.empty())
      problems_.add(item.mark, "view '" + view.name + "' is also in line " + std::to_string(first->second),
                    "give it another name");
    out.push_back(std::move(view));
  }

  Problems problems_;
  FileFinder files_;
  ValueReader values_;
  std::map<std::string, int> names_;
};

std::vector<SavedView> parseViews(const std::string& text, const std::string& file) {
  return ViewsReader(file).read(parseYaml(text, file));
}

bool isThere(const std::string& file) {
  std::error_code code;
  return std::filesystem::symlink_status(file, code).type() != std::filesystem::file_type::not_found;
}

/// The file's current text and its views.
struct Stored {
  std::string text;
  std::vector<SavedView> views;
};

Stored load(const std::string& file) {
  if (!isThere(file)) return {};
  Stored out{readTextFile(file), {}};
  out.views = parseViews(out.text, file);
  return out;
}

void store(const std::string& file, const Stored& before, const std::vector<SavedView>& views) {
  if (!before.text.empty() && before.text != toYaml(before.views))
    replaceFile(file + ".by_hand", before.text);
  replaceFile(file, toYaml(views), [&](const std::string& written) {
    if (parseViews(readTextFile(written), file) != views)
      throw Error("a view does not read back unchanged", file, "give it another name");
  });
}

auto find(std::vector<SavedView>& views, const std::string& name) {
  return std::find_if(views.begin(), views.end(), [&](const SavedView& view) { return view.name == name; });
}

}  // namespace

std::vector<SavedView> readSavedViews(const std::string& file) { return load(file).views; }

void saveView(const std::string& file, const SavedView& view) {
  const Stored before = load(file);
  std::vector<SavedView> views = before.views;
  const auto known = find(views, view.name);
  if (known == views.end())
    views.push_back(view);
  else
    *known = view;
  store(file, before, views);
}

bool removeView(const std::string& file, const std::string& name) {
  const Stored before = load(file);
  std::vector<SavedView> views = before.views;
  const auto known = find(views, name);
  if (known == views.end()) return false;
  views.erase(known);
  store(file, before, views);
  return true;
}

}  // namespace limen::viewer
