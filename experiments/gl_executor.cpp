// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/gl_executor.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <map>
#include <new>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/interrupt.h"
#include "experiments/first_picture.h"
#include "experiments/frame_path.h"
#include "experiments/frame_timing.h"
#include "experiments/gl_devices.h"
#include "experiments/gpu_clock.h"
#include "experiments/live_run.h"
#include "experiments/measured_quantities.h"
#include "experiments/plan.h"
#include "experiments/product.h"
#include "experiments/product_evaluation.h"
#include "experiments/reference_cache.h"
#include "experiments/scene_rendering.h"
#include "perception/metrics/error_map.h"
#include "perception/metrics/metric_gpu.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {
namespace {

using std::chrono::steady_clock;

/// Slow techniques get fewer timed frames than asked for: a run's timing ends after this.
constexpr double kMaxTimingSeconds = 8.0;

BuiltScene build(const Configuration& choice) {
  BuiltScene out{scene::buildScene(choice.name, choice.values), {}};
  out.facts = sceneFacts(out.scene);
  return out;
}

std::string keyOf(const Configuration& scene) { return scene.name + scene.values.toJson().dump(); }

store::Measurement measurementOf(const techniques::Counter& counter, const techniques::TechniqueInfo& info) {
  const auto declared = std::find_if(info.counters.begin(), info.counters.end(),
                                     [&](const Quantity& each) { return each.name == counter.name; });
  if (declared == info.counters.end())
    throw std::logic_error("technique '" + info.name + "' counts '" + counter.name +
                           "', which it does not declare");
  return {counter.name, counter.value, declared->unit,
          declared->direction == Direction::Neither ? "fact" : "counter"};
}

class GlExecutor : public Executor {
 public:
  GlExecutor(const std::string& folder, const std::string& references)
      : folder_(folder),
        context_(takeContext()),
        metricGpu_(*context_),
        clock_(*context_),
        references_(references) {
    const gl::DeviceInfo& device = context_->device();
    environment_.device = device.line();
    environment_.software = device.software;
    environment_.facts["gpu"] = {{"vendor", device.vendor},
                                 {"renderer", device.renderer},
                                 {"version", device.version},
                                 {"platform", device.platform},
                                 {"software", device.software}};
    environment_.facts["gpu_candidates"] = gl::headlessCandidates();
  }

  const store::Environment& environment() const override { return environment_; }

  void execute(std::span<const PlannedRun> batch,
               const std::function<void(size_t, RunOutcome)>& finished) override {
    const Stopwatch total(seconds_["total"]);
    std::vector<LiveRun> live;
    for (size_t i = 0; i < batch.size(); ++i) {
      throwIfInterrupted();
      LiveRun run;
      run.index = i;
      run.plan = &batch[i];
      attempt(run, [&] { begin(run); });
      if (run.outcome.error.empty())
        live.push_back(std::move(run));
      else
        finish(run, finished);
    }
    const int rounds = batch.empty() ? 0 : batch[0].timing.rounds;
    for (int round = 0; round < rounds; ++round)
      for (LiveRun& run : live) {
        throwIfInterrupted();
        if (run.outcome.error.empty()) attempt(run, [&] { time(run, round, rounds); });
        if (round + 1 == rounds) finish(run, finished);
      }
  }

  void announce(const PlannedRun& next) override {
    const std::string key = keyOf(next.scene);
    // With a software renderer, the CPU must do nothing else while frames are timed.
    if (environment_.software || key == sceneKey_ || key == nextKey_) return;
    nextKey_ = key;
    next_ = std::async(std::launch::async, [scene = next.scene] { return build(scene); });
  }

  nlohmann::json account() const override {
    nlohmann::json out;
    double accounted = 0.0;
    for (const auto& [name, seconds] : seconds_) {
      out[name + "_s"] = seconds;
      if (name == "rendering" || name == "metrics" || name == "references") accounted += seconds;
    }
    const auto total = seconds_.find("total");
    if (total != seconds_.end() && total->second > 0.0)
      out["overhead_share"] = 1.0 - accounted / total->second;
    return out;
  }

 private:
  /// What a run throws is recorded as its error; the others continue.
  template <class Work>
  void attempt(LiveRun& run, Work work) {
    try {
      work();
      context_->checkDebugMessages();
    } catch (const std::bad_alloc&) {
      run.outcome.error = "not enough memory to measure " + describe(*run.plan);
      context_->takeDebugMessages();
    } catch (const std::exception& error) {
      run.outcome.error = error.what();
      context_->takeDebugMessages();
    }
  }

