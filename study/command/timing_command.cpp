// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "renderer/gl/window_context.h"
#include "study/command/commands.h"
#include "study/presentation/gl_screen.h"
#include "study/presentation/timing_run.h"
#include "study/presentation/virtual_screen.h"

namespace limen::study {
namespace {

struct TimingOptions {
  double seconds = 10.0;
  int monitor = 0;
  bool windowed = false, json = false;
  double virtualHz = 0.0, jitterMs = 0.2;
  std::vector<int> drops;
};

/// Frames are numbered as in the report, from the end of the warm-up.
TimingReport runVirtual(const TimingOptions& options) {
  VirtualDisplay display;
  display.refreshHz = options.virtualHz;
  display.jitterMs = options.jitterMs;
  const int warmUp = timingWarmUpSwaps(options.virtualHz);
  for (const int drop : options.drops) ++display.drops[warmUp + drop];
  VirtualScreen screen(display);
  TimingReport report = runTiming(screen, options.seconds);
  report.objections.insert(report.objections.begin(), "the display is virtual");
  return report;
}

TimingReport runReal(const TimingOptions& options, std::string& device) {
  gl::WindowSetting setting;
  setting.title = "Limen timing test";
  setting.fullScreen = !options.windowed;
  setting.monitor = options.monitor;
  gl::WindowContext context(setting);
  device = context.device().line();
  // Any transfer curve will do for a flicker.
  GlScreen screen(context, perception::DisplayProfile{});
  TimingReport report = runTiming(screen, options.seconds);
  for (const std::string& objection : objectionsTo(context))
    if (std::find(report.objections.begin(), report.objections.end(), objection) == report.objections.end())
      report.objections.push_back(objection);
  return report;
}

void test(const TimingOptions& options, Run& run) {
  if (!options.drops.empty() && !(options.virtualHz > 0.0))
    throw Error("frames can only be dropped on a virtual display", "--drop", "add --virtual HZ");
  std::string device = fmt::format("virtual display of {:.4g} Hz", options.virtualHz);
  const TimingReport report = options.virtualHz > 0.0 ? runVirtual(options) : runReal(options, device);
  if (options.json) {
    nlohmann::json out = toJson(report);
    out["device"] = device;
    fmt::print("{}\n", out.dump(2));
  } else {
    fmt::print("{}\n{}", device, toText(report));
  }
  run.exitCode = report.objections.empty() ? kExitSuccess : kExitFailedRuns;
}

}  // namespace

void addTimingCommand(CLI::App& app, Run& run) {
  auto options = std::make_shared<TimingOptions>();
  CLI::App* command = app.add_subcommand(
      "timing-test",
      "Tests whether frames reach the screen on time; exits with 1 if timing is not fit for a lab.");
  command->add_option("--seconds", options->seconds, "How long to measure")
      ->check(CLI::Range(0.5, 3600.0))
      ->capture_default_str();
  command->add_option("--monitor", options->monitor, "Number of the monitor; the primary one is 0")
      ->capture_default_str();
  command->add_flag("--windowed", options->windowed, "Use a window, which is not fit for a lab");
  command->add_flag("--json", options->json, "Machine-readable output");
  command->add_option("--virtual", options->virtualHz, "A simulated display of this refresh rate [Hz]")
      ->check(CLI::Range(1.0, 1000.0));
  command->add_option("--drop", options->drops, "Frames that the simulated display drops, as 30,90")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--jitter-ms", options->jitterMs,
                   "Jitter of the simulated display's clock, in either direction")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command->callback([options, &run] { test(*options, run); });
}

}  // namespace limen::study
