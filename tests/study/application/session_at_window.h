// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/renderer/window/x_server.h"
#include "tests/study/application/study_run.h"

namespace limen {

namespace fs = std::filesystem;

/// Whole sessions at a real window, under a virtual display, with keys and mouse.
class SessionAtWindow : public testing::Test {
 protected:
  SessionAtWindow() {
    folder_ = fs::temp_directory_path() / ("limen_window_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    // The shipped protocol in a window that a software renderer fills in no time; its 320 x 240 take half of
    // the test's.
    std::ostringstream text;
    text << std::ifstream(LIMEN_SOURCE_DIR "/study/protocols/quick.yaml").rdbuf();
    std::string protocol = text.str();
    const std::string window = "{width_px: 320, height_px: 240}";
    const size_t at = protocol.find(window);
    EXPECT_NE(at, std::string::npos);
    if (at != std::string::npos) protocol.replace(at, window.size(), "{width_px: 96, height_px: 72}");
    std::ofstream(folder_ / "quick.yaml") << protocol;
  }
  ~SessionAtWindow() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::vector<std::string> arguments(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {path("quick.yaml"), "--participant", "p01", "--store",
                                    path("s.sqlite"),   "--seed",        "7",   "--announce",
                                    "--any-timing"};
    if (std::find(more.begin(), more.end(), "--full-screen") == more.end())
      all.insert(all.end(), {"--window", "640x480"});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// First column of a query, as text.
  std::vector<std::string> column(const std::string& query) const {
    sqlite3* database = nullptr;
    sqlite3_stmt* statement = nullptr;
    std::vector<std::string> values;
    EXPECT_EQ(sqlite3_open_v2(path("s.sqlite").c_str(), &database, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
    EXPECT_EQ(sqlite3_prepare_v2(database, query.c_str(), -1, &statement, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    while (sqlite3_step(statement) == SQLITE_ROW)
      values.emplace_back(reinterpret_cast<const char*>(sqlite3_column_text(statement, 0)));
    sqlite3_finalize(statement);
    sqlite3_close(database);
    return values;
  }

  /// From the consent to the first trial of the practice; `consented` is called before the answer. False if
  /// another screen comes.
  template <class Consented>
  static bool startsPractice(test::StudyRun& run, Consented consented) {
    if (!run.reaches("consent")) return false;
    consented();
    run.key("y");
    if (!run.reaches("instructions")) return false;
    run.key("space");
    if (!run.reaches("practice_start")) return false;
    run.key("space");
    return true;
  }
  static bool startsPractice(test::StudyRun& run) {
    return startsPractice(run, [] {});
  }

  /// Leads a session to its end: keys for the questions in turn, space for everything else. Gives the answers
  /// that were meant.
  std::vector<std::string> answerAll(test::StudyRun& run, size_t from = 0) {
    const std::vector<std::string> kKeys = {"y", "n", "Right", "Left", "n", "n", "2", "1"};
    const std::vector<std::string> kMeaning = {"yes", "no", "no", "yes", "no", "no", "no", "yes"};
    std::vector<std::string> meant;
    for (std::string line = run.line(); line.rfind("screen: ", 0) == 0; line = run.line()) {
      const std::string name = line.substr(8);
      if (name == "consent") {
        run.key("y");
      } else if (name == "question") {
        const size_t i = (from + meant.size()) % kKeys.size();
        meant.push_back(kMeaning[i]);
        run.key(kKeys[i]);
      } else if (name != "stimulus" && name != "feedback" && name != "wait") {
        run.key("space");
      }
      if (name == "debrief") break;
    }
    return meant;
  }

  fs::path folder_;
};

}  // namespace limen
