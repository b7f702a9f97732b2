// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/store/store.h"

/// The study half of the result store (schema_study.sql): plain rows, a writer and a reader. Instants are
/// UTC, ISO 8601 with milliseconds; nanoseconds are of the machine's steady clock.
namespace limen::store {

struct StudyDisplay {
  std::string hash, name, profile;  ///< profile: YAML
  nlohmann::json calibration = nlohmann::json::object();
};

struct StudyProtocol {
  std::string hash, name, path, title, text;
};

struct StudyBlock {
  int number = 0;  ///< presentation order, from 0
  std::string part, name;
  bool practice = false;
  int trials = 0;  ///< as planned; procedures may end earlier
};

struct StudySession {
  int64_t id = 0;
  std::string participant, name;
  int participantNumber = 0;      ///< from 0, in order of first appearance in the store
  std::string protocol, display;  ///< hashes
  int64_t environment = 0;        ///< row id
  uint64_t seed = 0;
  std::string programVersion, started;
  std::string state = "running";  ///< "running", "paused", "finished", "aborted"
  std::string owner;              ///< host:pid:start-time of the process that runs it; "" if there is none
  nlohmann::json form;            ///< field -> choice; null: not filled in
};

struct StudyEvent {
  int number = 0;
  std::string kind, utc;
  int64_t monotonicNs = 0;
  nlohmann::json data = nlohmann::json::object();
};

struct StudyResponse {
  int event = 0;
  std::string answer;  ///< one of the words defined by the protocol
  int outcome = 0;     ///< 1 for yes or correct; Rating: step from 0; Pairwise: index of the answer
  std::optional<bool> correct;
  std::optional<int> severity, confidence;  ///< steps from 1
  double reactionTimeS = 0.0;
  int64_t questionNs = 0, answeredNs = 0;
  std::string device;
  nlohmann::json extra = nlohmann::json::object();
};

struct StudyFrame {
  int stimulus = 0, showing = 0, frame = 0;
  int64_t swapNs = 0;
  int missedBlanks = 0;
};

/// One presentation of a trial.
struct StudyTrial {
  int64_t id = 0;
  int number = 0, attempt = 0;
  int event = 0;  ///< number of the event that started it: presentation order
  std::string part;
  int block = 0;
  nlohmann::json condition = nlohmann::json::object();  ///< factor -> level
  int repetition = 0;
  nlohmann::json stimuli = nlohmann::json::array();  ///< in order or position of showing
  std::vector<std::string> stimulusHashes;
  std::optional<int> procedure;
  std::vector<double> procedureStimulus;  ///< what the procedure asked for, in its dimensions' units
  int target = 0;
  bool change = true, practice = false;
  uint64_t seed = 0;
  std::string startedUtc;
  std::optional<bool> valid;  ///< nullopt: not ended (yet)
  std::string reason;         ///< why it is invalid
  bool superseded = false;    ///< its block was restarted
  std::optional<StudyResponse> response;
  std::vector<StudyFrame> frames;  ///< only if asked for

  /// Whether its answer belongs to the session's result (practice trials' answers do within practice).
  bool counts() const { return valid.value_or(false) && !superseded && response.has_value(); }
};

struct StudyNote {
  int event = 0;
  std::string author, code;  ///< author: "program", "experimenter", "participant"; code: from a closed list
  nlohmann::json detail = nlohmann::json::object();
};

/// How the trial on screen ended.
struct StudyTrialEnd {
  int number = 0, attempt = 0;
  bool valid = false;
  std::string reason;
  std::optional<StudyResponse> response;
  std::vector<StudyFrame> frames;
};

/// An event with the rows that follow from it.
struct StudyEntry {
  StudyEvent event;
  std::optional<StudyTrial> begun;
  std::optional<StudyTrialEnd> ended;
  std::optional<StudyNote> note;
  std::optional<nlohmann::json> form;
  std::optional<int> supersedeFrom;  ///< trials started by this event or a later one no longer count
  std::string state;                 ///< of the session from now on; "": unchanged
};

/// Writes sessions. Every member throws Error (full disk, read-only folder, no store ...); what was committed
/// stays. One object per thread.
class SessionLog {
 public:
  /// Commits survive a power cut; without `syncEach` (faster) only the end of the process.
  explicit SessionLog(const std::string& path, bool syncEach = true);
  ~SessionLog();
  SessionLog(const SessionLog&) = delete;
  SessionLog& operator=(const SessionLog&) = delete;

  const std::string& path() const { return path_; }

  /// Number of a participant, who is added if new.
  int participantNumber(const std::string& code, const std::string& createdUtc);
  std::optional<StudySession> find(const std::string& participant, const std::string& name) const;
  std::vector<std::string> sessionNames(const std::string& participant) const;
  std::vector<StudyEvent> events(int64_t session) const;
  std::string displayName(const std::string& hash) const;
  std::string protocolName(const std::string& hash) const;

  /// Adds a session with its first events, held by this process. Refuses a second session of the same name
  /// for a participant. Returns its row id.
  int64_t start(const StudySession& session, const StudyProtocol& protocol, const StudyDisplay& display,
                const Environment& environment, const std::vector<StudyBlock>& blocks,
                const std::vector<StudyEntry>& entries);
  int64_t putEnvironment(const Environment& environment);
  /// Claims a session for this process. False: another live process holds it (on another host: one that wrote
  /// within the last hour).
  bool claim(int64_t session);
  /// One transaction. Refused if the session is no longer held by this process.
  void append(int64_t session, const std::vector<StudyEntry>& entries);
  /// Releases a session; never throws.
  void release(int64_t session) noexcept;

  /// Acts as if the disk had room for this many pages only: for tests of a full disk.
  void limitPages(int pages);

 private:
  std::string path_;
  sqlite3* database_ = nullptr;
};

/// Reads sessions. Every member throws Error; opened with Access::ReadOnly.
class SessionReader {
 public:
  explicit SessionReader(const std::string& path);
  ~SessionReader();
  SessionReader(const SessionReader&) = delete;
  SessionReader& operator=(const SessionReader&) = delete;

  const std::string& path() const { return path_; }

  /// In order of their start.
  std::vector<StudySession> sessions() const;
  /// Every presentation, in order, with its response; frame logs on request.
  std::vector<StudyTrial> trials(int64_t session, bool withFrames = false) const;
  std::vector<StudyBlock> blocks(int64_t session) const;
  std::vector<StudyEvent> events(int64_t session) const;
  std::vector<StudyNote> notes(int64_t session) const;
  StudyProtocol protocol(const std::string& hash) const;
  StudyDisplay display(const std::string& hash) const;
  Environment environment(int64_t id) const;

 private:
  std::string path_;
  sqlite3* database_ = nullptr;
};

/// The same for a single question.
std::vector<StudySession> readSessions(const std::string& path);
std::vector<StudyTrial> readTrials(const std::string& path, int64_t session, bool withFrames = false);

}  // namespace limen::store
