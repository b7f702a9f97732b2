// SPDX-License-Identifier: BSD-3-Clause
// What the documentation tells readers to type is what the programs take: every descriptor shown in README.md
// and docs/ plans, and every source file shown is the file of the tree.
#include <algorithm>

#include "tests/experiments/cli_fixture.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

/// A fenced block: ```info, its lines, ```.
struct Fence {
  std::string info, text;
  int line = 0;  ///< of its first line of text, from 1
};

std::string readText(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  EXPECT_TRUE(stream) << path;
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<Fence> fencesOf(const std::string& markdown) {
  std::vector<Fence> out;
  std::istringstream lines(markdown);
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) out.push_back({line.substr(3), "", number + 1});
    } else if (inside) {
      out.back().text += line + "\n";
    }
  }
  EXPECT_FALSE(inside) << "a fence is not closed";
  return out;
}

/// README.md and all of docs/, relative to the root.
std::vector<std::string> pages() {
  std::vector<std::string> out = {"README.md", "CONTRIBUTING.md"};
  for (const auto& entry : fs::directory_iterator(LIMEN_SOURCE_DIR "/docs"))
    if (entry.path().extension() == ".md") out.push_back("docs/" + entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

class Docs : public SweepCli {
 protected:
  void SetUp() override {
    SweepCli::SetUp();
    program_ = std::string(LIMEN_BIN_DIR) + "/limen-sweep";
    setenv("LIMEN_ROOT", LIMEN_SOURCE_DIR, 1);
  }
};

/// An info string "yaml" marks a whole descriptor; "yaml part" a piece of one. Files that descriptors name
/// lie in the folder that readers call from.
TEST_F(Docs, ShownDescriptorsPlan) {
  write("mine.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("vase.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  size_t descriptors = 0;
  for (const std::string& page : pages())
    for (const Fence& fence : fencesOf(readText(fs::path(LIMEN_SOURCE_DIR) / page))) {
      if (fence.info != "yaml") continue;
      ++descriptors;
      write("shown.yaml", fence.text);
      const CallResult result = call({"shown.yaml", "--dry-run"});
      EXPECT_EQ(result.exitCode, 0) << page << ":" << fence.line << ": " << result.err;
    }
  EXPECT_GE(descriptors, 2U);
}

/// Pieces of entries, each under `scenes` or `techniques`, or lists of expectations, stand in a small
/// descriptor.
TEST_F(Docs, ShownEntriesPlan) {
  size_t parts = 0;
  for (const std::string& page : pages())
    for (const Fence& fence : fencesOf(readText(fs::path(LIMEN_SOURCE_DIR) / page))) {
      if (fence.info != "yaml part") continue;
      ++parts;
      const auto has = [&](const std::string& key) {
        return ("\n" + fence.text).find("\n" + key + ":") != std::string::npos;
      };
      std::string text = fence.text;
      if (!has("title")) text += "title: Part\n";
      if (!has("question")) text += "question: Does it plan?\n";
      if (!has("scenes")) text += "scenes: [{name: sphere_grid}]\n";
      if (!has("techniques")) text += "techniques: [{name: soft_shadows/pcf, filter_radius: [4, 16]}]\n";
      if (!has("reference")) text += "reference: {name: soft_shadows/ray_traced, samples: 16}\n";
      if (!has("metrics")) text += "metrics: [rmse]\n";
      write("shown.yaml", text);
      const CallResult result = call({"shown.yaml", "--dry-run"});
      EXPECT_EQ(result.exitCode, 0) << page << ":" << fence.line << ": " << result.err;
    }
  EXPECT_GE(parts, 2U);
}

/// An info string "cpp PATH" or "glsl PATH" shows that file of the tree, if the tree has it; what a tutorial
/// has its reader write is not there.
TEST_F(Docs, ShownFilesAreThoseOfTheTree) {
  size_t files = 0;
  for (const std::string& page : pages())
    for (const Fence& fence : fencesOf(readText(fs::path(LIMEN_SOURCE_DIR) / page))) {
      const size_t space = fence.info.find(' ');
      if (space == std::string::npos || fence.info.starts_with("yaml")) continue;
      const fs::path file = fs::path(LIMEN_SOURCE_DIR) / fence.info.substr(space + 1);
      if (!fs::exists(file)) continue;
      ++files;
      EXPECT_EQ(fence.text, readText(file)) << page << ":" << fence.line;
    }
  EXPECT_GE(files, 2U);
}

/// Links to files of the tree, and pictures, are there.
TEST_F(Docs, LinkedFilesAreThere) {
  for (const std::string& page : pages()) {
    const std::string text = readText(fs::path(LIMEN_SOURCE_DIR) / page);
    const fs::path folder = (fs::path(LIMEN_SOURCE_DIR) / page).parent_path();
    for (size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
      const size_t end = text.find_first_of(")#\n", at + 2);
      const std::string target = text.substr(at + 2, end - at - 2);
      if (target.empty() || target.find("://") != std::string::npos ||
          target.find_first_of(" `&") != std::string::npos)
        continue;
      EXPECT_TRUE(fs::exists(folder / target)) << page << " links to " << target;
    }
  }
}

TEST_F(Docs, ReadmeIsShort) {
  const std::string text = readText(LIMEN_SOURCE_DIR "/README.md");
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 150);
}

}  // namespace
}  // namespace limen::experiments
