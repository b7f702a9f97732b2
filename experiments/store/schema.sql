-- Result store, schema version 1 (PRAGMA user_version). Times are UTC, ISO 8601.
-- The tables for studies (participant, session, ...) come with version 2: schema_study.sql; those that say what names
-- mean (quantity, parameter) with version 3: schema_descriptions.sql.

CREATE TABLE experiment (
  id INTEGER PRIMARY KEY,
  hash TEXT NOT NULL UNIQUE,          -- SHA-256 of the descriptor's text
  path TEXT NOT NULL,                 -- descriptor file as given
  title TEXT NOT NULL,
  question TEXT NOT NULL,
  source TEXT NOT NULL,
  features TEXT NOT NULL,             -- JSON array of ids
  descriptor TEXT NOT NULL,           -- the YAML text
  report TEXT NOT NULL,               -- JSON: {"x": "gpu_ms", "y": "rmse", "series": "technique", "panels": "scene"}
  created TEXT NOT NULL
);

CREATE TABLE environment (
  id INTEGER PRIMARY KEY,
  hash TEXT NOT NULL UNIQUE,          -- of `facts`
  device TEXT NOT NULL,               -- GL renderer and version: what times depend on
  software INTEGER NOT NULL,          -- 1: a software renderer made these times (a CPU)
  facts TEXT NOT NULL                 -- JSON: gpu, driver, cpu, cores, memory, os, compiler, build, libraries, commit, command
);

CREATE TABLE run (
  id INTEGER PRIMARY KEY,
  key TEXT NOT NULL,                  -- hash of everything that decides the result; machine-independent
  device TEXT NOT NULL,               -- environment.device: the same key may be measured on several
  status TEXT NOT NULL CHECK (status IN ('running', 'done', 'failed')),
  error TEXT NOT NULL DEFAULT '',
  technique TEXT NOT NULL,            -- registered name
  scene TEXT NOT NULL,                -- registered name
  label TEXT NOT NULL,                -- the parameters that vary in the experiment, for a reader
  parameters TEXT NOT NULL,           -- JSON: {"technique": {...}, "scene": {...}, "image": {...}, "reference": {...}, "timing": {...}, "metrics": [...]}
  scene_facts TEXT NOT NULL DEFAULT '{}',  -- JSON: {"content_hash", "triangles", "bounds": [[x,y,z],[x,y,z]], "remarks": [what the technique says], "series": {name: {"summary", "values": [...]}}}
  environment INTEGER REFERENCES environment(id),
  owner TEXT NOT NULL DEFAULT '',     -- host:pid:start of the process that holds a 'running' row
  started TEXT NOT NULL,
  finished TEXT NOT NULL DEFAULT '',
  UNIQUE (key, device)
);

-- Which experiments planned a run, and where in their order. Several experiments may share a run.
CREATE TABLE experiment_run (
  experiment INTEGER NOT NULL REFERENCES experiment(id) ON DELETE CASCADE,
  key TEXT NOT NULL,
  position INTEGER NOT NULL,
  technique TEXT NOT NULL,
  scene TEXT NOT NULL,
  label TEXT NOT NULL,
  PRIMARY KEY (experiment, key)
);

CREATE TABLE measurement (
  run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE,
  name TEXT NOT NULL,                 -- gpu_ms, rmse, micro_occluders_per_px, bytes_held, ...
  value REAL,                         -- NULL: not a number (the run says why)
  unit TEXT NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('time', 'error', 'counter', 'fact')),
  PRIMARY KEY (run, name)
);

CREATE TABLE frame_time (
  run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE,
  frame INTEGER NOT NULL,             -- 0..; rounds follow one another
  round INTEGER NOT NULL,
  pass TEXT NOT NULL,                 -- 'frame' is the whole frame on the GPU, 'wall' and 'cpu' the host's share; on a GPU passes are timed in other frames than these
  nanoseconds INTEGER NOT NULL,
  PRIMARY KEY (run, frame, pass)
);

CREATE TABLE pass (
  run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE,
  position INTEGER NOT NULL,          -- order within the frame
  name TEXT NOT NULL,
  bytes_held INTEGER NOT NULL,
  PRIMARY KEY (run, name)
);

CREATE TABLE artefact (
  run INTEGER NOT NULL REFERENCES run(id) ON DELETE CASCADE,
  kind TEXT NOT NULL,                 -- product_exr, product_png, reference_png, error_exr, error_png, flip_png, ...
  path TEXT NOT NULL,                 -- relative to the store's folder
  sha256 TEXT NOT NULL,
  PRIMARY KEY (run, kind)
);

-- Broken and kept expectations of an experiment, as judged when its sweep ended.
CREATE TABLE expectation (
  experiment INTEGER NOT NULL REFERENCES experiment(id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  text TEXT NOT NULL,                 -- as the descriptor states it
  held INTEGER NOT NULL,
  detail TEXT NOT NULL,               -- the run that broke it, with its value
  PRIMARY KEY (experiment, position)
);

CREATE INDEX run_key ON run(key);
