// SPDX-License-Identifier: BSD-3-Clause
#include <sqlite3.h>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/process.h"
#include "experiments/store/session_rows.h"

namespace limen::store {
namespace {

using Mode = Transaction::Mode;

constexpr double kStaleSeconds =
    3600.0;  // a session on another host that wrote nothing for this long is dead

std::optional<int64_t> orNull(const std::optional<int>& value) {
  return value ? std::optional<int64_t>(*value) : std::nullopt;
}

void insertTrial(sqlite3* database, int64_t session, const StudyTrial& trial) {
  execute(database,
          "INSERT INTO trial (session, number, attempt, event, part, block, condition, repetition, stimuli, "
          "stimulus_hashes, procedure, procedure_stimulus, target, change, practice, seed, started_utc) "
          "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          session, trial.number, trial.attempt, trial.event, trial.part, trial.block,
          jsonText(trial.condition), trial.repetition, jsonText(trial.stimuli),
          jsonText(trial.stimulusHashes), orNull(trial.procedure), jsonText(trial.procedureStimulus),
          trial.target, trial.change, trial.practice, std::to_string(trial.seed), trial.startedUtc);
}

void endTrial(sqlite3* database, int64_t session, const StudyTrialEnd& end) {
  Statement find(database, "SELECT id FROM trial WHERE session = ? AND number = ? AND attempt = ?");
  if (!find.bind(session, end.number, end.attempt).step())
    throw Error("trial " + std::to_string(end.number) + " ended but never began");
  const int64_t id = find.integer(0);
  execute(database, "UPDATE trial SET valid = ?, reason = ? WHERE id = ?", end.valid, end.reason, id);
  if (end.response) {
    const StudyResponse& response = *end.response;
    const std::optional<int64_t> correct =
        response.correct ? std::optional<int64_t>(*response.correct) : std::nullopt;
    execute(database,
            "INSERT INTO response (trial, event, answer, outcome, correct, severity, confidence, "
            "reaction_time_s, question_ns, answered_ns, device, extra) "
            "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
            id, response.event, response.answer, response.outcome, correct, orNull(response.severity),
            orNull(response.confidence), std::optional<double>(response.reactionTimeS), response.questionNs,
            response.answeredNs, response.device, jsonText(response.extra));
  }
  Statement frame(database,
                  "INSERT INTO frame_log (trial, stimulus, showing, frame, swap_ns, missed_blanks) "
                  "VALUES (?, ?, ?, ?, ?, ?)");
  for (const StudyFrame& shown : end.frames)
    frame.bind(id, shown.stimulus, shown.showing, shown.frame, shown.swapNs, shown.missedBlanks).execute();
}

void insertEntry(sqlite3* database, int64_t session, const StudyEntry& entry) {
  const StudyEvent& event = entry.event;
  execute(database,
          "INSERT INTO event (session, number, kind, utc, monotonic_ns, data) VALUES (?, ?, ?, ?, ?, ?)",
          session, event.number, event.kind, event.utc, event.monotonicNs, jsonText(event.data));
  if (entry.begun) insertTrial(database, session, *entry.begun);
  if (entry.ended) endTrial(database, session, *entry.ended);
  if (entry.supersedeFrom)
    execute(database, "UPDATE trial SET superseded = 1 WHERE session = ? AND event >= ? AND superseded = 0",
            session, *entry.supersedeFrom);
  if (entry.note)
    execute(database, "INSERT INTO note (session, event, author, code, detail) VALUES (?, ?, ?, ?, ?)",
            session, event.number, entry.note->author, entry.note->code, jsonText(entry.note->detail));
  if (entry.form)
    execute(database, "UPDATE session SET form = ? WHERE id = ?", jsonText(*entry.form), session);
  if (!entry.state.empty())
    execute(database, "UPDATE session SET state = ? WHERE id = ?", entry.state, session);
}

int64_t environmentId(sqlite3* database, const Environment& environment) {
  const std::string facts = jsonText(environment.facts);
  const std::string hash =
      sha256(environment.device + "\n" + (environment.software ? "1" : "0") + "\n" + facts);
  execute(
      database,
      "INSERT INTO environment (hash, device, software, facts) VALUES (?, ?, ?, ?) ON CONFLICT DO NOTHING",
      hash, environment.device, environment.software, facts);
  Statement find(database, "SELECT id FROM environment WHERE hash = ?");
  find.bind(hash).step();
  return find.integer(0);
}

bool exists(sqlite3* database, const char* sql, const std::string& hash) {
  return Statement(database, sql).bind(hash).step();
}

std::string nameOf(sqlite3* database, const char* sql, const std::string& hash) {
  Statement row(database, sql);
  return row.bind(hash).step() ? row.text(0) : std::string();
}

}  // namespace

SessionLog::SessionLog(const std::string& path, bool syncEach)
    : path_(path), database_(openDatabase(path, false, 1, Contents::Sessions)) {
  if (!syncEach) execute(database_, "PRAGMA synchronous = NORMAL");
}

SessionLog::~SessionLog() { sqlite3_close(database_); }

int SessionLog::participantNumber(const std::string& code, const std::string& createdUtc) {
  Transaction transaction(database_, Mode::Write);
  Statement find(database_, "SELECT number FROM participant WHERE code = ?");
  if (find.bind(code).step()) return find.countingNumber(0);
  Statement last(database_, "SELECT coalesce(max(number), -1) + 1 FROM participant");
  last.step();
  const int64_t number = last.integer(0);
  execute(database_, "INSERT INTO participant (code, number, created) VALUES (?, ?, ?)", code, number,
          createdUtc);
  transaction.commit();
  return static_cast<int>(number);
}

std::optional<StudySession> SessionLog::find(const std::string& participant, const std::string& name) const {
  for (StudySession& session : selectSessions(database_))
    if (session.participant == participant && session.name == name) return std::move(session);
  return std::nullopt;
}

std::vector<std::string> SessionLog::sessionNames(const std::string& participant) const {
  Statement row(database_, "SELECT name FROM session WHERE participant = ? ORDER BY id");
  row.bind(participant);
  std::vector<std::string> out;
  while (row.step()) out.push_back(row.text(0));
  return out;
}

std::vector<StudyEvent> SessionLog::events(int64_t session) const { return selectEvents(database_, session); }

std::string SessionLog::displayName(const std::string& hash) const {
  return nameOf(database_, "SELECT name FROM display WHERE hash = ?", hash);
}

std::string SessionLog::protocolName(const std::string& hash) const {
  return nameOf(database_, "SELECT name FROM protocol WHERE hash = ?", hash);
}

int64_t SessionLog::start(const StudySession& session, const StudyProtocol& protocol,
                          const StudyDisplay& display, const Environment& environment,
                          const std::vector<StudyBlock>& blocks, const std::vector<StudyEntry>& entries) {
  Transaction transaction(database_, Mode::Write);
  Statement known(database_, "SELECT 1 FROM session WHERE participant = ? AND name = ?");
  if (known.bind(session.participant, session.name).step())
    throw Error("participant " + session.participant + " has a session " + session.name + " already", path_,
                "give the session a different name");
  if (!exists(database_, "SELECT 1 FROM protocol WHERE hash = ?", protocol.hash))
    execute(database_, "INSERT INTO protocol (hash, name, path, title, text) VALUES (?, ?, ?, ?, ?)",
            protocol.hash, protocol.name, protocol.path, protocol.title, protocol.text);
  if (!exists(database_, "SELECT 1 FROM display WHERE hash = ?", display.hash))
    execute(database_, "INSERT INTO display (hash, name, profile, calibration) VALUES (?, ?, ?, ?)",
            display.hash, display.name, display.profile, jsonText(display.calibration));
  execute(database_,
          "INSERT INTO session (participant, name, participant_number, protocol, display, environment, "
          "seed, program_version, started, state, owner) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, 'running', ?)",
          session.participant, session.name, session.participantNumber, protocol.hash, display.hash,
          environmentId(database_, environment), std::to_string(session.seed), session.programVersion,
          session.started, processIdentity());
  const int64_t id = sqlite3_last_insert_rowid(database_);
  Statement block(
      database_,
      "INSERT INTO block (session, number, part, name, practice, trials) VALUES (?, ?, ?, ?, ?, ?)");
  for (const StudyBlock& b : blocks) block.bind(id, b.number, b.part, b.name, b.practice, b.trials).execute();
  for (const StudyEntry& entry : entries) insertEntry(database_, id, entry);
  transaction.commit();
  return id;
}

int64_t SessionLog::putEnvironment(const Environment& environment) {
  Transaction transaction(database_, Mode::Write);
  const int64_t id = environmentId(database_, environment);
  transaction.commit();
  return id;
}

bool SessionLog::claim(int64_t session) {
  const std::string self = processIdentity();
  Transaction transaction(database_, Mode::Write);
  Statement find(database_,
                 "SELECT owner, (julianday('now') - julianday((SELECT utc FROM event WHERE session = s.id "
                 "ORDER BY number DESC LIMIT 1))) * 86400.0 FROM session s WHERE id = ?");
  if (!find.bind(session).step()) throw Error("no session " + std::to_string(session), path_);
  const std::string owner = find.text(0);
  if (!owner.empty() && owner != self &&
      !isOwnerDead(owner).value_or(find.isNull(1) || find.real(1) > kStaleSeconds))
    return false;
  execute(database_, "UPDATE session SET owner = ? WHERE id = ?", self, session);
  transaction.commit();
  return true;
}

void SessionLog::append(int64_t session, const std::vector<StudyEntry>& entries) {
  Transaction transaction(database_, Mode::Write);
  Statement held(database_, "SELECT 1 FROM session WHERE id = ? AND owner = ?");
  if (!held.bind(session, processIdentity()).step())
    throw Error("the session is no longer held by this process", path_,
                "another process took it over; earlier answers are kept");
  for (const StudyEntry& entry : entries) insertEntry(database_, session, entry);
  transaction.commit();
}

void SessionLog::release(int64_t session) noexcept {
  try {
    execute(database_, "UPDATE session SET owner = '' WHERE id = ? AND owner = ?", session,
            processIdentity());
  } catch (const std::exception&) {
    // The process ends soon, and its hold on the session with it.
  }
}

void SessionLog::limitPages(int pages) {
  execute(database_, ("PRAGMA max_page_count = " + std::to_string(pages)).c_str());
}

}  // namespace limen::store
