// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/saved_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/base/yaml_tree.h"

namespace limen::viewer {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const char* const kCamera = "eye 0.1 -0 5e-324 target 1 2 3 up 0 1 0 fov 45";

class SavedViews : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "limen_views_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string file() const { return (folder_ / "views.yaml").string(); }
  void write(const std::string& text) const { std::ofstream(file(), std::ios::binary) << text; }
  std::string refusal() const {
    try {
      readSavedViews(file());
    } catch (const Error& error) {
      return error.what();
    }
    return "taken";
  }
  fs::path folder_;
};

TEST_F(SavedViews, AreKeptInTheirOrder) {
  EXPECT_THAT(readSavedViews(file()), IsEmpty());
  const SavedView a = {"b", "columns_hall", kCamera}, b = {"a", "lod/object", kCamera};
  saveView(file(), a);
  saveView(file(), b);
  EXPECT_THAT(readSavedViews(file()), ElementsAre(a, b));
  const SavedView changed = {"b", "pole", "eye 9 9 9 target 0 0 0"};
  saveView(file(), changed);
  EXPECT_THAT(readSavedViews(file()), ElementsAre(changed, b));
  EXPECT_TRUE(removeView(file(), "b"));
  EXPECT_FALSE(removeView(file(), "b"));
  EXPECT_THAT(readSavedViews(file()), ElementsAre(b));
  EXPECT_TRUE(removeView(file(), "a"));
  EXPECT_THAT(readSavedViews(file()), IsEmpty());
  saveView(file(), a);
  EXPECT_THAT(readSavedViews(file()), ElementsAre(a));
}

TEST_F(SavedViews, HaveAnyName) {
  std::vector<SavedView> views;
  for (const char* name :
       {"a: b, {c} [d] # e", "\"quoted\" 'twice'", "back\\slash\\n", " spaces ", "null", "3",
        "two\nlines\tand a tab\x01\x7f", "\xC3\xA4\xE2\x82\xAC", "*a", "&b", "!c", "- d"}) {
    views.push_back({name, "pole", kCamera});
    saveView(file(), views.back());
  }
  EXPECT_EQ(readSavedViews(file()), views);
}

TEST_F(SavedViews, WhatWouldNotReadBackChangesNothing) {
  saveView(file(), {"a", "pole", kCamera});
  const std::string before = readTextFile(file());
  for (const SavedView& bad :
       {SavedView{"", "pole", kCamera}, SavedView{"b", "", kCamera}, SavedView{"b", "pole", ""},
        SavedView{"b", "pole", "eye 0 0 0 target 0 0 0"}, SavedView{"\xff", "pole", kCamera}})
    EXPECT_THROW(saveView(file(), bad), Error) << bad.name;
  EXPECT_EQ(readTextFile(file()), before);
}

TEST_F(SavedViews, AFileThatIsNotUnderstoodIsLeftAlone) {
  for (const char* text : {"", "views:\n  - {name: a, scene: pole, camera: eye 0 0 5 target 0 0 0, fog: 3}\n",
                           "views: []\nversion: 2\n", "something else\n"}) {
    write(text);
    EXPECT_THROW(saveView(file(), {"b", "pole", kCamera}), Error) << text;
    EXPECT_THROW(removeView(file(), "a"), Error) << text;
    EXPECT_EQ(readTextFile(file()), text);
  }
}

TEST_F(SavedViews, SayAllThatIsWrongWithItsLines) {
  write(
      "views:\n  - {name: a, scene: pole, camera: eye 0 0 5 target 0 0 5}\n  - {name: b, scene: pole}\n"
      "  - 7\n  - {name: b, scene: pole, camera: eye 0 0 5 target 0 0 0, fov: 3}\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("views.yaml:2:36: camera"),
                               HasSubstr("views.yaml:3:5: 'camera' of a view is missing"),
                               HasSubstr("views.yaml:4:5: a view is '7'"), HasSubstr("unknown key 'fov'"),
                               HasSubstr("views.yaml:5:5: view 'b' is also in line 3")));
}

TEST_F(SavedViews, WhatAHandWroteIsKept) {
  const std::string text =
      "# the good ones\nviews:\n  - name: a\n    scene: pole\n    camera: eye 0 0 5 target 0 0 0\n";
  write(text);
  saveView(file(), {"b", "pole", kCamera});
  EXPECT_EQ(readSavedViews(file()).size(), 2U);
  EXPECT_EQ(readTextFile(file() + ".by_hand"), text);
  saveView(file(), {"c", "pole", kCamera});
  EXPECT_EQ(readTextFile(file() + ".by_hand"), text) << "what the viewer wrote took its place";
}

TEST_F(SavedViews, AKillLosesNoOlderView) {
  for (int i = 0; i < 100; ++i) saveView(file(), {"old " + std::to_string(i), "pole", kCamera});
  for (int i = 0; i < 8; ++i) {
    const pid_t writer = fork();
    if (writer == 0)
      for (int k = 0;; ++k) saveView(file(), {"new " + std::to_string(k % 50), "pole", kCamera});
    std::this_thread::sleep_for(std::chrono::milliseconds(10 + 7 * i));
    kill(writer, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(writer, &status, 0), writer);
    ASSERT_TRUE(WIFSIGNALED(status));
    const std::vector<SavedView> views = readSavedViews(file());
    ASSERT_GE(views.size(), 100U);
    for (size_t k = 0; k < 100; ++k) EXPECT_EQ(views[k].name, "old " + std::to_string(k));
  }
}

}  // namespace
}  // namespace limen::viewer
