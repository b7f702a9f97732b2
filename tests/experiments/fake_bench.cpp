// SPDX-License-Identifier: BSD-3-Clause
#include "tests/experiments/fake_bench.h"

#include <signal.h>

#include <chrono>
#include <thread>

#include "experiments/base/hash.h"
#include "experiments/base/interrupt.h"
#include "tests/experiments/base/declare.h"

namespace limen::experiments {
namespace {

CatalogueEntry entry(int version, std::string summary, std::vector<Parameter> parameters) {
  CatalogueEntry out;
  out.version = version;
  out.summary = std::move(summary);
  out.source = "Test 2024, section 1";
  out.parameters = std::move(parameters);
  return out;
}

CatalogueEntry technique(int version, std::string summary, std::string product,
                         std::vector<Parameter> parameters) {
  parameters.push_back(realParameter("sleep_ms", 0.0, 0.0, 10000.0, "ms", "Time that a run takes"));
  parameters.push_back(booleanParameter("fail", false, "The run fails"));
  parameters.push_back(booleanParameter("die", false, "The run ends its process"));
  CatalogueEntry out = entry(version, std::move(summary), std::move(parameters));
  out.product = std::move(product);
  return out;
}

}  // namespace

Catalogue fakeCatalogue() {
  Catalogue out;
  out.scenes["grid"] = entry(1, "Bars over a plane",
                             {realParameter("light_size", 1.0, 0.001, 100.0, "m", "Side of the light"),
                              integerParameter("bars", 8, 1, 1000, "", "Number of bars")});
  out.scenes["mesh"] = entry(3, "A mesh on a plane", {fileParameter("file", "Mesh file")});
  out.techniques["soft/bitmask"] = technique(
      2, "Occlusion bitmask", "visibility",
      {integerParameter("samples", 64, 1, 100000, "", "Light samples"),
       choiceParameter("pattern", "regular_8", {"regular_8", "regular_16", "jittered_16"}, "Sample pattern"),
       realParameter("bias", 0.001, 0.0, 0.1, "m", "Depth bias")});
  out.techniques["soft/bitmask"].needs = {"rectangular_light"};
  out.techniques["soft/pcss"] = technique(1, "Filtered shadow map", "visibility",
                                          {realParameter("radius", 0.05, 0.0, 1.0, "m", "Search radius")});
  out.techniques["soft/pcss"].counters = {"fetches_per_px"};
  out.techniques["soft/sampled"] = technique(
      1, "Sampled light", "visibility", {integerParameter("samples", 1024, 1, 1048576, "", "Light samples")});
  out.techniques["soft/sampled"].reference = true;
  out.techniques["colour/lambert"] = technique(1, "Diffuse shading", "colour", {});
  out.metrics["rmse"] = entry(1, "Root mean square error", {});
  out.metrics["largest_error"] = entry(1, "Largest error", {});
  out.metrics["flip"] =
      entry(1, "Perceived difference", {realParameter("ppd", 67.0, 1.0, 500.0, "px/deg", "Resolution")});
  out.metrics["crack_count"] = entry(1, "Cracks", {});
  out.metrics["crack_count"].needsReference = false;
  for (auto& [name, metric] : out.metrics)
    metric.quantity = {name, "", "", Direction::LowerIsBetter, metric.source};
  return out;
}

FakeExecutor::FakeExecutor(std::string device) {
  environment_.device = std::move(device);
  environment_.software = true;
  environment_.facts = {{"gpu", environment_.device}};
}

double fakeRmse(const PlannedRun& run) {
  if (run.technique.name == "soft/bitmask")
    return 1.0 / static_cast<double>(integerOf(run.technique.values, "samples"));
  return run.technique.values.has("radius") ? realOf(run.technique.values, "radius") : 0.5;
}

void FakeExecutor::execute(std::span<const PlannedRun> batch,
                           const std::function<void(size_t, RunOutcome)>& finished) {
  batchSizes.push_back(batch.size());
  for (size_t i = 0; i < batch.size(); ++i) {
    throwIfInterrupted();
    const PlannedRun& run = batch[i];
    if (before) before(run);
    std::this_thread::sleep_for(
        std::chrono::duration<double, std::milli>(realOf(run.technique.values, "sleep_ms")));
    executed.push_back(run.key);
    RunOutcome outcome;
    if (booleanOf(run.technique.values, "die")) raise(SIGKILL);
    outcome.sceneFacts = {{"triangles", 12}, {"product_hash", sha256("product of " + run.key)}};
    if (booleanOf(run.technique.values, "fail")) {
      outcome.error = "asked to fail";
    } else {
      const double samples = run.technique.values.has("samples")
                                 ? static_cast<double>(integerOf(run.technique.values, "samples"))
                                 : 10.0;
      outcome.measurements = {{"gpu_ms", samples / 10.0, "ms", "time"},
                              {"rmse", fakeRmse(run), "", "error"},
                              {"crack_count", 0.0, "", "error"}};
      for (int frame = 0; frame < 4; ++frame)
        outcome.frameTimes.push_back({frame, frame / 2, "frame", 1000 * (frame + 1)});
      outcome.passes = {{"mask", 4096}};
    }
    finished(i, std::move(outcome));
  }
}

std::string validDescriptor() {
  return "title: Bitmask against a filtered map\n"
         "question: Which is nearer to the sampled light?\n"
         "source: Test 2024, section 1\n"
         "scenes:\n"
         "  - {name: grid, light_size: [0.5, 1]}\n"
         "techniques:\n"
         "  - {name: soft/bitmask, samples: [8, 16, 32]}\n"
         "  - {name: soft/pcss, radius: [0.02, 0.05]}\n"
         "reference: {name: soft/sampled, samples: 256}\n"
         "image: {width: 64, height: 48}\n"
         "timing: {warmup: 1, frames: 4, rounds: 2}\n"
         "metrics: [rmse, crack_count]\n"
         "report: {x: gpu_ms, y: rmse, series: technique, panels: scene}\n";
}

}  // namespace limen::experiments
