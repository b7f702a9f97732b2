// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/evaluation_thread.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

#include "experiments/base/cancel.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "experiments/product.h"
#include "experiments/viewer/prediction_overlay.h"
#include "experiments/viewer/viewed_scene.h"
#include "perception/metrics/error_map.h"
#include "perception/metrics/metric.h"
#include "perception/metrics/metric_gpu.h"

namespace limen::viewer {
namespace {

/// Everything that determines a reference's product.
std::string identityOf(const ViewSetup& setup, const Entry& reference) {
  std::string out = std::to_string(setup.sizePx.x) + "x" + std::to_string(setup.sizePx.y);
  for (const Entry* entry : {&setup.scene, &reference}) {
    out += "|" + entry->name;
    for (const auto& [name, value] : entry->given) out += "," + name + "=" + toText(value);
  }
  return out;
}

std::string identityOf(const ViewSetup& setup) {
  return setup.reference ? identityOf(setup, *setup.reference) : std::string{};
}

/// The figures that all pictures have come first; those of special defects follow by name.
size_t rankOf(const std::string& metric) {
  constexpr std::array<const char*, 8> kFirst = {"rmse", "mae",     "psnr",      "ssim",
                                                 "flip", "jnd_p95", "p99_error", "largest_error"};
  return static_cast<size_t>(std::find(kFirst.begin(), kFirst.end(), metric) - kFirst.begin());
}

/// The metric's defaults, on the viewer's display if it asks for one; none if that cannot be named.
std::optional<ParameterValues> valuesFor(const perception::MetricInfo& metric,
                                         const perception::DisplayProfile& display) {
  std::map<std::string, ParameterValue> given;
  for (const Parameter& parameter : metric.parameters) {
    if (parameter.name != "display") continue;
    const std::vector<std::string> presets = perception::displayPresets();
    if (std::find(presets.begin(), presets.end(), display.name) == presets.end() ||
        perception::displayPreset(display.name).hash() != display.hash())
      return std::nullopt;
    given["display"] = display.name;
  }
  return ParameterValues(metric.parameters, given);
}

/// What an error is called: of several figures the first stands for all.
std::string figureName(const perception::MetricInfo& metric) {
  return metric.figures.empty() ? metric.name : metric.name + "_" + metric.figures[0].name;
}

double largestOf(const Image& map) {
  double largest = 0.0;
  for (const float value : map.data)
    if (std::isfinite(value)) largest = std::max(largest, double{value});
  return largest;
}

/// "samples 64 of 1024"
std::string stepText(const Entry& step, const Entry& reference) {
  const std::string& effort = techniques::TechniqueRegistry::instance().get(reference.name).effort;
  const Parameter* parameter = findDeclaration(techniqueParameters(reference.name), reference, effort);
  if (!parameter) return {};
  return effort + " " + toText(valueAt(step, effort, *parameter)) + " of " +
         toText(valueAt(reference, effort, *parameter));
}

}  // namespace

/// What lives in the thread's context.
class EvaluationThread::Work {
 public:
  explicit Work(gl::Context& context) : context_(context), metricGpu_(context) {}

  /// The reference's product for one step, from memory if it is the latest one made. Null if it was
  /// cancelled.
  std::shared_ptr<const Image> reference(const EvaluationRequest& request, const Entry& step,
                                         const std::stop_token& cancelled, std::atomic<int64_t>& made) {
    const std::string identity = identityOf(request.setup, step);
    if (identity == identity_) return reference_;
    viewed_.show(completeScene(request.setup.scene));
    const experiments::Configuration choice = completeTechnique(step);
    const CancelScope scope(cancelled);
    auto product = std::make_shared<Image>(
        experiments::renderOnce(context_, viewed_.get(), request.setup.sizePx, choice));
    ++made;
    if (cancelled.stop_requested()) return nullptr;
    identity_ = identity;
    reference_ = std::move(product);
    return reference_;
  }
  bool has(const EvaluationRequest& request) const {
    return request.setup.reference && identityOf(request.setup) == identity_;
  }

  void evaluate(const EvaluationRequest& request, EvaluationResult& out) {
    const bool everywhere = experiments::evaluatedEverywhere(request.kind);
    const perception::Depicts depicted = experiments::depicts(request.kind);
    std::optional<experiments::ShownSurfaces> surfaces;
    if (depicted == perception::Depicts::ShareOfLight) {
      viewed_.show(completeScene(request.setup.scene));
      surfaces.emplace(context_, viewed_.get(), request.setup.sizePx);
    }
    for (const auto& [name, info] : perception::MetricRegistry::instance().all()) {
      if (!info.needsReference || info.needsPath) continue;
      const std::optional<ParameterValues> values = valuesFor(info, request.display);
      if (!values) continue;
      const auto compare = [&, &metric = info](const Image& product, std::map<std::string, ErrorMap>& maps) {
        perception::ComparisonInput input{
            nullptr,    nullptr, &product, out.reference.get(), everywhere ? nullptr : &request.view->mask,
            &metricGpu_};
        input.depicts = depicted;
        if (!request.view->mirrors.data.empty()) input.mirrors = &request.view->mirrors;
        if (surfaces) input.surfaces = &surfaces->textures();
        perception::MetricResult result = metric.compare(input, *values);
        if (result.map && !maps.count(result.mapName)) {
          const double white = experiments::mapWhite(result.mapName);
          const double largest = largestOf(*result.map);
          maps[result.mapName] = {
              std::make_shared<ScreenPicture>(screenPicture(perception::errorPicture(*result.map, white))),
              std::make_shared<Image>(std::move(*result.map)), white, largest};
        }
        return result.value;
      };
      try {
        ErrorFigure figure{figureName(info), info.unit, compare(*request.product, out.maps),
                           std::numeric_limits<double>::quiet_NaN(), info.direction};
        if (request.second) figure.second = compare(*request.second, out.secondMaps);
        out.figures.push_back(std::move(figure));
      } catch (const std::exception&) {
        // A metric of another kind of product.
        context_.takeDebugMessages();
      }
    }
    std::stable_sort(out.figures.begin(), out.figures.end(), [](const ErrorFigure& a, const ErrorFigure& b) {
      return rankOf(a.metric) < rankOf(b.metric);
    });
  }