  void finish(LiveRun& run, const std::function<void(size_t, RunOutcome)>& finished) {
    attempt(run, [&] {
      if (run.afterwork.valid()) {
        const Stopwatch watch(seconds_["artefacts"]);
        Afterwork done = run.afterwork.get();
        run.outcome.artefacts = std::move(done.artefacts);
        run.outcome.sceneFacts["product_hash"] = std::move(done.productHash);
      }
    });
    {
      const Stopwatch watch(seconds_["rendering"]);  // releasing memory, as allocating it
      run.technique.reset();
      run.frame.reset();
    }
    const Stopwatch watch(seconds_["storing"]);
    finished(run.index, std::move(run.outcome));
  }

  SharedScene& sceneOf(const PlannedRun& run) {
    const std::string key = keyOf(run.scene);
    if (key != sceneKey_) {
      const Stopwatch watch(seconds_["scenes"]);
      sceneKey_.clear();
      scene_.reset();
      const bool announced = key == nextKey_;
      if (announced) nextKey_.clear();
      scene_ = std::make_unique<SharedScene>(announced ? next_.get() : build(run.scene));
      sceneKey_ = key;
    }
    const glm::ivec2 sizePx(run.widthPx, run.heightPx);
    if (scene_->sizePx != sizePx) {
      const Stopwatch watch(seconds_["rendering"]);
      scene_->view = std::make_shared<const ViewImages>(viewImages(*context_, scene_->onGpu, sizePx));
      scene_->surfaces.reset();
      scene_->sizePx = sizePx;
    }
    return *scene_;
  }

  /// Prepares a run, renders it once and evaluates the product.
  void begin(LiveRun& run) {
    const PlannedRun& plan = *run.plan;
    run.info = &techniques::TechniqueRegistry::instance().get(plan.technique.name);
    SharedScene& on = sceneOf(plan);
    run.outcome.sceneFacts = on.facts;
    requireTraits(*run.info, on.onGpu.scene);
    if (plan.timing.firstPicture) timeFirst(run, on);
    prepare(run, on);
    addRemarks(run.technique->remarks(), run.outcome.sceneFacts);
    Image product;
    std::vector<techniques::Counter> counters;
    {
      const Stopwatch watch(seconds_["rendering"]);
      product = run.technique->product().read();
      counters = run.technique->count(*run.frame);
      for (const techniques::Series& series : run.technique->series())
        run.outcome.sceneFacts["series"][series.name] = {{"summary", series.summary},
                                                         {"values", series.values}};
    }
    std::shared_ptr<const Image> reference;
    std::optional<gl::Texture> referenceTexture;
    if (!plan.reference.name.empty()) {
      const Stopwatch watch(seconds_["references"]);
      const Reference found = referenceFor(plan, on, run.technique->product().sizePx());
      reference = found.image;
      if (!found.remarks.empty()) run.outcome.sceneFacts["reference_remarks"] = found.remarks;
      referenceTexture.emplace(run.technique->product().format(), run.technique->product().sizePx());
      referenceTexture->write(*reference);
    }
    MetricPictures shown;
    {
      const Stopwatch watch(seconds_["metrics"]);
      perception::ComparisonInput evaluated{&run.technique->product(),
                                            referenceTexture ? &*referenceTexture : nullptr,
                                            &product,
                                            reference.get(),
                                            evaluatedEverywhere(run.info->product) ? nullptr : &on.view->mask,
                                            &metricGpu_};
      if (!on.view->mirrors.data.empty()) evaluated.mirrors = &on.view->mirrors;
      evaluated.depicts = depicts(run.info->product);
      if (const ShownSurfaces* surfaces = surfacesFor(plan, on)) evaluated.surfaces = &surfaces->textures();
      const perception::PathRenderer path = [&](const perception::PathRequest& request,
                                                const perception::PathVisitor& visit) {
        FramePath along(*context_, on.onGpu, on.sizePx, plan, references_,
                        referenceIdentity(plan, on).dump());
        along.render(request, visit);
        addRemarks(along.remarks(), run.outcome.sceneFacts);
      };
      evaluated.path = &path;
      std::shared_ptr<const surfaces::TessellatedSurface> tessellation;
      if (needsTessellation(plan)) tessellation = run.technique->tessellation(*run.frame);
      evaluated.tessellation = tessellation.get();
      evaluated.patches = &on.onGpu.scene.surfaces;
      evaluated.wantsMap = plan.artefacts.pictures || plan.artefacts.exr;
      evaluated.wantsPictures = plan.artefacts.pictures;
      evaluated.wantsLight = plan.artefacts.exr;
      for (store::Measurement& measurement : evaluate(plan, evaluated, shown))
        run.outcome.measurements.push_back(std::move(measurement));
      countNonFinite(product, run.outcome);
    }
    for (const techniques::Counter& counter : counters)
      run.outcome.measurements.push_back(measurementOf(counter, *run.info));
    if (reference && plan.artefacts.pictures)
      run.outcome.measurements.push_back(measured("error_png_white", kErrorScale));
    for (const auto& [name, map] : shown.maps) {
      if (!plan.artefacts.pictures) break;
      if (name == "relative_error")
        run.outcome.measurements.push_back(measured("relative_error_png_white", kErrorScale));
      if (name == "jnd" || name == "jnd_change")
        run.outcome.measurements.push_back(measured(name + "_png_white", kJndPictureWhite));
    }
    if (plan.artefacts.pictures && run.info->product == techniques::ProductKind::Threshold) {
      run.outcome.measurements.push_back(measured("threshold_png_black", perception::kThresholdPictureBlack));
      run.outcome.measurements.push_back(measured("threshold_png_white", perception::kThresholdPictureWhite));
    }
    // In the product's unit.
    if (plan.artefacts.pictures && run.info->product == techniques::ProductKind::JndMap)
      run.outcome.measurements.push_back({"product_png_white", kJndPictureWhite, "JND", "fact"});
    if (plan.artefacts.pictures && run.info->product == techniques::ProductKind::VisibilityChange)
      run.outcome.measurements.push_back(measured("product_png_white", kErrorScale));
    startAfterwork(run, on, std::move(product), reference, std::move(shown));
    run.timing.emplace(plan.timing,
                       environment_.software || run.info->onCpu ? gl::Clock::Wall : gl::Clock::Gpu);
  }

