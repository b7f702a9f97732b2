// SPDX-License-Identifier: BSD-3-Clause
#include "tests/analysis/synthetic_store.h"

#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/image.h"

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

// A soft edge whose noise and shift grow with the error. Wide, as a page must find room for it beside others;
// not high, since of hundreds of pictures PNG takes most of a test's time.
Image picture(int seed, double error, int scene) {
  Image image(400, 100, 3);
  std::mt19937 random(static_cast<unsigned>(seed));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double edge = std::tanh((x - 200 + 40 * std::sin(y * 0.02 * (scene + 1)) + 60 * error) / 30.0);
      const double noise = error * (static_cast<double>(random() % 1000) / 500.0 - 1.0);
      const double light = std::clamp(0.5 + 0.4 * edge + noise, 0.0, 1.0);
      image.at(x, y, 0) = static_cast<float>(light);
      image.at(x, y, 1) = static_cast<float>(light * 0.95);
      image.at(x, y, 2) = static_cast<float>(light * 0.85);
    }
  return image;
}

void addPicture(store::Run& run, const std::string& folder, const std::string& kind, const Image& image) {
  const std::string path = "artefacts/" + run.key + "_" + kind + ".png";
  fs::create_directories(fs::path(folder) / "artefacts");
  writePng((fs::path(folder) / path).string(), image);
  run.artefacts.push_back({kind, path, sha256File((fs::path(folder) / path).string())});
}

struct Kind {
  const char* name;
  double costMs, costPower, error, errorPower;
  const char* secondName;
  std::vector<std::string> second;
};

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "limen_analysis_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw Error("no temporary folder");
  folder_ = pattern;
}

TemporaryFolder::~TemporaryFolder() { fs::remove_all(folder_); }

store::Run makeRun(const std::string& technique, const std::string& scene, int samples,
                   const std::vector<double>& ms, double rmse) {
  store::Run run;
  run.key = sha256(technique + "|" + scene + "|" + std::to_string(samples));
  run.device = "Test GPU";
  run.status = "done";
  run.technique = technique;
  run.scene = scene;
  run.label = "samples=" + std::to_string(samples);
  run.parameters = {{"technique", {{"samples", samples}, {"bias", 0.01}}},
                    {"scene", {{"size", 1.0}}},
                    {"image", {{"width", 400}, {"height", 300}}}};
  const auto perRound = std::max<size_t>(1, ms.size() / 3);
  for (size_t frame = 0; frame < ms.size(); ++frame)
    run.frameTimes.push_back({static_cast<int>(frame), static_cast<int>(frame / perRound), "frame",
                              std::llround(ms[frame] * 1e6)});
  if (!ms.empty()) run.measurements.push_back({"gpu_ms", medianOf(ms), "ms", "time"});
  run.measurements.push_back({"rmse", rmse, "", "error"});
  return run;
}

int64_t writeExperiment(store::Store& store, store::Experiment experiment, std::vector<store::Run> runs,
                        const std::vector<store::PlanEntry>& missing, const store::Environment& environment,
                        const store::Descriptions& descriptions) {
  if (experiment.hash.empty()) experiment.hash = sha256(experiment.title);
  if (experiment.report.empty())
    experiment.report = {{"x", "gpu_ms"}, {"y", "rmse"}, {"series", "technique"}, {"panels", "scene"}};
  std::vector<store::PlanEntry> plan;
  for (const store::Run& run : runs) plan.push_back({run.key, run.technique, run.scene, run.label});
  plan.insert(plan.end(), missing.begin(), missing.end());
  const int64_t id = store.putExperiment(experiment, plan, descriptions);
  const int64_t environmentId = store.putEnvironment(environment);
  for (store::Run& run : runs) {
    run.environment = environmentId;
    if (store.claim(run) != store::Store::Claim::Claimed) throw Error("not claimed: " + run.key);
    store.finish(run);
  }
  return id;
}