 private:
  gl::Context& context_;
  perception::MetricGpu metricGpu_;
  ViewedScene viewed_;
  std::string identity_;
  std::shared_ptr<const Image> reference_;
};

EvaluationThread::EvaluationThread(std::function<void()> wake)
    : thread_([this, wake = std::move(wake)] {
        run(wake);
        end_.set_value();
      }) {}

EvaluationThread::~EvaluationThread() { close(); }

void EvaluationThread::close() {
  requests_.close();
  const std::scoped_lock lock(guard_);
  cancel_.request_stop();
}

void EvaluationThread::ask(EvaluationRequest request) {
  {
    const std::scoped_lock lock(guard_);
    std::string identity = identityOf(request.setup);
    if (identity != asked_) {
      cancel_.request_stop();
      cancel_ = std::stop_source();
      asked_ = std::move(identity);
    }
  }
  requests_.put(std::move(request));
}

void EvaluationThread::run(const std::function<void()>& wake) {
  std::unique_ptr<gl::Context> context;
  try {
    context = gl::createHeadlessContext();
  } catch (const std::exception& error) {
    while (!requests_.closed()) {
      requests_.wait(std::chrono::seconds(1));
      if (std::optional<EvaluationRequest> request = requests_.take()) {
        EvaluationResult result;
        result.number = request->number;
        result.error = error.what();
        results_.put(std::move(result));
        wake();
      }
    }
    return;
  }
  Work work(*context);
  while (!requests_.closed()) {
    idle_ = true;
    if (!requests_.wait(std::chrono::seconds(1)) || requests_.closed()) continue;
    idle_ = false;
    std::optional<EvaluationRequest> request = requests_.take();
    if (!request) continue;
    std::stop_token cancelled;
    {
      const std::scoped_lock lock(guard_);
      cancelled = cancel_.get_token();
    }
    EvaluationResult result;
    result.number = request->number;
    const auto publish = [&] {
      results_.put(result);
      wake();
    };
    if (!request->setup.reference) {
      paintOverlay(*request, result);
      publish();
      continue;
    }
    try {
      const Entry& wanted = *request->setup.reference;
      const techniques::TechniqueInfo& info =
          techniques::TechniqueRegistry::instance().get(wanted.name, "reference");
      if (info.product != request->kind)
        throw Error("reference '" + info.name + "' makes another kind of product", {},
                    "choose one that makes " + techniques::toText(request->kind));
      std::vector<Entry> steps = work.has(*request) ? std::vector<Entry>{wanted} : fromCoarseToFine(wanted);
      std::optional<EvaluationResult> painted;  // a prediction that does not depend on the step
      for (const Entry& step : steps) {
        const std::shared_ptr<const Image> product = work.reference(*request, step, cancelled, made_);
        if (!product) break;
        // The same reference for another product: continue with that one.
        if (requests_.waiting() && !cancelled.stop_requested()) {
          std::optional<EvaluationRequest> next = requests_.take();
          if (next && identityOf(next->setup) != identityOf(request->setup)) {
            requests_.putBack(std::move(*next));
            break;
          }
          if (next) {
            request = std::move(next);
            painted.reset();
          }
        }
        result = {};
        result.number = request->number;
        result.reference = product;
        result.step = step == wanted ? "" : stepText(step, wanted);
        if (info.errorBound) result.bound = info.errorBound(completeTechnique(step).values);
        result.referencePicture = std::make_shared<ScreenPicture>(
            screenPicture(experiments::productPicture(request->kind, *product, request->view->shading)));
        work.evaluate(*request, result);
        if (painted) {
          result.overlay = painted->overlay;
          result.overlayNote = painted->overlayNote;
          result.overlayKind = painted->overlayKind;
        } else if (!overlayNeedsReference(*request)) {
          paintOverlay(*request, result);
          painted = result;
        } else if (step == wanted) {
          paintOverlay(*request, result);
        }
        publish();
        if (cancelled.stop_requested()) break;
      }
    } catch (const std::exception& error) {
      if (cancelled.stop_requested()) continue;
      context->takeDebugMessages();
      result = {};
      result.number = request->number;
      result.error = error.what();
      paintOverlay(*request, result);
      publish();
    }
  }
}

}  // namespace limen::viewer
