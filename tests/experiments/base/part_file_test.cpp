// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/part_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/base/folder_lock.h"
#include "experiments/base/input_files.h"
#include "experiments/base/replace_file.h"
#include "experiments/base/staged_folder.h"
#include "tests/full_disk.h"

namespace limen {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PartFileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "limen_part_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
  std::string read(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::set<std::string> names(const std::string& below = "") const {
    std::set<std::string> out;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / below))
      out.insert(entry.path().filename().string());
    return out;
  }
  static mode_t modeOf(const std::string& file) {
    struct stat facts {};
    EXPECT_EQ(stat(file.c_str(), &facts), 0) << file;
    return facts.st_mode & 0777;
  }
  /// Runs in a process of its own; its exit status, 1 if it throws.
  static int inChild(const std::function<void()>& work) {
    return onFullDisk(RLIM_INFINITY, "/dev/null", work);
  }
  template <class Work>
  static std::string errorOf(Work work) {
    try {
      work();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_;
};

TEST_F(PartFileTest, WhatAKilledWriterLeftGoesWithTheNextOne) {
  const auto abandon = [&] {
    PartFile file(path("a.csv"));
    file.write("half");
    const StagedFolder folder(path("report"));
    std::ofstream(folder.path() / "page.html") << "half";
    _exit(0);  // no destructor runs, as after SIGKILL
  };
  ASSERT_EQ(inChild(abandon), 0);
  ASSERT_EQ(names().size(), 2U) << "the hidden file and the hidden folder";
  ASSERT_EQ(inChild([&] { replaceFile(path("b.csv"), "whole"); }), 0);
  EXPECT_EQ(names(), (std::set<std::string>{"b.csv"}));
}

TEST_F(PartFileTest, WhatALivingProcessWritesStaysAndSoDoFilesOfOthers) {
  PartFile mine(path("a.csv"));
  mine.write("half");
  write(".b.part-of-something", "theirs");
  write(".c.part-1", "theirs");
  write(".part-host:1:1-1", "theirs");
  const size_t before = names().size();
  ASSERT_EQ(inChild([&] { removeDeadParts(folder_.string()); }), 0);
  EXPECT_EQ(names().size(), before);
  mine.putInPlace();
  EXPECT_EQ(read("a.csv"), "half");
}

TEST_F(PartFileTest, NothingIsSeenOfAFileBeforeItIsWhole) {
  write("a.csv", "old");
  {
    PartFile file(path("a.csv"));
    file.write("new");
    EXPECT_EQ(read("a.csv"), "old");
  }
  EXPECT_EQ(read("a.csv"), "old") << "it was not put in place";
  EXPECT_EQ(names().size(), 1U);
}

TEST_F(PartFileTest, AFullDiskLeavesTheOldFileAndNoneOfTheNew) {
  write("a.csv", "old");
  EXPECT_EQ(onFullDisk(4096, path("message"), [&] { replaceFile(path("a.csv"), std::string(10000, 'x')); }),
            1);
  EXPECT_EQ(read("a.csv"), "old");
  EXPECT_THAT(read("message"), HasSubstr(path("a.csv") + ": cannot be written: File too large"));
  EXPECT_EQ(names(), (std::set<std::string>{"a.csv", "message"}));
  EXPECT_THAT(errorOf([] { replaceFile("/dev/full", "text"); }), HasSubstr("No space left"));
}

TEST_F(PartFileTest, ADeviceIsWrittenToAndStaysOne) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const int reader = open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  replaceFile(path("pipe"), "text");
  char text[8] = {};
  EXPECT_EQ(::read(reader, text, sizeof text), 4);
  EXPECT_STREQ(text, "text");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
  replaceFile("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(PartFileTest, ALinkToAFileThatIsStillToBeMadeStaysALink) {
  fs::create_symlink("later.csv", path("link"));
  replaceFile(path("link"), "text");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read("later.csv"), "text");
}

