-- Result store, schema version 2: studies with people. Times are UTC, ISO 8601; *_ns are nanoseconds of the machine's
-- steady clock, which starts anew when it boots. The event log is the truth; trial, response, frame_log, block and note
-- are derived from it and written in the same transaction as their event. No table holds a name or free text of a
-- participant.

CREATE TABLE participant (
  code TEXT PRIMARY KEY,              -- letters, digits, - and _
  number INTEGER NOT NULL UNIQUE,     -- from 0: picks rows of Latin squares
  created TEXT NOT NULL
);

CREATE TABLE display (
  hash TEXT PRIMARY KEY,              -- of all that decides what is seen
  name TEXT NOT NULL,
  profile TEXT NOT NULL,              -- YAML, as `limen perceive display` reads it
  calibration TEXT NOT NULL           -- JSON: how the profile was measured; {}: it was not
);

CREATE TABLE protocol (
  hash TEXT PRIMARY KEY,              -- SHA-256 of `text`
  name TEXT NOT NULL,
  path TEXT NOT NULL,                 -- file as given
  title TEXT NOT NULL,
  text TEXT NOT NULL                  -- the YAML
);

CREATE TABLE session (
  id INTEGER PRIMARY KEY,
  participant TEXT NOT NULL REFERENCES participant(code),
  name TEXT NOT NULL,                 -- number or name of the sitting
  participant_number INTEGER NOT NULL,
  protocol TEXT NOT NULL REFERENCES protocol(hash),
  display TEXT NOT NULL REFERENCES display(hash),
  environment INTEGER NOT NULL REFERENCES environment(id),  -- where it began; a Continued event names its own
  seed TEXT NOT NULL,                 -- unsigned, 64 bits, decimal: too large for some readers' integers
  program_version TEXT NOT NULL,
  started TEXT NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('running', 'paused', 'finished', 'aborted')),
  owner TEXT NOT NULL DEFAULT '',     -- host:pid:start of the process that runs it
  form TEXT,                          -- JSON: field -> choice; NULL: not filled in (yet)
  UNIQUE (participant, name)
);

CREATE TABLE event (
  session INTEGER NOT NULL REFERENCES session(id),
  number INTEGER NOT NULL,            -- from 0 without gaps
  kind TEXT NOT NULL,
  utc TEXT NOT NULL,
  monotonic_ns INTEGER NOT NULL,
  data TEXT NOT NULL,                 -- JSON
  PRIMARY KEY (session, number)
) WITHOUT ROWID;

CREATE TABLE block (
  session INTEGER NOT NULL REFERENCES session(id),
  number INTEGER NOT NULL,            -- order of showing, from 0
  part TEXT NOT NULL,
  name TEXT NOT NULL,
  practice INTEGER NOT NULL,
  trials INTEGER NOT NULL,            -- as planned; procedures may end before
  PRIMARY KEY (session, number)
) WITHOUT ROWID;

-- One row each time that a trial was put on the screen.
CREATE TABLE trial (
  id INTEGER PRIMARY KEY,
  session INTEGER NOT NULL REFERENCES session(id),
  number INTEGER NOT NULL,            -- within the session's plan, from 0
  attempt INTEGER NOT NULL,           -- from 0: shown again after late frames or an interruption
  event INTEGER NOT NULL,             -- that started it; orders trials as they were shown
  part TEXT NOT NULL,
  block INTEGER NOT NULL,
  condition TEXT NOT NULL,            -- JSON: factor -> level
  repetition INTEGER NOT NULL,
  stimuli TEXT NOT NULL,              -- JSON array, in order or position of showing: all that is rendered
  stimulus_hashes TEXT NOT NULL,      -- JSON array: SHA-256 of each stimulus
  procedure INTEGER,                  -- NULL: not adaptive
  procedure_stimulus TEXT NOT NULL,   -- JSON array: what the procedure asked for
  target INTEGER NOT NULL,            -- interval or position that has the change
  change INTEGER NOT NULL,            -- 0: catch trial
  practice INTEGER NOT NULL,
  seed TEXT NOT NULL,                 -- of all randomness within the trial
  started_utc TEXT NOT NULL,
  valid INTEGER CHECK (valid IN (0, 1)),  -- NULL: not ended (yet)
  reason TEXT NOT NULL DEFAULT '',    -- why it is not valid
  superseded INTEGER NOT NULL DEFAULT 0,  -- 1: its block was begun anew; answers stay, and count no more
  UNIQUE (session, number, attempt),
  FOREIGN KEY (session, event) REFERENCES event(session, number),
  FOREIGN KEY (session, block) REFERENCES block(session, number)
);

CREATE TABLE response (
  trial INTEGER PRIMARY KEY REFERENCES trial(id),
  event INTEGER NOT NULL,
  answer TEXT NOT NULL,               -- one of the protocol's words
  outcome INTEGER NOT NULL,           -- yes or right: 1; Rating: step from 0
  correct INTEGER CHECK (correct IN (0, 1)),  -- NULL: nothing is right or wrong
  severity INTEGER,                   -- step from 1
  confidence INTEGER,                 -- step from 1
  reaction_time_s REAL NOT NULL,
  question_ns INTEGER NOT NULL,
  answered_ns INTEGER NOT NULL,
  device TEXT NOT NULL,
  extra TEXT NOT NULL                 -- JSON
);

