// SPDX-License-Identifier: BSD-3-Clause
// What GlExecutor keeps of the runs of a batch while it measures them.
#pragma once

#include <chrono>
#include <future>
#include <glm/vec2.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/executor.h"
#include "experiments/frame_timing.h"
#include "experiments/plan.h"
#include "experiments/product.h"
#include "experiments/scene_rendering.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {

/// Adds its lifetime to a total.
class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& total_;
  std::chrono::steady_clock::time_point start_;
};

/// A scene before it is on the GPU; building and hashing a large one can take longer than a run.
struct BuiltScene {
  scene::Scene scene;
  nlohmann::json facts;
};

/// A scene and its view as shared by all runs of a batch.
struct SharedScene {
  explicit SharedScene(BuiltScene built) : onGpu(std::move(built.scene)), facts(std::move(built.facts)) {}

  frame::SceneOnGpu onGpu;
  nlohmann::json facts;
  // For one image size:
  glm::ivec2 sizePx{0};
  std::shared_ptr<const ViewImages> view;  ///< shared with the threads that write pictures
  std::optional<ShownSurfaces> surfaces;   ///< made when a metric first needs them
};

/// What is computed from a product while the GPU works.
struct Afterwork {
  std::vector<store::Artefact> artefacts;
  std::string productHash;
};

/// One run of a batch in progress.
struct LiveRun {
  size_t index = 0;
  const PlannedRun* plan = nullptr;
  const techniques::TechniqueInfo* info = nullptr;
  std::unique_ptr<frame::Frame> frame;
  std::unique_ptr<techniques::Technique> technique;
  std::optional<FrameTiming> timing;
  std::vector<double> clocksMhz;  ///< of the GPU after each round, where it can be read
  std::future<Afterwork> afterwork;
  RunOutcome outcome;
};

}  // namespace limen::experiments