TEST_F(PartFileTest, RightsStayOrAreTheOwnersAlone) {
  write("a", "old");
  chmod(path("a").c_str(), 0640);
  replaceFile(path("a"), "new");
  EXPECT_EQ(modeOf(path("a")), 0640u);
  replaceFile(path("a"), "secret", {}, Readers::OwnerOnly);
  EXPECT_EQ(modeOf(path("a")), 0600u);
  const StagedFolder folder(path("secrets"), Readers::OwnerOnly);
  EXPECT_EQ(modeOf(folder.path().string()), 0700u);
}

TEST_F(PartFileTest, AnInputIsNeverReplacedUnderWhateverName) {
  fs::create_directories(folder_ / "sub");
  write("data.csv", "data");
  fs::create_symlink("data.csv", path("link.csv"));
  fs::create_hard_link(path("data.csv"), path("hard.csv"));
  fs::create_symlink(folder_, path("sub/again"));
  protectInput(path("data.csv"));
  for (const char* name : {"data.csv", "./data.csv", "sub/../data.csv", "link.csv", "hard.csv",
                           "sub/again/data.csv", "sub/again/hard.csv"}) {
    EXPECT_THAT(errorOf([&] { replaceFile(path(name), "gone"); }), HasSubstr("is an input")) << name;
    EXPECT_THAT(errorOf([&] { requireNoInput(path(name), "--csv"); }), HasSubstr("--csv: '" + path(name)))
        << name;
  }
  EXPECT_EQ(read("data.csv"), "data");
  replaceFile(path("other.csv"), "text");
  // An input that comes later.
  protectInput(path("sub/later.csv"));
  EXPECT_THAT(errorOf([&] { replaceFile(path("sub/again/sub/later.csv"), ""); }), HasSubstr("is an input"));
  EXPECT_FALSE(fs::exists(path("sub/later.csv")));
}

TEST_F(PartFileTest, AStagedFolderMovesNothingOverAnInput) {
  fs::create_directories(folder_ / "out");
  write("out/b.csv", "data");
  protectInput(path("out/b.csv"));
  const StagedFolder staged(path("out"));
  std::ofstream(staged.path() / "a.csv") << "new";
  std::ofstream(staged.path() / "b.csv") << "new";
  EXPECT_THAT(errorOf([&] { staged.putInPlace(); }), HasSubstr("is an input"));
  EXPECT_EQ(read("out/b.csv"), "data");
  EXPECT_FALSE(fs::exists(path("out/a.csv"))) << "nothing was moved";
}

TEST_F(PartFileTest, OfTwoNewFoldersAtOnceOneIsWholeAndTheOtherIsRefused) {
  for (const bool exists : {false, true})
    for (int round = 0; round < 8; ++round) {
      const std::string target = path("new" + std::to_string(round) + (exists ? "e" : ""));
      if (exists) fs::create_directory(target);
      std::vector<pid_t> children;
      for (const char* name : {"a", "b"}) {
        children.push_back(fork());
        if (children.back() != 0) continue;
        try {
          const StagedFolder staged(target);
          for (int i = 0; i < 20; ++i) std::ofstream(staged.path() / (name + std::to_string(i))) << name;
          staged.putInPlaceAsNew();
          _exit(0);
        } catch (const Error& error) {
          _exit(std::string(error.what()).find("is not an empty folder") != std::string::npos ? 2 : 3);
        }
      }
      std::multiset<int> codes;
      for (const pid_t child : children) {
        int status = 0;
        waitpid(child, &status, 0);
        codes.insert(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
      }
      EXPECT_EQ(codes, (std::multiset<int>{0, 2})) << target;
      size_t files = 0;
      for (const fs::directory_entry& entry : fs::directory_iterator(target))
        files += entry.is_regular_file();
      EXPECT_EQ(files, 20U) << target;
    }
}

TEST_F(PartFileTest, ALockedFolderIsWaitedFor) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(folder_.string());
    [[maybe_unused]] const ssize_t told = ::write(ready[1], "x", 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    std::ofstream(path("done")) << "x";
    _exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  const FolderLock lock(folder_.string());
  EXPECT_TRUE(fs::exists(path("done")));
  int status = 0;
  waitpid(child, &status, 0);
  close(ready[0]);
  close(ready[1]);
}

}  // namespace
}  // namespace limen
