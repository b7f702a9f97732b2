// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/replace_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "experiments/base/error.h"

namespace limen {
namespace {

namespace fs = std::filesystem;

class ReplaceFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "limen_replace_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string read(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  size_t files() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  fs::path folder_;
};

TEST_F(ReplaceFile, MakesAndReplaces) {
  replaceFile(path("a"), "one");
  EXPECT_EQ(read("a"), "one");
  replaceFile(path("a"), "");
  EXPECT_EQ(read("a"), "");
  EXPECT_EQ(files(), 1U);
}

TEST_F(ReplaceFile, KeepsTheOldTextWhereTheNewOneIsRefused) {
  replaceFile(path("a"), "one");
  const auto refuse = [&](const std::string& written) {
    EXPECT_EQ(read(fs::path(written).filename()), "two");
    throw Error("refused");
  };
  EXPECT_THROW(replaceFile(path("a"), "two", refuse), Error);
  EXPECT_EQ(read("a"), "one");
  EXPECT_EQ(files(), 1U);
}

TEST_F(ReplaceFile, SaysWhatCannotBeWritten) {
  try {
    replaceFile(path("absent/a"), "one");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(path("absent/a") + ": cannot be written: No such file"));
  }
}

TEST_F(ReplaceFile, ALinkStaysOne) {
  replaceFile(path("real"), "one");
  fs::create_symlink("real", path("link"));
  replaceFile(path("link"), "two");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read("real"), "two");
}

TEST_F(ReplaceFile, AKilledWriterLeavesOneOfTheTwoTexts) {
  // Long enough for the kill to come within a write.
  const std::string a(3'000'000, 'a'), b(2'000'000, 'b');
  replaceFile(path("f"), a);
  for (int i = 0; i < 12; ++i) {
    const pid_t writer = fork();
    if (writer == 0)
      for (;;) replaceFile(path("f"), b), replaceFile(path("f"), a);
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + 3 * i));
    kill(writer, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(writer, &status, 0), writer);
    ASSERT_TRUE(WIFSIGNALED(status));
    const std::string text = read("f");
    EXPECT_TRUE(text == a || text == b) << text.size();
  }
}

}  // namespace
}  // namespace limen
