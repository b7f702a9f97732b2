// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/export/export_fixture.h"

#include <nlohmann/json.hpp>
#include <sstream>

namespace limen::study {
namespace {

using nlohmann::json;

constexpr int64_t kSecond = 1'000'000'000;

}  // namespace

void Export::addSession(const std::string& participant, const std::string& name, bool simulated) {
  store::SessionLog log(store_);
  store::StudySession session;
  session.participant = participant;
  session.participantNumber = log.participantNumber(participant, "2026-03-01T12:00:00.000Z");
  session.name = name;
  session.protocol = "p0";
  session.display = "d0";
  session.seed = seed_;
  session.programVersion = "limen-study 0.1";
  session.started = "2026-03-01T12:00:00.000Z";
  const store::StudyBlock practice{0, "main", "main: practice", true, 1}, block{1, "main", "main", false, 1};
  store::StudyEntry started;
  started.event = {0, "started", "2026-03-01T12:00:00.000Z", 10 * kSecond, json::object()};
  started.event.data["answers_from_the_left"] = {{"main", {"no", "yes"}}};
  started.form = json{{"age", "34"}, {"vision", "normal"}};
  const int64_t id = log.start(session, {"p0", "quick", "quick.yaml", "A title", "title: A title"},
                               {"d0", "desk", "name: desk", json::object()},
                               {"llvmpipe", true, {{"front_end", {{"simulated", simulated}}}}},
                               {practice, block}, {started});
  ASSERT_TRUE(log.claim(id));
  int number = 0;
  const auto show = [&](int trial, int attempt, bool isPractice, int startS, int endS, bool valid) {
    store::StudyEntry begun, ended;
    begun.event = {++number, "trial_started", "2026-03-01T12:00:01.000Z", startS * kSecond, json::object()};
    store::StudyTrial row;
    row.number = trial;
    row.attempt = attempt;
    row.event = number;
    row.part = "main";
    row.block = isPractice ? 0 : 1;
    row.condition = {{"distance", "4"}};
    // Practice changed, the others showed either level throughout.
    row.stimuli = json::array({{{"changes", isPractice},
                                {"catch_shows_after", attempt == 1},
                                {"levels", {{"before", 3}, {"after", 0}}}}});
    row.stimulusHashes = {"abc"};
    row.practice = isPractice;
    row.seed = 7417417417;
    row.startedUtc = begun.event.utc;
    begun.begun = row;
    ended.event = {++number, valid ? "answered" : "trial_invalid", "2026-03-01T12:00:02.000Z", endS * kSecond,
                   json::object()};
    if (markers_)
      ended.event.data = {{"trial", trial},
                          {"attempt", attempt},
                          {"markers",
                           {{{"marker", "stimulus"},
                             {"code", 1},
                             {"due_ns", startS * kSecond + kSecond / 2},
                             {"sent_ns", startS * kSecond + kSecond / 2 + kSecond / 1000}}}}};
    store::StudyTrialEnd end{trial, attempt, valid, valid ? "" : "2 missed frames", {}, {}};
    if (valid) {
      store::StudyResponse response;
      response.event = number;
      response.answer = "yes";
      response.outcome = 1;
      response.correct = true;
      response.severity = 3;
      response.reactionTimeS = reactionTimeS_;
      response.device = "keyboard";
      for (const char* key : {"s", "m", "i"})
        response.extra["early_inputs"].push_back({{"key", key}, {"device", "keyboard"}});
      end.response = response;
    }
    end.frames = {{0, 0, 0, 100 * kSecond, 0}, {0, 0, 1, 100 * kSecond + kSecond / 4, valid ? 0 : 2}};
    ended.ended = end;
    log.append(id, {begun, ended});
  };
  show(0, 0, true, 11, 13, true);
  show(1, 0, false, 14, 15, false);
  show(1, 1, false, 16, 19, true);
  log.release(id);
}

std::vector<std::map<std::string, std::string>> Export::parse(const std::string& text, char separator) {
  std::istringstream lines(text);
  std::string line;
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  const auto split = [&](const std::string& in) {
    std::vector<std::string> out(1);
    for (const char c : in) c == separator ? out.emplace_back() : out.back() += std::string(1, c);
    return out;
  };
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = split(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), names.size()) << line;
    rows.emplace_back();
    for (size_t i = 0; i < cells.size(); ++i) rows.back()[names[i]] = cells[i];
  }
  return rows;
}

}  // namespace limen::study
