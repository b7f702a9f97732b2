// SPDX-License-Identifier: BSD-3-Clause
// limen-budget-benchmark: frames along a scene's camera path with a budget controlled by the frame time: for
// each frame the time of the controlled passes, that of the whole frame, the scale of the budget and, with
// --errors, how far the visibility is from that of an unlimited budget. CSV on standard output, a summary on
// lines that begin with #. GPU times, or wall times on a software renderer.
#include <epoxy/gl.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/standard_output.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/search_technique.h"

namespace {

using namespace limen;
using HostClock = std::chrono::steady_clock;

constexpr double kWarmUpS = 0.5;  ///< an idle GPU takes up to a third of a second to raise its clock
constexpr const char* kUsage =
    "--scene-set and --set take name=value, once for each parameter: budget=frame_time, budget.target_ms=1";

struct Options {
  std::string scene = "columns_hall", technique = "soft_shadows/backprojection";
  std::vector<std::string> sceneSet = {"motion=walk"}, set;
  int width = 1024, height = 768, frames = 480, settled = 60;
  size_t inFlight = 2;
  double stepS = 1.0 / 60.0;
  bool errors = false;
};

/// Results of one frame.
struct Row {
  double timeS = 0.0, scale = 1.0, rmse = 0.0, largest = 0.0;
  double passesMs = 0.0, frameMs = 0.0;
};

/// `text` as a value of one of the parameters at that path; ParameterValues refuses what suits none.
ParameterValue valueOf(const std::vector<Parameter>& declared, const std::string& path,
                       const std::string& text) {
  for (const DeclaredAt& at : flatten(declared)) {
    if (at.path != path) continue;
    try {
      switch (at.parameter->type) {
        case ParameterType::Boolean:
          return text == "true";
        case ParameterType::Integer:
          return int64_t{std::stoll(text)};
        case ParameterType::Real:
          return std::stod(text);
        default:
          return text;
      }
    } catch (const std::logic_error&) {
      throw Error("'" + text + "' is not a number", path, kUsage);
    }
  }
  return text;
}

std::map<std::string, ParameterValue> parse(const std::vector<Parameter>& declared,
                                            const std::vector<std::string>& given) {
  std::map<std::string, ParameterValue> out;
  for (const std::string& item : given) {
    const size_t at = item.find('=');
    if (at == std::string::npos) throw Error("'" + item + "' has no value", {}, kUsage);
    const std::string path = item.substr(0, at);
    out[path] = valueOf(declared, path, item.substr(at + 1));
  }
  return out;
}

double factOf(const std::vector<techniques::Counter>& facts, const std::string& name, double otherwise) {
  for (const techniques::Counter& fact : facts)
    if (fact.name == name) return fact.value;
  return otherwise;
}

/// Over the pixels that may be shadowed.
void compare(const Image& product, const Image& reference, const Image& receivers, Row& row) {
  double squares = 0.0;
  size_t compared = 0;
  for (size_t i = 0; i < product.pixels(); ++i) {
    if (receivers.data[4 * i + 3] < 0.0F) continue;
    const double error = std::abs(double{product.data[i]} - reference.data[i]);
    squares += error * error;
    row.largest = std::max(row.largest, error);
    ++compared;
  }
  row.rmse = compared > 0 ? std::sqrt(squares / static_cast<double>(compared)) : 0.0;
}

class Walk {
 public:
  explicit Walk(const Options& options)
      : options_(options),
        context_(gl::createHeadlessContext()),
        scene_(buildScene(options)),
        gpuScene_(scene_),
        sizePx_(options.width, options.height),
        frame_(*context_, scene_, gpuScene_, sizePx_),
        referenceFrame_(*context_, scene_, gpuScene_, sizePx_),
        technique_(makeTechnique(options.set)) {
    search_ = dynamic_cast<techniques::SearchTechnique*>(technique_.get());
    if (!search_)
      throw Error("'" + options.technique + "' has no budget", "--technique",
                  "name one that searches for occluders");
    technique_->prepare(frame_);
    if (options.errors) {
      reference_ = makeTechnique(withoutBudget(options.set));
      reference_->prepare(referenceFrame_);
    }
    // Settles the first frame's budget and wakes the GPU.
    const auto start = HostClock::now();
    do {
      render(0.0);
      glFinish();
    } while (std::chrono::duration<double>(HostClock::now() - start).count() < kWarmUpS);
  }

  std::vector<Row> run() {
    const bool software = context_->device().software;
    frame_.passes().startRecording(software ? gl::Clock::Wall : gl::Clock::Gpu, options_.frames);
    std::vector<Row> rows(static_cast<size_t>(options_.frames));
    for (int i = 0; i < options_.frames; ++i) {
      Row& row = rows[static_cast<size_t>(i)];
      row.timeS = i * options_.stepS;
      render(row.timeS);
      row.scale = factOf(search_->budgetFacts(), "budget_scale", 1.0);
      if (reference_) evaluate(row);
    }
    const std::string& own = options_.technique;
    for (const gl::PassTime& time : frame_.passes().finishRecording()) {
      Row& row = rows[static_cast<size_t>(time.frame)];
      const double ms = 1e-6 * static_cast<double>(time.nanoseconds);
      if (time.pass == "frame") row.frameMs = ms;
      if (time.pass == own || time.pass.starts_with(own + "/")) row.passesMs += ms;
    }
    context_->checkDebugMessages();
    return rows;
  }

  const gl::DeviceInfo& device() const { return context_->device(); }

 private:
  using Technique = std::unique_ptr<techniques::Technique>;

  static scene::Scene buildScene(const Options& options) {
    const std::vector<Parameter> declared =
        scene::SceneRegistry::instance().get(options.scene).allParameters();
    return scene::buildScene(options.scene, ParameterValues(declared, parse(declared, options.sceneSet)));
  }