  /// Those that are not there yet.
  static void addRemarks(const std::vector<std::string>& remarks, nlohmann::json& facts) {
    for (const std::string& remark : remarks)
      if (nlohmann::json& all = facts["remarks"]; std::find(all.begin(), all.end(), remark) == all.end())
        all.push_back(remark);
  }

  static bool needsTessellation(const PlannedRun& plan) {
    return std::any_of(plan.metrics.begin(), plan.metrics.end(), [](const Configuration& metric) {
      return perception::MetricRegistry::instance().get(metric.name).needsTessellation;
    });
  }

  /// Null if no metric of the run needs them.
  const ShownSurfaces* surfacesFor(const PlannedRun& plan, SharedScene& on) {
    const bool needed =
        std::any_of(plan.metrics.begin(), plan.metrics.end(), [](const Configuration& metric) {
          return perception::MetricRegistry::instance().get(metric.name).needsSurfaces;
        });
    if (!needed) return nullptr;
    if (!on.surfaces) on.surfaces.emplace(*context_, on.onGpu, on.sizePx);
    return &*on.surfaces;
  }

  void timeFirst(LiveRun& run, const SharedScene& on) {
    const Stopwatch watch(seconds_["rendering"]);
    clock_.wake();
    const FirstPicture first = timeFirstPicture(*context_, on.onGpu.scene, on.sizePx, run.plan->technique);
    run.outcome.measurements.push_back(measured("first_picture_ms", first.allMs));
    run.outcome.measurements.push_back(measured("first_picture_compile_ms", first.compileMs));
    run.outcome.measurements.push_back(measured("first_picture_upload_ms", first.uploadMs));
  }

  void prepare(LiveRun& run, const SharedScene& on) {
    const Stopwatch watch(seconds_["rendering"]);
    run.technique = run.info->make(run.plan->technique.values);
    run.frame = std::make_unique<frame::Frame>(*context_, on.onGpu, on.sizePx);
    const double compiledBefore = context_->programs().compileMs();
    const auto start = steady_clock::now();
    run.technique->prepare(*run.frame);
    // The first frame allocates the shared inputs, which counts as preparation.
    run.frame->begin();
    run.technique->render(*run.frame);
    run.frame->end();
    glFinish();
    const double ms = std::chrono::duration<double, std::milli>(steady_clock::now() - start).count();
    const double compileMs = context_->programs().compileMs() - compiledBefore;
    run.outcome.measurements.push_back(measured("prepare_ms", ms - compileMs));
    for (const gl::PassList::Pass& pass : run.frame->passes().passes())
      run.outcome.passes.push_back({pass.name, pass.bytesHeld});
  }

  static void countNonFinite(const Image& product, RunOutcome& outcome) {
    const auto count = std::count_if(product.data.begin(), product.data.end(),
                                     [](float value) { return !std::isfinite(value); });
    outcome.measurements.push_back(measured("non_finite_count", static_cast<double>(count)));
    if (count > 0) outcome.error = std::to_string(count) + " values of the product are not finite";
  }