CREATE TABLE frame_log (
  trial INTEGER NOT NULL REFERENCES trial(id),
  stimulus INTEGER NOT NULL,
  showing INTEGER NOT NULL,
  frame INTEGER NOT NULL,
  swap_ns INTEGER NOT NULL,
  missed_blanks INTEGER NOT NULL,
  PRIMARY KEY (trial, stimulus, showing, frame)
) WITHOUT ROWID;

CREATE TABLE note (
  session INTEGER NOT NULL,
  event INTEGER NOT NULL,
  author TEXT NOT NULL,               -- program, experimenter, participant
  code TEXT NOT NULL,                 -- from a closed list: never free text
  detail TEXT NOT NULL,               -- JSON
  PRIMARY KEY (session, event),
  FOREIGN KEY (session, event) REFERENCES event(session, number)
) WITHOUT ROWID;

-- What a predictor says of a stimulus with a change, on one display in a window of one size: what the answers are
-- compared with.
CREATE TABLE prediction (
  id INTEGER PRIMARY KEY,
  stimulus_hash TEXT NOT NULL,        -- as in trial.stimulus_hashes
  display_hash TEXT NOT NULL REFERENCES display(hash),
  width_px INTEGER NOT NULL,          -- of the window
  height_px INTEGER NOT NULL,
  predictor TEXT NOT NULL,
  settings_hash TEXT NOT NULL,        -- SHA-256 of `settings`
  settings TEXT NOT NULL,             -- JSON: every value that the predictor and the metrics were given
  program_version TEXT NOT NULL,
  created TEXT NOT NULL,
  figures TEXT NOT NULL,              -- JSON: figure -> value
  UNIQUE (stimulus_hash, display_hash, width_px, height_px, predictor, settings_hash, program_version)
);

-- Nothing is ever overwritten, by whatever program. Triggers on INSERT stand where REPLACE would get past the others.
CREATE TRIGGER event_follows BEFORE INSERT ON event
  WHEN NEW.number <> (SELECT coalesce(max(number), -1) + 1 FROM event WHERE session = NEW.session)
  BEGIN SELECT RAISE(ABORT, 'an event must follow the last one'); END;
CREATE TRIGGER event_update BEFORE UPDATE ON event BEGIN SELECT RAISE(ABORT, 'events are never overwritten'); END;
CREATE TRIGGER event_delete BEFORE DELETE ON event BEGIN SELECT RAISE(ABORT, 'events are never overwritten'); END;

CREATE TRIGGER response_once BEFORE INSERT ON response
  WHEN EXISTS (SELECT 1 FROM response WHERE trial = NEW.trial)
  BEGIN SELECT RAISE(ABORT, 'responses are never overwritten'); END;
CREATE TRIGGER response_update BEFORE UPDATE ON response BEGIN SELECT RAISE(ABORT, 'responses are never overwritten'); END;
CREATE TRIGGER response_delete BEFORE DELETE ON response BEGIN SELECT RAISE(ABORT, 'responses are never overwritten'); END;

CREATE TRIGGER frame_log_once BEFORE INSERT ON frame_log
  WHEN EXISTS (SELECT 1 FROM frame_log WHERE trial = NEW.trial AND stimulus = NEW.stimulus AND showing = NEW.showing
                                             AND frame = NEW.frame)
  BEGIN SELECT RAISE(ABORT, 'frame logs are never overwritten'); END;
CREATE TRIGGER frame_log_update BEFORE UPDATE ON frame_log BEGIN SELECT RAISE(ABORT, 'frame logs are never overwritten'); END;
CREATE TRIGGER frame_log_delete BEFORE DELETE ON frame_log BEGIN SELECT RAISE(ABORT, 'frame logs are never overwritten'); END;

CREATE TRIGGER trial_once BEFORE INSERT ON trial
  WHEN EXISTS (SELECT 1 FROM trial WHERE id = NEW.id
               OR (session = NEW.session AND number = NEW.number AND attempt = NEW.attempt))
  BEGIN SELECT RAISE(ABORT, 'trials are never overwritten'); END;
CREATE TRIGGER trial_update BEFORE UPDATE OF id, session, number, attempt, event, part, block, condition, repetition,
    stimuli, stimulus_hashes, procedure, procedure_stimulus, target, change, practice, seed, started_utc ON trial
  BEGIN SELECT RAISE(ABORT, 'trials are never overwritten'); END;
CREATE TRIGGER trial_end BEFORE UPDATE OF valid, reason ON trial WHEN OLD.valid IS NOT NULL
  BEGIN SELECT RAISE(ABORT, 'trials end once'); END;