size_t writeLargeExperiment(const std::string& storePath, bool software) {
  const std::vector<Kind> kinds = {
      {"soft_shadows/pcss", 0.25, 0.35, 0.09, -0.12, "search_radius", {"0.02", "0.05"}},
      {"soft_shadows/bitmask", 0.45, 0.60, 0.11, -0.70, "occluder", {"micropatch", "microquad"}},
      {"soft_shadows/bitmask_multilayer", 0.9, 0.62, 0.05, -0.85, "occluder", {"micropatch", "microquad"}},
      {"soft_shadows/backprojection", 0.7, 0.50, 0.16, -0.40, "", {}},
      {"soft_shadows/ray_traced", 0.5, 0.97, 0.35, -0.50, "pattern", {"regular", "jittered"}},
      {"soft_shadows/sampled_light", 0.3, 0.99, 0.40, -0.52, "", {}}};
  const std::vector<std::string> scenes = {"grid_over_plane", "forest_of_poles", "mesh"};
  const std::string folder = fs::absolute(storePath).parent_path().string();

  std::mt19937 random(5);
  const auto uniform = [&] { return static_cast<double>(random() % 10000) / 10000.0; };
  std::vector<store::Run> runs;
  for (size_t scene = 0; scene < scenes.size(); ++scene)
    for (const Kind& kind : kinds)
      for (int samples = 4; samples <= 256; samples *= 4)
        for (size_t variant = 0; variant < std::max<size_t>(1, kind.second.size()); ++variant) {
          const double hard = 1.0 + static_cast<double>(scene);
          const double cost = kind.costMs * hard * std::pow(samples, kind.costPower) * (1.0 + 0.3 * variant);
          const double error = kind.error * hard * std::pow(samples, kind.errorPower) *
                               (0.8 + 0.4 * uniform()) / (1.0 + 0.6 * variant);
          std::vector<double> ms;
          for (int frame = 0; frame < 48; ++frame)
            ms.push_back(cost *
                         (1.0 + 0.02 * (frame / 16) + 0.06 * uniform() + (uniform() > 0.96 ? 0.4 : 0.0)));
          store::Run run = makeRun(kind.name, scenes[scene], samples, ms, error);
          if (!kind.second.empty()) {
            run.parameters["technique"][kind.secondName] = kind.second[variant];
            run.label += std::string(", ") + kind.secondName + "=" + kind.second[variant];
          }
          run.key = sha256(run.technique + run.scene + run.label);
          run.measurements.push_back({"cpu_ms", 0.05, "ms", "time"});
          run.measurements.push_back({"flip", error * 0.7, "", "error"});
          run.measurements.push_back({"error_png_white", 0.25, "", "fact"});
          run.measurements.push_back({"bytes_held", 4e6 * hard, "byte", "fact"});
          if (run.technique.find("bitmask") != std::string::npos)
            run.measurements.push_back({"micro_occluders_per_px", samples * hard * 1.7, "1/px", "counter"});
          const std::vector<std::pair<std::string, double>> shares = {
              {"gbuffer", 0.15}, {"shadow_map", 0.2}, {"shade", 0.6}};
          for (const auto& [pass, share] : shares) {
            run.passes.push_back({pass, pass == "shade" ? 0 : 4'000'000});
            for (size_t frame = 0; frame < ms.size(); ++frame)
              run.frameTimes.push_back({static_cast<int>(frame), static_cast<int>(frame / 16), pass,
                                        std::llround(ms[frame] * share * 1e6)});
          }
          const Image reference = picture(1, 0.0, static_cast<int>(scene));
          const Image product = picture(samples, std::min(0.5, error), static_cast<int>(scene));
          Image difference(reference.width, reference.height, 1);
          for (int y = 0; y < reference.height; ++y)
            for (int x = 0; x < reference.width; ++x)
              difference.at(x, y) = std::min(1.0F, std::abs(product.at(x, y) - reference.at(x, y)) / 0.25F);
          addPicture(run, folder, "product_png", product);
          addPicture(run, folder, "reference_png", reference);
          addPicture(run, folder, "error_png", difference);
          runs.push_back(std::move(run));
        }

  store::Experiment experiment;
  experiment.title = "Soft shadows: six techniques, samples against error";
  experiment.question = "Which technique reaches an RMSE of 0.01 at the least cost?";
  experiment.source = "section 4.2";
  experiment.path = "descriptors/soft_shadows/samples.yaml";
  experiment.descriptor = "title: Soft shadows\nscenes:\n  - {name: grid_over_plane}\n";
  experiment.features = {"SS-12", "SS-13", "SS-20"};
  store::Store store(storePath, store::Access::ReadWrite);
  const size_t count = runs.size();
  const nlohmann::json facts = {
      {"command", "limen-sweep descriptors/soft_shadows/samples.yaml --store s.sqlite"},
      {"cpu", "Example CPU, 8 cores"},
      {"libraries", {{"mesa", "22.3"}, {"glm", "0.9.9"}}},
      {"commit", "0123abcd"}};
  const int64_t id = writeExperiment(store, experiment, std::move(runs), {},
                                     {software ? "llvmpipe (LLVM 15)" : "Example GPU 4090", software, facts});
  store.putExpectations(id, {{"rmse of soft_shadows/bitmask below 0.2", true, "largest 0.12"}});
  return count;
}

}  // namespace limen::analysis