  Technique makeTechnique(const std::vector<std::string>& set) const {
    const techniques::TechniqueInfo& info = techniques::TechniqueRegistry::instance().get(options_.technique);
    const ParameterValues values(info.parameters, parse(info.parameters, set));
    if (info.check) info.check(values);
    return info.make(values);
  }

  /// The same search without a limit; levels are then 0, whatever the settings say.
  static std::vector<std::string> withoutBudget(const std::vector<std::string>& set) {
    std::vector<std::string> out = {"budget=uniform", "budget.limit=0"};
    for (const std::string& item : set)
      for (const char* name : {"resolution", "raster", "structure", "occluders", "bias"})
        if (item.starts_with(std::string(name) + "=") || item.starts_with(std::string(name) + "."))
          out.push_back(item);
    return out;
  }

  void render(double timeS) {
    frame_.setTime(timeS);
    frame_.begin();
    technique_->render(frame_);
    frame_.end();
    // As with a display: otherwise the host runs hundreds of frames ahead, and times arrive just as late.
    fences_.push_back(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    if (fences_.size() <= options_.inFlight) return;
    constexpr GLuint64 kForever = ~GLuint64{0};
    glClientWaitSync(fences_.front(), GL_SYNC_FLUSH_COMMANDS_BIT, kForever);
    glDeleteSync(fences_.front());
    fences_.pop_front();
  }

  void evaluate(Row& row) {
    referenceFrame_.setTime(row.timeS);
    referenceFrame_.begin();
    reference_->render(referenceFrame_);
    const Image receivers = referenceFrame_.get<frame::Receivers>().texture().read();
    referenceFrame_.end();
    compare(technique_->product().read(), reference_->product().read(), receivers, row);
  }

  Options options_;
  std::unique_ptr<gl::Context> context_;
  scene::Scene scene_;
  frame::GpuScene gpuScene_;
  glm::ivec2 sizePx_;
  frame::Frame frame_, referenceFrame_;
  Technique technique_, reference_;
  techniques::SearchTechnique* search_ = nullptr;
  std::deque<GLsync> fences_;  // of frames that may still be in flight
};

void summarise(const std::vector<Row>& rows, double targetMs, int from) {
  int within = 0, compared = 0, reversals = 0, side = 0;
  double worst = 0.0, sum = 0.0;
  for (size_t i = static_cast<size_t>(from); i < rows.size(); ++i) {
    const double error = rows[i].passesMs / targetMs - 1.0;
    ++compared;
    within += std::abs(error) <= 0.1;
    worst = std::max(worst, std::abs(error));
    sum += rows[i].passesMs;
    const int now = error > 0.1 ? 1 : error < -0.1 ? -1 : 0;
    reversals += now != 0 && side != 0 && now != side;
    if (now != 0) side = now;
  }
  if (compared == 0) return;
  fmt::print(
      "# from frame {} on: mean {:.4g} ms of {:.4g} ms, {:.1f} % of frames within 10 %, worst {:.1f} %, "
      "{} sign changes beyond 10 %\n",
      from, sum / compared, targetMs, 100.0 * within / compared, 100.0 * worst, reversals);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Frames along a camera path with a controlled budget"};
  app.add_option("--scene", options.scene, "Scene with a camera path")->capture_default_str();
  app.add_option("--scene-set", options.sceneSet, "Parameter of the scene, name=value")
      ->capture_default_str();
  app.add_option("--technique", options.technique, "Technique that searches for occluders")
      ->capture_default_str();
  app.add_option("--set", options.set, "Parameter of the technique, name=value");
  app.add_option("--width", options.width)->capture_default_str();
  app.add_option("--height", options.height)->capture_default_str();
  app.add_option("--frames", options.frames)->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--settled", options.settled, "First frame of the summary")->capture_default_str();
  app.add_option("--step-s", options.stepS, "Time step between frames on the path")->capture_default_str();
  app.add_option("--in-flight", options.inFlight, "Number of frames that the host may be ahead of the GPU")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--errors", options.errors, "Compare each frame with an unlimited budget");
  CLI11_PARSE(app, argc, argv);
  try {
    const techniques::TechniqueInfo& info = techniques::TechniqueRegistry::instance().get(options.technique);
    const ParameterValues values(info.parameters, parse(info.parameters, options.set));
    Walk walk(options);
    fmt::print("# {}{}\n# {} {}\nframe,time_s,passes_ms,frame_ms,budget_scale,rmse,largest_error\n",
               walk.device().line(), walk.device().software ? " (wall time on a CPU)" : "", options.scene,
               values.toJson().dump());
    const std::vector<Row> rows = walk.run();
    for (size_t i = 0; i < rows.size(); ++i) {
      const Row& row = rows[i];
      fmt::print("{},{:.6g},{:.6g},{:.6g},{:.6g},", i, row.timeS, row.passesMs, row.frameMs, row.scale);
      if (options.errors)
        fmt::print("{:.6g},{:.6g}\n", row.rmse, row.largest);
      else
        fmt::print(",\n");
    }
    const techniques::SearchSettings search = techniques::SearchSettings::table().read(values);
    if (const auto* steered = std::get_if<techniques::FrameTimeBudget>(&search.budget))
      summarise(rows, steered->targetMs, std::min(options.settled, options.frames));
    return afterStandardOutput("limen-budget-benchmark", kExitSuccess);
  } catch (const Error& error) {
    fmt::print(stderr, "limen-budget-benchmark: {}\n", error.what());
    return kExitBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "limen-budget-benchmark: {}\n", error.what());
    return kExitFailedRuns;
  }
}