CREATE TRIGGER trial_superseded BEFORE UPDATE OF superseded ON trial WHEN NEW.superseded <> 1
  BEGIN SELECT RAISE(ABORT, 'trials are never overwritten'); END;
CREATE TRIGGER trial_delete BEFORE DELETE ON trial BEGIN SELECT RAISE(ABORT, 'trials are never overwritten'); END;

CREATE TRIGGER block_update BEFORE UPDATE ON block BEGIN SELECT RAISE(ABORT, 'blocks are never overwritten'); END;
CREATE TRIGGER block_delete BEFORE DELETE ON block BEGIN SELECT RAISE(ABORT, 'blocks are never overwritten'); END;
CREATE TRIGGER note_update BEFORE UPDATE ON note BEGIN SELECT RAISE(ABORT, 'notes are never overwritten'); END;
CREATE TRIGGER note_delete BEFORE DELETE ON note BEGIN SELECT RAISE(ABORT, 'notes are never overwritten'); END;

CREATE TRIGGER session_once BEFORE INSERT ON session
  WHEN EXISTS (SELECT 1 FROM session WHERE id = NEW.id OR (participant = NEW.participant AND name = NEW.name))
  BEGIN SELECT RAISE(ABORT, 'sessions are never overwritten'); END;
CREATE TRIGGER session_update BEFORE UPDATE OF id, participant, name, participant_number, protocol, display, environment,
    seed, program_version, started ON session
  BEGIN SELECT RAISE(ABORT, 'sessions are never overwritten'); END;
CREATE TRIGGER session_form BEFORE UPDATE OF form ON session WHEN OLD.form IS NOT NULL
  BEGIN SELECT RAISE(ABORT, 'forms are never overwritten'); END;
CREATE TRIGGER session_delete BEFORE DELETE ON session BEGIN SELECT RAISE(ABORT, 'sessions are never overwritten'); END;
CREATE TRIGGER participant_update BEFORE UPDATE ON participant
  BEGIN SELECT RAISE(ABORT, 'participants are never overwritten'); END;
CREATE TRIGGER participant_delete BEFORE DELETE ON participant
  BEGIN SELECT RAISE(ABORT, 'participants are never overwritten'); END;
CREATE TRIGGER protocol_update BEFORE UPDATE ON protocol BEGIN SELECT RAISE(ABORT, 'protocols are never overwritten'); END;
CREATE TRIGGER protocol_delete BEFORE DELETE ON protocol BEGIN SELECT RAISE(ABORT, 'protocols are never overwritten'); END;
CREATE TRIGGER display_update BEFORE UPDATE ON display BEGIN SELECT RAISE(ABORT, 'displays are never overwritten'); END;
CREATE TRIGGER display_delete BEFORE DELETE ON display BEGIN SELECT RAISE(ABORT, 'displays are never overwritten'); END;

CREATE TRIGGER block_once BEFORE INSERT ON block
  WHEN EXISTS (SELECT 1 FROM block WHERE session = NEW.session AND number = NEW.number)
  BEGIN SELECT RAISE(ABORT, 'blocks are never overwritten'); END;
CREATE TRIGGER note_once BEFORE INSERT ON note
  WHEN EXISTS (SELECT 1 FROM note WHERE session = NEW.session AND event = NEW.event)
  BEGIN SELECT RAISE(ABORT, 'notes are never overwritten'); END;
CREATE TRIGGER participant_once BEFORE INSERT ON participant
  WHEN EXISTS (SELECT 1 FROM participant WHERE code = NEW.code OR number = NEW.number)
  BEGIN SELECT RAISE(ABORT, 'participants are never overwritten'); END;
CREATE TRIGGER protocol_once BEFORE INSERT ON protocol WHEN EXISTS (SELECT 1 FROM protocol WHERE hash = NEW.hash)
  BEGIN SELECT RAISE(ABORT, 'protocols are never overwritten'); END;
CREATE TRIGGER display_once BEFORE INSERT ON display WHEN EXISTS (SELECT 1 FROM display WHERE hash = NEW.hash)
  BEGIN SELECT RAISE(ABORT, 'displays are never overwritten'); END;
CREATE TRIGGER prediction_once BEFORE INSERT ON prediction
  WHEN EXISTS (SELECT 1 FROM prediction WHERE id = NEW.id
               OR (stimulus_hash = NEW.stimulus_hash AND display_hash = NEW.display_hash AND width_px = NEW.width_px
                   AND height_px = NEW.height_px AND predictor = NEW.predictor AND settings_hash = NEW.settings_hash
                   AND program_version = NEW.program_version))
  BEGIN SELECT RAISE(ABORT, 'predictions are never overwritten'); END;
CREATE TRIGGER prediction_update BEFORE UPDATE ON prediction
  BEGIN SELECT RAISE(ABORT, 'predictions are never overwritten'); END;
CREATE TRIGGER prediction_delete BEFORE DELETE ON prediction
  BEGIN SELECT RAISE(ABORT, 'predictions are never overwritten'); END;
