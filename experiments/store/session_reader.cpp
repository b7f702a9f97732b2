// SPDX-License-Identifier: BSD-3-Clause
#include <sqlite3.h>

#include "experiments/base/error.h"
#include "experiments/store/session_rows.h"

namespace limen::store {
namespace {

int whole(const Statement& row, int column) { return static_cast<int>(row.integer(column)); }

std::optional<int> wholeOrNone(const Statement& row, int column) {
  return row.isNull(column) ? std::nullopt : std::optional<int>(whole(row, column));
}

std::optional<bool> truthOrNone(const Statement& row, int column) {
  return row.isNull(column) ? std::nullopt : std::optional<bool>(row.integer(column) != 0);
}

uint64_t seedOf(const std::string& text) {
  try {
    return std::stoull(text);
  } catch (const std::exception&) {
    throw Error("the store holds a seed that is not a number: " + text.substr(0, 40));
  }
}

StudyResponse readResponse(const Statement& row, int first) {
  StudyResponse response;
  response.event = whole(row, first);
  response.answer = row.text(first + 1);
  response.outcome = whole(row, first + 2);
  response.correct = truthOrNone(row, first + 3);
  response.severity = wholeOrNone(row, first + 4);
  response.confidence = wholeOrNone(row, first + 5);
  response.reactionTimeS = row.real(first + 6);
  response.questionNs = row.integer(first + 7);
  response.answeredNs = row.integer(first + 8);
  response.device = row.text(first + 9);
  response.extra = parseJson(row.text(first + 10));
  return response;
}

StudyTrial readTrial(const Statement& row) {
  StudyTrial trial;
  trial.id = row.integer(0);
  trial.number = whole(row, 1);
  trial.attempt = whole(row, 2);
  trial.event = whole(row, 3);
  trial.part = row.text(4);
  trial.block = whole(row, 5);
  trial.condition = parseJson(row.text(6));
  trial.repetition = whole(row, 7);
  trial.stimuli = parseJson(row.text(8));
  trial.stimulusHashes = parseJson(row.text(9)).get<std::vector<std::string>>();
  trial.procedure = wholeOrNone(row, 10);
  trial.procedureStimulus = parseJson(row.text(11)).get<std::vector<double>>();
  trial.target = whole(row, 12);
  trial.change = row.integer(13) != 0;
  trial.practice = row.integer(14) != 0;
  trial.seed = seedOf(row.text(15));
  trial.startedUtc = row.text(16);
  trial.valid = truthOrNone(row, 17);
  trial.reason = row.text(18);
  trial.superseded = row.integer(19) != 0;
  if (!row.isNull(20)) trial.response = readResponse(row, 20);
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
    session.participantNumber = whole(row, 3);
    session.protocol = row.text(4);
    session.display = row.text(5);
    session.environment = row.integer(6);
    session.seed = seedOf(row.text(7));
    session.programVersion = row.text(8);
    session.started = row.text(9);
    session.state = row.text(10);
    session.owner = row.text(11);
    if (!row.isNull(12)) session.form = parseJson(row.text(12));
    out.push_back(std::move(session));
  }
  return out;
}

std::vector<StudyEvent> selectEvents(sqlite3* database, int64_t session) {
  Statement row(database,
                "SELECT number, kind, utc, monotonic_ns, data FROM event WHERE session = ? ORDER BY number");
  row.bind(session);
  std::vector<StudyEvent> out;
  while (row.step())
    out.push_back({whole(row, 0), row.text(1), row.text(2), row.integer(3), parseJson(row.text(4))});
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
  while (row.step()) out.push_back(readTrial(row));
  if (!withFrames) return out;
  Statement frame(database_,
                  "SELECT stimulus, showing, frame, swap_ns, missed_blanks FROM frame_log WHERE trial = ? "
                  "ORDER BY stimulus, showing, frame");
  for (StudyTrial& trial : out) {
    frame.bind(trial.id);
    while (frame.step())
      trial.frames.push_back(
          {whole(frame, 0), whole(frame, 1), whole(frame, 2), frame.integer(3), whole(frame, 4)});
  }
  return out;
}

std::vector<StudyBlock> SessionReader::blocks(int64_t session) const {
  Statement row(database_,
                "SELECT number, part, name, practice, trials FROM block WHERE session = ? ORDER BY number");
  row.bind(session);
  std::vector<StudyBlock> out;
  while (row.step())
    out.push_back({whole(row, 0), row.text(1), row.text(2), row.integer(3) != 0, whole(row, 4)});
  return out;
}

std::vector<StudyNote> SessionReader::notes(int64_t session) const {
  Statement row(database_, "SELECT event, author, code, detail FROM note WHERE session = ? ORDER BY event");
  row.bind(session);
  std::vector<StudyNote> out;
  while (row.step()) out.push_back({whole(row, 0), row.text(1), row.text(2), parseJson(row.text(3))});
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
  return {row.text(0), row.text(1), row.text(2), parseJson(row.text(3))};
}

Environment SessionReader::environment(int64_t id) const {
  Statement row(database_, "SELECT device, software, facts FROM environment WHERE id = ?");
  if (!row.bind(id).step()) throw Error("no environment " + std::to_string(id), path_);
  return {row.text(0), row.integer(1) != 0, parseJson(row.text(2))};
}

std::vector<StudySession> readSessions(const std::string& path) { return SessionReader(path).sessions(); }

std::vector<StudyTrial> readTrials(const std::string& path, int64_t session, bool withFrames) {
  return SessionReader(path).trials(session, withFrames);
}

}  // namespace limen::store
