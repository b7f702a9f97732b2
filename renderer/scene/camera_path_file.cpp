// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/camera_path_file.h"

#include <algorithm>
#include <array>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/problems.h"
#include "experiments/base/replace_file.h"
#include "experiments/base/text.h"
#include "experiments/base/value_reader.h"
#include "experiments/base/yaml_tree.h"
#include "renderer/scene/camera_text.h"

namespace limen::scene {
namespace {

using Kind = YamlNode::Kind;

const char* const kExample = "camera_path: [{time_s: 0, eye: [0, 1, 5], target: [0, 0, 0]}, ...]";

class PathReader {
 public:
  explicit PathReader(const std::string& file) : problems_(file), files_(file), values_(problems_, files_) {}

  CameraPath read(const YamlNode& root) {
    CameraPath path;
    if (root.kind != Kind::Map) {
      problems_.add(root.mark, "the file holds " + root.describe(), std::string("write ") + kExample);
      problems_.throwIfAny();
    }
    checkKeys(root, "a camera path's file", {"camera_path"});
    const YamlNode* keys = root.find("camera_path");
    if (!keys || keys->kind != Kind::List || keys->items.empty())
      problems_.add(keys ? keys->mark : root.mark, "'camera_path' is not a list of keys",
                    std::string("write ") + kExample);
    problems_.throwIfAny();
    for (const YamlNode& item : keys->items)
      if (const auto key = readKey(item)) path.keys.push_back(*key), marks_.push_back(item.mark);
    checkTimes(path);
    problems_.throwIfAny();
    return path;
  }

 private:
  void checkKeys(const YamlNode& map, const std::string& what, const std::vector<std::string>& known) {
    for (const auto& [key, value] : map.members)
      if (std::find(known.begin(), known.end(), key.text) == known.end())
        problems_.add(key.mark, "unknown key '" + key.text + "' of " + what, suggest(key.text, known));
  }

  std::optional<glm::dvec3> vector(const YamlNode& node, const std::string& key) {
    if (node.kind != Kind::List || node.items.size() != 3) {
      problems_.add(node.mark, "'" + key + "' is " + node.describe(), "allowed: three numbers, [X, Y, Z]");
      return {};
    }
    std::array<std::optional<double>, 3> parts;
    for (size_t i = 0; i < 3; ++i) parts[i] = values_.number(node.items[i], key);
    if (!parts[0] || !parts[1] || !parts[2]) return {};
    return glm::dvec3(*parts[0], *parts[1], *parts[2]);
  }

  std::optional<CameraPath::Key> readKey(const YamlNode& item) {
    const size_t before = problems_.size();
    CameraPath::Key key;
    if (item.kind != Kind::Map) {
      problems_.add(item.mark, "a key of the path is " + item.describe(), std::string("write ") + kExample);
      return {};
    }
    checkKeys(item, "a key of the path", {"time_s", "eye", "target", "up", "fov_deg"});
    for (const char* needed : {"time_s", "eye", "target"})
      if (!item.find(needed))
        problems_.add(item.mark, std::string("'") + needed + "' of a key of the path is missing",
                      std::string("write ") + kExample);
    for (const auto& [name, node] : item.members) {
      if (name.text == "time_s") key.timeS = values_.number(node, name.text).value_or(0.0);
      if (name.text == "eye") key.camera.eye = vector(node, name.text).value_or(glm::dvec3(0.0));
      if (name.text == "target") key.camera.target = vector(node, name.text).value_or(glm::dvec3(0.0));
      if (name.text == "up") key.camera.up = vector(node, name.text).value_or(glm::dvec3(0.0));
      if (name.text == "fov_deg") key.camera.verticalFovDeg = values_.number(node, name.text).value_or(0.0);
    }
    if (problems_.size() != before) return {};
    try {
      checkCamera(key.camera, {});
    } catch (const Error& error) {
      problems_.add(item.mark, error.message(), error.hint());
      return {};
    }
    return key;
  }

  void checkTimes(const CameraPath& path) {
    for (size_t i = 1; i < path.keys.size(); ++i) {
      const double time = path.keys[i].timeS, previous = path.keys[i - 1].timeS;
      if (time < previous)
        problems_.add(marks_[i],
                      "time_s " + shortestNumber(time) + " comes after " + shortestNumber(previous),
                      "order the keys by time");
      if (i > 1 && time == previous && time == path.keys[i - 2].timeS)
        problems_.add(marks_[i], "a third key at time_s " + shortestNumber(time),
                      "two keys at one time are a cut; a third would never be seen");
    }
  }

  Problems problems_;
  FileFinder files_;
  ValueReader values_;
  std::vector<Mark> marks_;
};

std::string listText(glm::dvec3 v) {
  return "[" + shortestNumber(v.x) + ", " + shortestNumber(v.y) + ", " + shortestNumber(v.z) + "]";
}

}  // namespace

CameraPath parseCameraPath(const std::string& text, const std::string& file) {
  return PathReader(file).read(parseYaml(text, file));
}

CameraPath readCameraPath(const std::string& path) { return parseCameraPath(readTextFile(path), path); }

std::string toYaml(const CameraPath& path) {
  std::string out = "camera_path:\n";
  for (const auto& [timeS, camera] : path.keys)
    out += "  - {time_s: " + shortestNumber(timeS) + ", eye: " + listText(camera.eye) +
           ", target: " + listText(camera.target) + ", up: " + listText(camera.up) +
           ", fov_deg: " + shortestNumber(camera.verticalFovDeg) + "}\n";
  return out;
}

void writeCameraPath(const std::string& file, const CameraPath& path) {
  // Read back from disk: a path that is too long for a file, or that cannot be read back, replaces nothing.
  replaceFile(file, toYaml(path), [](const std::string& written) { readCameraPath(written); });
}

}  // namespace limen::scene
