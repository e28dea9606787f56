#include "cli/fleet/store/store.h"

namespace errmap::fleet {

const char* const kStoreMigrations[] = {
    R"sql(
CREATE TABLE runs (            -- one: the study that was merged last
  study TEXT PRIMARY KEY,      -- SHA-256 of the study file
  file TEXT NOT NULL,
  version TEXT NOT NULL,
  seed INTEGER NOT NULL,
  command_line TEXT NOT NULL,
  components INTEGER NOT NULL, -- that the study has
  missing INTEGER NOT NULL     -- of them without a summary
) WITHOUT ROWID;
CREATE TABLE components (
  name TEXT PRIMARY KEY,
  study TEXT NOT NULL REFERENCES runs(study),
  -- missing: not studied yet; gone: deployed, and no longer in the study
  status TEXT NOT NULL CHECK (status IN ('ok', 'failed', 'missing', 'gone')),
  why TEXT,                    -- it failed
  folder TEXT NOT NULL,        -- below the store
  data TEXT NOT NULL,          -- below the study file's folder
  sha256 TEXT NOT NULL,        -- of the data
  rows INTEGER NOT NULL,
  sessions INTEGER NOT NULL,
  target TEXT NOT NULL,
  unit TEXT NOT NULL,          -- of lengths in these tables
  shown_unit TEXT NOT NULL,    -- value * shown_scale is in this unit
  shown_scale REAL NOT NULL,
  goal REAL,
  fits_seconds REAL            -- of all its fits together
) WITHOUT ROWID;
CREATE TABLE fields (          -- of the data file's path
  component TEXT NOT NULL REFERENCES components(name) ON DELETE CASCADE,
  field TEXT NOT NULL,
  value TEXT NOT NULL,
  PRIMARY KEY (component, field)
) WITHOUT ROWID;
CREATE TABLE holdouts (
  component TEXT NOT NULL REFERENCES components(name) ON DELETE CASCADE,
  holdout TEXT NOT NULL,
  folds INTEGER NOT NULL,
  unit_of_analysis TEXT NOT NULL,
  units INTEGER NOT NULL,
  PRIMARY KEY (component, holdout)
) WITHOUT ROWID;
CREATE TABLE models (
  component TEXT NOT NULL REFERENCES components(name) ON DELETE CASCADE,
  model TEXT NOT NULL,         -- the SPEC
  kind TEXT NOT NULL,
  choice TEXT NOT NULL,        -- what it stands for in a verdict
  status TEXT NOT NULL,
  why TEXT,
  parameters INTEGER,
  fit_seconds REAL,            -- of the fit to all rows
  PRIMARY KEY (component, model)
) WITHOUT ROWID;
CREATE TABLE metrics (         -- of the rows held out
  component TEXT NOT NULL,
  model TEXT NOT NULL,
  holdout TEXT NOT NULL,
  n INTEGER NOT NULL,
  rmse REAL,
  sd REAL,
  mean REAL,
  mae REAL,
  range REAL,
  train_rmse REAL,
  ci95_low REAL,
  ci95_high REAL,
  tier INTEGER NOT NULL,       -- 1: none is better than chance would have it
  goal TEXT NOT NULL,          -- met, met after re-zeroing, not met, ...
  PRIMARY KEY (component, model, holdout),
  FOREIGN KEY (component, model) REFERENCES models ON DELETE CASCADE,
  FOREIGN KEY (component, holdout) REFERENCES holdouts ON DELETE CASCADE
) WITHOUT ROWID;
CREATE TABLE verdicts (
  component TEXT NOT NULL,
  holdout TEXT NOT NULL,
  choice TEXT NOT NULL,
  model TEXT NOT NULL,
  established INTEGER NOT NULL,
  confidence TEXT NOT NULL,
  PRIMARY KEY (component, holdout),
  FOREIGN KEY (component, holdout) REFERENCES holdouts ON DELETE CASCADE
) WITHOUT ROWID;
CREATE TABLE recommendations (
  component TEXT PRIMARY KEY REFERENCES components(name) ON DELETE CASCADE,
  choice TEXT NOT NULL,        -- polynomial, neural, blend, baseline, ...
  model TEXT NOT NULL,
  holdout TEXT NOT NULL,       -- that decided
  rmse REAL,
  ci95_low REAL,
  ci95_high REAL,
  uncompensated REAL,          -- RMSE there without a map
  constant REAL,               -- and with the best constant
  goal TEXT NOT NULL,
  established INTEGER NOT NULL,  -- that it is better than a baseline
  longest_memory REAL,         -- of a map that remembers; 0: of none
  zeroed INTEGER,              -- less the session's first row
  within_90 REAL,              -- promised half width for another unit
  within_95 REAL,
  extrapolated_share REAL,
  sentence TEXT NOT NULL
) WITHOUT ROWID;
CREATE TABLE sensors (         -- that the recommended map reads
  component TEXT NOT NULL REFERENCES components(name) ON DELETE CASCADE,
  sensor TEXT NOT NULL,
  PRIMARY KEY (component, sensor)
) WITHOUT ROWID;
CREATE TABLE maps (            -- the recommended ones
  component TEXT PRIMARY KEY REFERENCES components(name) ON DELETE CASCADE,
  sha256 TEXT NOT NULL,        -- of the file, unpacked
  bytes INTEGER NOT NULL
) WITHOUT ROWID;
CREATE INDEX metrics_by_model ON metrics(model, holdout);
CREATE INDEX fields_by_value ON fields(field, value);
CREATE VIEW fleet AS           -- a line per component, in the unit shown
SELECT c.name, c.status, c.why, r.choice, r.model, r.holdout,
       r.uncompensated * c.shown_scale AS before,
       r.rmse * c.shown_scale AS after,
       r.within_95 * c.shown_scale AS within_95,
       c.goal * c.shown_scale AS goal, c.shown_unit AS unit,
       r.goal AS goal_standing, r.established, r.longest_memory
FROM components c LEFT JOIN recommendations r ON r.component = c.name;
)sql",
    R"sql(
CREATE TABLE deployments (     -- which map is on which machine
  id INTEGER PRIMARY KEY,
  component TEXT NOT NULL REFERENCES components(name),
  since TEXT NOT NULL,         -- UTC, ISO 8601
  until TEXT,                  -- NULL: to this day
  map TEXT NOT NULL,           -- SHA-256 of maps/SHA-256.json
  model TEXT NOT NULL,
  relations TEXT,              -- likewise, how its sensors go together
  promised REAL,               -- RMSE on a unit never seen
  within_95 REAL               -- half width
);
CREATE TABLE checks (          -- sessions measured since, by errmap watch
  deployment INTEGER NOT NULL REFERENCES deployments(id),
  rows_sha256 TEXT NOT NULL,   -- of what was measured: the same is kept once
  number INTEGER NOT NULL,     -- order
  session TEXT NOT NULL,
  file TEXT NOT NULL,
  at TEXT NOT NULL,            -- of the check, UTC
  rows INTEGER NOT NULL,
  offset REAL NOT NULL,        -- mean of target less prediction
  mean_square REAL NOT NULL,   -- of the same
  outside_share REAL NOT NULL, -- of the rows, unlike the trained states
  sensor TEXT NOT NULL,        -- that goes with the others least
  sensor_shift REAL,
  p_sensor REAL,
  p_map REAL,                  -- that the map is as promised
  status TEXT NOT NULL,
  PRIMARY KEY (deployment, rows_sha256)
) WITHOUT ROWID;
CREATE VIEW watched AS         -- the newest session of each map in use
SELECT d.component, d.since, d.model, c.session, c.status,
       d.promised * k.shown_scale AS promised,
       sqrt(c.mean_square) * k.shown_scale AS found,
       c.offset * k.shown_scale AS offset, k.shown_unit AS unit,
       c.p_map, c.sensor, c.sensor_shift, c.p_sensor
FROM deployments d JOIN components k ON k.name = d.component
LEFT JOIN checks c ON c.deployment = d.id AND c.number =
  (SELECT max(number) FROM checks WHERE deployment = d.id)
WHERE d.until IS NULL;
)sql",
    R"sql(
CREATE INDEX deployments_in_use ON deployments(component) WHERE until IS NULL;
ALTER TABLE checks ADD COLUMN begins_sha256 TEXT;  -- of the first row
-- What the map's held-out sessions show of such rows: RMS of their means, mean
-- of their mean squares, mean and sd of the logarithms of these.
ALTER TABLE checks ADD COLUMN expected_offset REAL;
ALTER TABLE checks ADD COLUMN expected_square REAL;
ALTER TABLE checks ADD COLUMN expected_log_square REAL;
ALTER TABLE checks ADD COLUMN expected_log_spread REAL;
)sql",
};

}  // namespace errmap::fleet
