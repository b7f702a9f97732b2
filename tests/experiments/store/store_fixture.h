// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/store/store.h"

namespace limen::store {

/// A fresh folder that goes with the test.
class StoreTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "limen_store_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

inline Run makeRun(const std::string& key, const std::string& device = "gpu") {
  Run run;
  run.key = key;
  run.device = device;
  run.status = "done";
  run.technique = "soft_shadows/pcss";
  run.scene = "grid_over_plane";
  run.label = "samples=8";
  run.parameters = {{"technique", {{"samples", 8}}}, {"image", {{"width", 64}, {"height", 48}}}};
  return run;
}

inline void addDone(Store& store, const Run& run) {
  ASSERT_EQ(store.claim(run), Store::Claim::Claimed);
  store.finish(run);
}

/// Runs SQL past the Store, as another program would. Returns the first column of the first row.
inline std::string rawSql(const std::string& file, const std::string& sql) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  std::string result;
  const auto take = [](void* out, int, char** values, char**) {
    auto& text = *static_cast<std::string*>(out);
    if (text.empty() && values[0] != nullptr) text = values[0];
    return 0;
  };
  char* message = nullptr;
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), take, &result, &message), SQLITE_OK) << message;
  sqlite3_close(database);
  return result;
}

/// Starts a child that runs `work` and leaves with 0, or with 1 if it throws. SQLite connections must not
/// cross fork().
inline pid_t startChild(const std::function<void()>& work) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  try {
    work();
    _exit(0);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    _exit(1);
  }
}

inline int exitCode(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

inline std::string errorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

inline void writeFile(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace limen::store
