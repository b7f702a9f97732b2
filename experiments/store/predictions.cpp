// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/store/predictions.h"

#include <sqlite3.h>

#include "experiments/base/hash.h"
#include "experiments/store/session_rows.h"

namespace limen::store {
namespace {

bool isThere(sqlite3* database, const StudyPrediction& key) {
  Statement find(database,
                 "SELECT 1 FROM prediction WHERE stimulus_hash = ? AND display_hash = ? AND width_px = ? AND "
                 "height_px = ? AND predictor = ? AND settings_hash = ? AND program_version = ?");
  return find
      .bind(key.stimulusHash, key.displayHash, key.widthPx, key.heightPx, key.predictor,
            settingsHash(key.settings), key.programVersion)
      .step();
}

}  // namespace

std::string settingsHash(const nlohmann::json& settings) { return sha256(jsonText(settings)); }

std::string clipName(const std::string& stimulusHash, const std::string& displayHash, int widthPx,
                     int heightPx) {
  const std::string text =
      stimulusHash + "\n" + displayHash + "\n" + std::to_string(widthPx) + "x" + std::to_string(heightPx);
  return "clip_" + sha256(text).substr(0, 16);
}

PredictionLog::PredictionLog(const std::string& path)
    : database_(openDatabase(path, false, 1, Contents::Sessions)) {}

PredictionLog::~PredictionLog() { sqlite3_close(database_); }

bool PredictionLog::has(const StudyPrediction& key) const { return isThere(database_, key); }

bool PredictionLog::add(const StudyPrediction& prediction, const StudyDisplay& display) {
  Transaction transaction(database_, Transaction::Mode::Write);
  if (isThere(database_, prediction)) return false;
  Statement known(database_, "SELECT 1 FROM display WHERE hash = ?");
  if (!known.bind(display.hash).step())
    execute(database_, "INSERT INTO display (hash, name, profile, calibration) VALUES (?, ?, ?, ?)",
            display.hash, display.name, display.profile, jsonText(display.calibration));
  execute(database_,
          "INSERT INTO prediction (stimulus_hash, display_hash, width_px, height_px, predictor, "
          "settings_hash, settings, program_version, created, figures) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          prediction.stimulusHash, prediction.displayHash, prediction.widthPx, prediction.heightPx,
          prediction.predictor, settingsHash(prediction.settings), jsonText(prediction.settings),
          prediction.programVersion, prediction.created, jsonText(prediction.figures));
  transaction.commit();
  return true;
}

std::vector<StudyPrediction> readPredictions(const std::string& path) {
  struct Closer {
    sqlite3* database;
    ~Closer() { sqlite3_close(database); }
  } const open{openDatabase(path, true, 2)};
  Statement row(open.database,
                "SELECT id, stimulus_hash, display_hash, width_px, height_px, predictor, settings, "
                "program_version, created, figures FROM prediction ORDER BY id");
  std::vector<StudyPrediction> out;
  while (row.step())
    out.push_back({row.integer(0), row.text(1), row.text(2), row.countingNumber(3), row.countingNumber(4),
                   row.text(5), parseJson(row, 6, JsonIs::Object), row.text(7), row.text(8),
                   parseJson(row, 9, JsonIs::Object)});
  return out;
}

}  // namespace limen::store
