// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/settings_table.h"
#include "experiments/store/store.h"

namespace limen::experiments {

/// A registered name with a complete set of values.
struct Configuration {
  std::string name;
  int version = 1;
  ParameterValues values;
};

struct Timing {
  int warmup = 8;             ///< frames rendered and discarded before each round
  int frames = 64;            ///< timed frames in all, shared evenly among the rounds
  int rounds = 3;             ///< interleaved rounds over the runs of a batch
  int batch = 8;              ///< runs whose rounds are interleaved
  bool firstPicture = false;  ///< also time the first picture, in a context of its own
  static const SettingsTable<Timing>& table();
};

/// Files that a run writes beside the store.
struct Artefacts {
  bool pictures = true;  ///< PNG of the product, the reference and the errors
  bool exr = false;      ///< the same as 32-bit float EXR
  static const SettingsTable<Artefacts>& table();
};

struct ImageSize {
  int width = 1024, height = 768;  ///< px; OpenGL 4.5 guarantees textures of 16,384 per side
  static const SettingsTable<ImageSize>& table();
};

/// One cell of the grid.
struct PlannedRun {
  std::string key;  ///< SHA-256 over everything that determines the result
  int position = 0;
  Configuration technique, scene;
  Configuration reference;  ///< empty name: none
  int widthPx = 0, heightPx = 0;
  Timing timing;
  Artefacts artefacts;
  std::vector<Configuration> metrics;
  std::string label;    ///< "pattern=regular_8, occluder=micropatch": what varies among this technique's runs
  std::string setting;  ///< "light_size=2, 640x480": what varies among the scene's runs and image sizes
  nlohmann::json parameters;  ///< as store::Run::parameters
};

/// The outcome of executing a run; the store's row without key and bookkeeping.
struct RunOutcome {
  std::string error;  ///< "" if the run succeeded
  nlohmann::json sceneFacts = nlohmann::json::object();
  std::vector<store::Measurement> measurements;
  std::vector<store::FrameTime> frameTimes;
  std::vector<store::Pass> passes;
  std::vector<store::Artefact> artefacts;
};

/// Executes runs. The runner hands it batches of runs that share scene and image size; their timed rounds are
/// interleaved. An error of one run is its outcome, never an exception; an exception means that the executor
/// itself cannot continue (no GL context). During long work it may call throwIfInterrupted()
/// (experiments/base/interrupt.h); runs not reported by then are measured by a later sweep.
class Executor {
 public:
  virtual ~Executor() = default;
  virtual const store::Environment& environment() const = 0;
  /// Calls `finished(index, outcome)` once for each run, as soon as that run is complete.
  virtual void execute(std::span<const PlannedRun> batch,
                       const std::function<void(size_t, RunOutcome)>& finished) = 0;
  /// A run of a later batch, so that its scene can be prepared during the work on earlier ones.
  virtual void announce(const PlannedRun&) {}
  /// Facts about the executor's own overhead, for the environment and the summary: {"overhead_share": 0.03,
  /// ...}.
  virtual nlohmann::json account() const { return nlohmann::json::object(); }
};

/// A device that sweeps can run on.
struct SweepDevice {
  std::string name;       ///< as stores name it; "": it cannot be used
  bool software = false;  ///< a CPU renders
  /// In a job of Slurm: whether it was given to the job, empty if that cannot be told; elsewhere true.
  std::optional<bool> assigned = true;
};

}  // namespace limen::experiments
