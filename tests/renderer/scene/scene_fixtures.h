// SPDX-License-Identifier: BSD-3-Clause
// Scenes with their defaults, including those that need a file.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "experiments/base/error.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/shapes.h"

namespace limen::scene::fixtures {

using Given = std::map<std::string, ParameterValue>;

/// Folder of this process that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "limen_scene_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string write(const std::string& name, const std::string& content) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream(file, std::ios::binary) << content;
    return file.string();
  }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// A closed box of six quads, 0.6 x 1 x 0.5.
inline const std::string& smallMeshFile() {
  static const TemporaryFolder folder;
  static const std::string file = folder.write(
      "box.obj",
      "v 0 0 0\nv 0.6 0 0\nv 0.6 0 -0.5\nv 0 0 -0.5\nv 0 1 0\nv 0.6 1 0\nv 0.6 1 -0.5\nv 0 1 -0.5\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  return file;
}

/// A sphere of 512 triangles: something to take triangles from.
inline const std::string& roundMeshFile() {
  static const TemporaryFolder folder;
  static const std::string file = [] {
    const Mesh mesh = sphere(glm::dvec3(0.0), 1.0, 8);
    std::string text;
    for (const glm::dvec3& p : mesh.positions)
      text += "v " + std::to_string(p.x) + ' ' + std::to_string(p.y) + ' ' + std::to_string(p.z) + '\n';
    for (const glm::uvec3& t : mesh.triangles)
      text += "f " + std::to_string(t.x + 1) + ' ' + std::to_string(t.y + 1) + ' ' + std::to_string(t.z + 1) +
              '\n';
    return folder.write("ball.obj", text);
  }();
  return file;
}

/// A sheet folded along a ridge of three vertices, the middle one of which has a side on either hand and no
/// more.
inline const std::string& foldedMeshFile() {
  static const TemporaryFolder folder;
  static const std::string file = folder.write(
      "fold.obj",
      "v 0 1 0\nv 0 1 1\nv 0 1 2\nv -1 0 0\nv -1 0 1\nv -1 0 2\nv 0.5 0 0\nv 0.5 0 1\nv 0.5 0 2\n"
      "f 1 2 5 4\nf 2 3 6 5\nf 2 1 7 8\nf 3 2 8 9\n");
  return file;
}

/// The same sphere, a box and a folded sheet: with many triangles and with creases.
inline const std::string& creasedMeshFile() {
  static const TemporaryFolder folder;
  static const std::string file = [] {
    std::string text;
    for (const std::string& part : {roundMeshFile(), smallMeshFile(), foldedMeshFile()}) {
      std::ifstream in(part, std::ios::binary);
      const auto first = std::count(text.begin(), text.end(), 'v');
      for (std::string word; in >> word;) {
        if (word == "v" || word == "f")
          text += '\n' + word;
        else
          text += ' ' + (text[text.rfind('\n') + 1] == 'f' ? std::to_string(std::stol(word) + first) : word);
      }
    }
    return folder.write("ball_and_box.obj", text + '\n');
  }();
  return file;
}

/// What the scene cannot do without, and a coarser form of one that is made to be large.
inline Given needed(const std::string& scene) {
  if (scene == "lod/mesh") return {{"file", roundMeshFile()}};
  if (scene == "curved/pn_mesh") return {{"file", creasedMeshFile()}};
  if (scene == "boulders") return {{"tessellation", int64_t{4}}};
  if (scene == "tessellated_corner") return {{"tessellation", int64_t{4}}, {"vertices", int64_t{9}}};
  if (scene == "curved/spheres") return {{"tessellation", int64_t{2}}};
  if (scene == "curved/trimmed") return {{"tessellation", int64_t{3}}};
  if (scene == "curved/star_field") return {{"tessellation", int64_t{2}}, {"layers", int64_t{1}}};
  if (scene == "curved/herd") return {{"animals", int64_t{2}}};
  if (scene == "mirrors/mesh") return {{"file", smallMeshFile()}};
  if (scene == "herd") return {{"animals", int64_t{9}}, {"tessellation", int64_t{2}}};
  if (scene == "mirrors/herd") return {{"figures", int64_t{4}}};
  if (scene == "mirrors/several") return {{"tessellation", int64_t{8}}};
  if (scene == "mirrors/bunny") return {{"detail", 0.01}};
  // Only runs have a length.
  if (scene == "stream") return {{"distribution", std::string("runs")}};
  return scene == "mesh" ? Given{{"file", smallMeshFile()}} : Given{};
}

inline bool installed(const std::string& scene) {
  return (scene != "bunny" && scene != "horse" && scene != "cat" && scene != "lod/object" &&
          scene != "curved/pn_model" && scene != "mirrors/bunny") ||
         std::filesystem::exists("/usr/share/glmark2/models");
}

inline Scene build(const std::string& scene, Given given = {}) {
  given.merge(needed(scene));
  return buildScene(scene, ParameterValues(SceneRegistry::instance().get(scene).allParameters(), given));
}

/// One test for every registered scene.
class EveryScene : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!installed(GetParam())) GTEST_SKIP() << "the package glmark2-data is not installed";
  }
};

inline std::string nameOf(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

}  // namespace limen::scene::fixtures
