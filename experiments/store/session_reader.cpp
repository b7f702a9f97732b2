// SPDX-License-Identifier: BSD-3-Clause
#include <sqlite3.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "experiments/base/error.h"
#include "experiments/store/session_rows.h"

namespace limen::store {
namespace {

int whole(const Statement& row, int column) { return row.number(column); }

std::optional<int> wholeOrNone(const Statement& row, int column) {
  return row.isNull(column) ? std::nullopt : std::optional<int>(whole(row, column));
}

std::optional<bool> truthOrNone(const Statement& row, int column) {
  return row.isNull(column) ? std::nullopt : std::optional<bool>(row.truth(column));
}

uint64_t seedOf(const Statement& row, int column) {
  const std::string text = row.text(column);
  uint64_t seed = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (end.ec != std::errc{} || end.ptr != text.data() + text.size())
    throw row.damaged(column, "is not a seed: " + text.substr(0, 40));
  return seed;
}

template <class T>
std::vector<T> listOf(const Statement& row, int column, bool (nlohmann::json::*isOne)() const noexcept) {
  const nlohmann::json list = parseJson(row, column, JsonIs::Array);
  std::vector<T> out;
  for (const nlohmann::json& one : list) {
    if (!(one.*isOne)()) throw row.damaged(column, "holds " + one.dump().substr(0, 40));
    out.push_back(one.get<T>());
  }
  return out;
}

/// What a trial refers to must be there.
struct Limits {
  int events = 0, blocks = 0;
};

int64_t countOf(sqlite3* database, const char* sql, int64_t session) {
  Statement count(database, sql);
  count.bind(session).step();
  return count.integer(0);
}

Limits limitsOf(sqlite3* database, int64_t session) {
  constexpr int64_t kMost = std::numeric_limits<int>::max();
  return {static_cast<int>(
              std::min(countOf(database, "SELECT count(*) FROM event WHERE session = ?", session), kMost)),
          static_cast<int>(
              std::min(countOf(database, "SELECT count(*) FROM block WHERE session = ?", session), kMost))};
}

int below(const Statement& row, int column, int end) {
  const int value = row.countingNumber(column);
  if (value >= end) throw row.damaged(column, std::to_string(value) + " does not exist");
  return value;
}

StudyResponse readResponse(const Statement& row, int first, const Limits& limits) {
  StudyResponse response;
  response.event = below(row, first, limits.events);
  response.answer = row.text(first + 1);
  response.outcome = whole(row, first + 2);
  response.correct = truthOrNone(row, first + 3);
  response.severity = wholeOrNone(row, first + 4);
  response.confidence = wholeOrNone(row, first + 5);
  response.reactionTimeS = row.real(first + 6);
  response.questionNs = row.integer(first + 7);
  response.answeredNs = row.integer(first + 8);
  response.device = row.text(first + 9);
  response.extra = parseJson(row, first + 10, JsonIs::Object);
  return response;
}

StudyTrial readTrial(const Statement& row, const Limits& limits) {
  StudyTrial trial;
  trial.id = row.integer(0);
  trial.number = row.countingNumber(1);
  trial.attempt = row.countingNumber(2);
  trial.event = below(row, 3, limits.events);
  trial.part = row.text(4);
  trial.block = below(row, 5, limits.blocks);
  trial.condition = parseJson(row, 6, JsonIs::Object);
  trial.repetition = whole(row, 7);
  trial.stimuli = parseJson(row, 8, JsonIs::Array);
  for (const nlohmann::json& stimulus : trial.stimuli)
    if (!stimulus.is_object()) throw row.damaged(8, "holds something other than stimuli");
  trial.stimulusHashes = listOf<std::string>(row, 9, &nlohmann::json::is_string);
  if (trial.stimulusHashes.size() < trial.stimuli.size())
    throw row.damaged(9, "has " + std::to_string(trial.stimulusHashes.size()) + " hashes for " +
                             std::to_string(trial.stimuli.size()) + " stimuli");
  trial.procedure = wholeOrNone(row, 10);
  trial.procedureStimulus = listOf<double>(row, 11, &nlohmann::json::is_number);
  trial.target = whole(row, 12);
  trial.change = row.truth(13);
  trial.practice = row.truth(14);
  trial.seed = seedOf(row, 15);
  trial.startedUtc = row.text(16);
  trial.valid = truthOrNone(row, 17);
  trial.reason = row.text(18);
  trial.superseded = row.truth(19);
  if (!row.isNull(20)) trial.response = readResponse(row, 20, limits);
  return trial;
}

}  // namespace

std::string jsonText(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<StudySession> selectSessions(sqlite3* database) {
  Statement row(database,
                "SELECT id, participant, name, participant_number, protocol, display, environment, seed, "
                "program_version, started, state, owner, form FROM session ORDER BY id");
  std::vector<StudySession> out;
  while (row.step()) {
    StudySession session;
    session.id = row.integer(0);
    session.participant = row.text(1);
    session.name = row.text(2);
    session.participantNumber = row.countingNumber(3);
    session.protocol = row.text(4);
    session.display = row.text(5);
    session.environment = row.integer(6);
    session.seed = seedOf(row, 7);
    session.programVersion = row.text(8);
    session.started = row.text(9);
    session.state = row.text(10);
    session.owner = row.text(11);
    if (!row.isNull(12)) session.form = parseJson(row, 12, JsonIs::Object);
    out.push_back(std::move(session));
  }
  return out;
}

std::vector<StudyEvent> selectEvents(sqlite3* database, int64_t session) {
  Statement row(database,
                "SELECT number, kind, utc, monotonic_ns, data FROM event WHERE session = ? ORDER BY number");
  row.bind(session);
  std::vector<StudyEvent> out;
  while (row.step()) {
    if (row.integer(0) != static_cast<int64_t>(out.size()))
      throw row.damaged(0, "event " + std::to_string(out.size()) + " is missing");
    if (row.integer(3) < 0) throw row.damaged(3, "is before the machine started");
    out.push_back(
        {whole(row, 0), row.text(1), row.text(2), row.integer(3), parseJson(row, 4, JsonIs::Object)});
  }
  return out;
}

SessionReader::SessionReader(const std::string& path) : path_(path), database_(openDatabase(path, true, 2)) {}

SessionReader::~SessionReader() { sqlite3_close(database_); }

std::vector<StudySession> SessionReader::sessions() const { return selectSessions(database_); }

std::vector<StudyEvent> SessionReader::events(int64_t session) const {
  return selectEvents(database_, session);
}

std::vector<StudyTrial> SessionReader::trials(int64_t session, bool withFrames) const {
  Transaction snapshot(database_, Transaction::Mode::Read);
  Statement row(database_,
                "SELECT t.id, t.number, t.attempt, t.event, t.part, t.block, t.condition, t.repetition, "
                "t.stimuli, t.stimulus_hashes, t.procedure, t.procedure_stimulus, t.target, t.change, "
                "t.practice, t.seed, t.started_utc, t.valid, t.reason, t.superseded, r.event, r.answer, "
                "r.outcome, r.correct, r.severity, r.confidence, r.reaction_time_s, r.question_ns, "
                "r.answered_ns, r.device, r.extra FROM trial t LEFT JOIN response r ON r.trial = t.id "
                "WHERE t.session = ? ORDER BY t.event");
  row.bind(session);
  std::vector<StudyTrial> out;
  const Limits limits = limitsOf(database_, session);
  while (row.step()) out.push_back(readTrial(row, limits));
  if (!withFrames) return out;
  Statement frame(database_,
                  "SELECT stimulus, showing, frame, swap_ns, missed_blanks FROM frame_log WHERE trial = ? "
                  "ORDER BY stimulus, showing, frame");
  for (StudyTrial& trial : out) {
    frame.bind(trial.id);
    while (frame.step())
      trial.frames.push_back({frame.countingNumber(0), frame.countingNumber(1), frame.countingNumber(2),
                              frame.integer(3), frame.countingNumber(4)});
  }
  return out;
}

std::vector<StudyBlock> SessionReader::blocks(int64_t session) const {
  Statement row(database_,
                "SELECT number, part, name, practice, trials FROM block WHERE session = ? ORDER BY number");
  row.bind(session);
  std::vector<StudyBlock> out;
  while (row.step())
    out.push_back({row.countingNumber(0), row.text(1), row.text(2), row.truth(3), row.countingNumber(4)});
  return out;
}

std::vector<StudyNote> SessionReader::notes(int64_t session) const {
  Statement row(database_, "SELECT event, author, code, detail FROM note WHERE session = ? ORDER BY event");
  row.bind(session);
  std::vector<StudyNote> out;
  while (row.step())
    out.push_back({whole(row, 0), row.text(1), row.text(2), parseJson(row, 3, JsonIs::Object)});
  return out;
}

StudyProtocol SessionReader::protocol(const std::string& hash) const {
  Statement row(database_, "SELECT hash, name, path, title, text FROM protocol WHERE hash = ?");
  if (!row.bind(hash).step()) throw Error("no protocol " + hash, path_);
  return {row.text(0), row.text(1), row.text(2), row.text(3), row.text(4)};
}

StudyDisplay SessionReader::display(const std::string& hash) const {
  Statement row(database_, "SELECT hash, name, profile, calibration FROM display WHERE hash = ?");
  if (!row.bind(hash).step()) throw Error("no display " + hash, path_);
  return {row.text(0), row.text(1), row.text(2), parseJson(row, 3, JsonIs::Object)};
}

Environment SessionReader::environment(int64_t id) const {
  Statement row(database_, "SELECT device, software, facts FROM environment WHERE id = ?");
  if (!row.bind(id).step()) throw Error("no environment " + std::to_string(id), path_);
  return readEnvironment(row);
}

std::vector<StudySession> readSessions(const std::string& path) { return SessionReader(path).sessions(); }

std::vector<StudyTrial> readTrials(const std::string& path, int64_t session, bool withFrames) {
  return SessionReader(path).trials(session, withFrames);
}

}  // namespace limen::store
