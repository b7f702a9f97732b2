-- Schema version 3: the store says what its names mean, so that no reader has to guess. Both tables belong to an
-- experiment and are written with its plan. Experiments of older stores have no rows here.

-- Every name that the experiment's runs may have in table `measurement`.
CREATE TABLE quantity (
  experiment INTEGER NOT NULL REFERENCES experiment(id) ON DELETE CASCADE,
  name TEXT NOT NULL,                 -- measurement.name
  title TEXT NOT NULL,                -- as an axis label, without the unit: "Micro-occluders per pixel"
  unit TEXT NOT NULL,                 -- "ms", "byte"; '' for pure numbers
  direction TEXT NOT NULL CHECK (direction IN ('lower', 'higher', 'neither')),  -- which values are better
  kind TEXT NOT NULL CHECK (kind IN ('time', 'error', 'counter', 'fact')),
  pass TEXT NOT NULL,                 -- frame_time.pass whose median it is; '': none
  source TEXT NOT NULL,               -- thesis section or paper; '' for the bench's own
  PRIMARY KEY (experiment, name)
);

-- Every parameter that the experiment's scenes, techniques, reference, metrics and images declare. The value of one
-- stands in run.parameters under its subject and path: parameters -> 'technique' -> 'budget.rim'.
CREATE TABLE parameter (
  experiment INTEGER NOT NULL REFERENCES experiment(id) ON DELETE CASCADE,
  subject TEXT NOT NULL CHECK (subject IN ('technique', 'scene', 'reference', 'metric', 'image')),
  owner TEXT NOT NULL,                -- registered name of the technique, scene or metric; '' for images
  path TEXT NOT NULL,                 -- names joined by dots: "budget.rim"
  exists_when TEXT NOT NULL,          -- JSON: choices that it belongs to, {"budget": "radial"}; {}: always there
  title TEXT NOT NULL,                -- as an axis label, without the unit: "Budget: rim"
  unit TEXT NOT NULL,
  type TEXT NOT NULL,                 -- 'number', 'whole number', 'choice', ...
  default_value TEXT NOT NULL,        -- as text; '' for a file that must be given
  description TEXT NOT NULL,
  source TEXT NOT NULL,
  PRIMARY KEY (experiment, subject, owner, path, exists_when)
);
