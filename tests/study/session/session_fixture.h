// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/store/sessions.h"
#include "study/session/replay.h"
#include "study/session/run.h"
#include "tests/study/session/scripted.h"

namespace limen::study {

inline std::string errorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// A fresh folder that goes with the test, and sessions in a store there.
class SessionStoreTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "limen_session_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    request_.store = path("s.sqlite");
    request_.participant = "p01";
    request_.seed = 18446744073709551557u;  // beyond what a signed integer holds
    request_.durability = Durability::ProcessKill;
    request_.display = perception::displayPreset("desktop_24");
    request_.warn = [this](const std::string& text) { warnings_.push_back(text); };
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  SessionEnd run(const Protocol& protocol, ScriptedFrontEnd& frontEnd) {
    return runSession(protocol, request_, frontEnd, clock_);
  }
  SessionEnd resume(const Protocol& protocol, ScriptedFrontEnd& frontEnd) {
    request_.resume = true;
    return runSession(protocol, request_, frontEnd, clock_);
  }
  /// Differences between events and rows of every session in the store.
  std::vector<std::string> verify(const Protocol& protocol) const {
    store::SessionReader reader(request_.store);
    std::vector<std::string> out;
    for (const store::StudySession& session : reader.sessions())
      for (const std::string& line : verifySession(reader, session, protocol).differences)
        out.push_back(line);
    return out;
  }

  std::filesystem::path folder_;
  SessionRequest request_;
  TestClock clock_;
  std::vector<std::string> warnings_;
};

}  // namespace limen::study