  nlohmann::json referenceIdentity(const PlannedRun& run, const SharedScene& on) const {
    return {{"reference", run.reference.name},         {"version", run.reference.version},
            {"values", run.reference.values.toJson()}, {"scene", on.facts["content_hash"]},
            {"size_px", {on.sizePx.x, on.sizePx.y}},   {"device", environment_.device}};
  }

  /// `sizePx` of the product: a picture's, or what a stream takes.
  Reference referenceFor(const PlannedRun& run, const SharedScene& on, glm::ivec2 sizePx) {
    return references_.get(sha256(referenceIdentity(run, on).dump()), sizePx.x, sizePx.y, [&] {
      RenderedOnce made = renderWithRemarks(*context_, on.onGpu, on.sizePx, run.reference);
      return Reference{std::make_shared<const Image>(std::move(made.product)), std::move(made.remarks)};
    });
  }

  /// Hashes the product and writes artefacts, which takes longer than a fast technique's frames.
  void startAfterwork(LiveRun& run, const SharedScene& on, Image product,
                      std::shared_ptr<const Image> reference, MetricPictures shown) {
    const bool writes = run.plan->artefacts.pictures || run.plan->artefacts.exr;
    std::map<std::string, techniques::PictureMaker> views;
    if (run.plan->artefacts.pictures) {
      const Stopwatch watch(seconds_["artefacts"]);
      views = run.technique->pictures();
    }
    auto work = [writes, plan = run.plan, folder = folder_, view = on.view, product = std::move(product),
                 reference = std::move(reference), shown = std::move(shown), views = std::move(views)] {
      Afterwork out;
      out.productHash = productHash(product);
      if (writes)
        out.artefacts = writeArtefacts(*plan, folder, product, reference.get(), view->shading, shown, views);
      return out;
    };
    // In parallel with the GPU; with a software renderer, however, files must not be compressed while frames
    // are timed.
    run.afterwork = std::async(std::launch::async, std::move(work));
    if (environment_.software) {
      const Stopwatch watch(seconds_["artefacts"]);
      run.afterwork.wait();
    }
  }

  void time(LiveRun& run, int round, int rounds) {
    const Stopwatch watch(seconds_["rendering"]);
    clock_.wake();
    run.timing->warmUp(*run.frame, *run.technique);
    run.timing->measureRound(*run.frame, *run.technique, round, kMaxTimingSeconds / rounds);
    clock_.touch();
    if (const auto mhz = clock_.measureMhz()) run.clocksMhz.push_back(*mhz);
    if (round + 1 < rounds) return;
    // Throws if frames have gone wrong since the first, so that their times are not kept.
    (void)run.technique->remarks();
    for (store::Measurement& measurement : run.timing->summarise())
      run.outcome.measurements.push_back(measurement);
    run.outcome.frameTimes = run.timing->times();
    int64_t bytes = 0;
    for (const store::Pass& pass : run.outcome.passes) bytes += pass.bytesHeld;
    run.outcome.measurements.push_back(measured("bytes_held", static_cast<double>(bytes)));
    recordClock(run);
  }

  /// The lowest: times of a run whose clock changed are no steady GPU's.
  static void recordClock(LiveRun& run) {
    if (run.clocksMhz.empty()) return;
    const auto [lowest, highest] = std::minmax_element(run.clocksMhz.begin(), run.clocksMhz.end());
    run.outcome.measurements.push_back(measured("gpu_clock_mhz", *lowest));
    constexpr double kSteady = 1.03;
    if (*highest > kSteady * *lowest)
      addRemarks(
          {fmt::format("The GPU's clock was between {:.0f} and {:.0f} MHz while frames were timed: their "
                       "times are not those of one clock.",
                       *lowest, *highest)},
          run.outcome.sceneFacts);
  }

  std::string folder_;
  std::unique_ptr<gl::Context> context_;
  perception::MetricGpu metricGpu_;
  GpuClock clock_;
  ReferenceCache references_;
  store::Environment environment_;
  std::string sceneKey_;
  std::unique_ptr<SharedScene> scene_;
  std::string nextKey_;  ///< of the scene that is being built while the GPU works; "": none
  std::future<BuiltScene> next_;
  std::map<std::string, double> seconds_;
};

}  // namespace

std::unique_ptr<Executor> makeGlExecutor(const std::string& resultsFolder,
                                         const std::string& referencesFolder) {
  return std::make_unique<GlExecutor>(resultsFolder, referencesFolder);
}

}  // namespace limen::experiments
