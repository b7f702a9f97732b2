// SPDX-License-Identifier: BSD-3-Clause
// limen view: look at any scene with any technique, change any parameter, export what you find.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "experiments/base/build_facts.h"
#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/printable.h"
#include "experiments/base/program.h"
#include "experiments/base/text.h"
#include "experiments/viewer/export_descriptor.h"
#include "experiments/viewer/path_video.h"
#include "experiments/viewer/screenshot.h"
#include "experiments/viewer/viewer.h"
#include "renderer/gl/devices.h"
#include "renderer/gl/shader_source.h"
#include "renderer/window/ui_window.h"

namespace limen::viewer {
namespace {

struct ViewOptions {
  std::string descriptor, scene = "bunny", technique = "soft_shadows/bitmask", reference, second;
  std::vector<std::string> set;
  std::string size = "640x480", windowSize = "1600x1000", results = "results/viewer";
  std::string display = "schwarz_2009", arrangement = "first";
  std::string screenshot, shaders;
  PathVideoOptions video;
  int frames = 1, monitor = 0;
  double scale = 0.0;
  bool fullScreen = false;
};

glm::ivec2 sizeOf(const std::string& text, const std::string& option) {
  int width = 0, height = 0, end = 0;
  const bool read = std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &end) == 2 &&
                    end == static_cast<int>(text.size());
  if (!read || width < 1 || height < 1 || width > 16384 || height > 16384)
    throw Error("'" + text + "' is not a size", option,
                "give it as WIDTHxHEIGHT in pixels, 1x1 to 16384x16384");
  return {width, height};
}

/// How the viewer starts: the arrangement of pictures, and what is predicted.
struct InitialView {
  Arrangement arrangement = Arrangement::First;
  Overlay overlay = Overlay::None;
};

InitialView initialView(const std::string& name) {
  const std::vector<std::pair<std::string, InitialView>> all = {
      {"first", {Arrangement::First, Overlay::None}},
      {"second", {Arrangement::Second, Overlay::None}},
      {"side_by_side", {Arrangement::SideBySide, Overlay::None}},
      {"split", {Arrangement::Split, Overlay::None}},
      {"flicker", {Arrangement::Flicker, Overlay::None}},
      {"error", {Arrangement::ErrorMap, Overlay::None}},
      {"thresholds", {Arrangement::Overlay, Overlay::Thresholds}},
      {"single_thresholds", {Arrangement::Overlay, Overlay::SingleThresholds}},
      {"popping", {Arrangement::Overlay, Overlay::Popping}}};
  std::vector<std::string> names;
  for (const auto& [known, shown] : all) {
    if (known == name) return shown;
    names.push_back(known);
  }
  throw Error("no arrangement '" + name + "'", "--arrangement", suggest(name, names));
}

/// `text` as a value of this parameter.
ParameterValue valueOf(const Parameter& parameter, const std::string& text, const std::string& where) {
  const auto refuse = [&] {
    return Error("'" + parameter.name + "' is '" + text + "'", where, "allowed: " + describeRange(parameter));
  };
  switch (parameter.type) {
    case ParameterType::Boolean:
      if (text != "true" && text != "false") throw refuse();
      return text == "true";
    case ParameterType::Integer:
    case ParameterType::Real: {
      char* end = nullptr;
      const double number = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0') throw refuse();
      if (parameter.type == ParameterType::Real) return number;
      if (number != std::floor(number) || std::abs(number) > 9e15) throw refuse();
      return static_cast<int64_t>(number);
    }
    default:
      return text;
  }
}

/// "scene.light_size=2", "technique.budget.rim=25"
void apply(ViewSetup& setup, const std::string& text) {
  const size_t dot = text.find('.'), equals = text.find('=');
  const std::string hint =
      "give it as scene.NAME=VALUE, technique.NAME=VALUE, second.NAME=VALUE or reference.NAME=VALUE";
  if (dot == std::string::npos || equals == std::string::npos || dot > equals)
    throw Error("'" + text + "' names no parameter", "--set", hint);
  const std::string what = text.substr(0, dot), path = text.substr(dot + 1, equals - dot - 1);
  const std::string value = text.substr(equals + 1);
  Entry* entry = what == "scene"                          ? &setup.scene
                 : what == "technique"                    ? &setup.technique
                 : what == "second" && setup.second       ? &*setup.second
                 : what == "reference" && setup.reference ? &*setup.reference
                                                          : nullptr;
  if (!entry) throw Error("nothing is called '" + what + "' here", "--set " + text, hint);
  const std::vector<Parameter> declared =
      what == "scene" ? sceneParameters(entry->name) : techniqueParameters(*entry);
  const Parameter* parameter = findDeclaration(declared, *entry, path);
  setParameter(*entry, declared, path,
               parameter ? valueOf(*parameter, value, "--set " + text) : ParameterValue(value));
}

ViewSetup setupFrom(const ViewOptions& options) {
  ViewSetup setup;
  if (!options.descriptor.empty()) {
    setup = readSetup(options.descriptor);
  } else {
    setup.scene.name = options.scene;
    setup.technique.name = options.technique;
    sceneParameters(setup.scene.name);
    setup.reference = options.reference == "none" ? std::nullopt
                      : options.reference.empty() ? usualReference(options.technique)
                                                  : std::optional(Entry{options.reference, {}});
    if (setup.reference) techniqueParameters(setup.reference->name);
    setup.sizePx = sizeOf(options.size, "--size");
  }
  if (!options.second.empty()) {
    techniqueParameters(options.second);
    setup.second = Entry{options.second, {}};
  }
  for (const std::string& text : options.set) apply(setup, text);
  // Missing or conflicting settings are reported before any window opens.
  completeScene(setup.scene);
  completeTechnique(setup.technique);
  if (setup.second) completeTechnique(*setup.second);
  if (setup.reference) completeTechnique(*setup.reference);
  return setup;
}

/// Shows the viewer until its window is closed and what is to be saved is saved.
void runWindow(window::UiWindow& window, Viewer& viewer) {
  using Clock = std::chrono::steady_clock;
  auto before = Clock::now();
  // The interface needs a few frames to settle after an event.
  constexpr int kFramesAfterEvent = 3;
  int framesLeft = kFramesAfterEvent;
  bool closing = false;
  while (interruptSignal() == 0) {
    if (window.takeCloseRequest()) closing = true;
    if (closing && !viewer.state().saving) return;
    const bool busy = framesLeft > 0 || viewer.animated();
    const bool woken = window.waitForAnything(busy ? 0.0 : 0.5);
    const bool changed = viewer.takeResults();
    if (woken || changed) framesLeft = kFramesAfterEvent;
    if (window.contextLost()) throw Error("the graphics driver was reset", {}, "start the viewer again");
    if (framesLeft == 0 && !viewer.animated()) {
      before = Clock::now();
      continue;
    }
    const auto now = Clock::now();
    // Nothing has moved while idle.
    const double passed = std::min(std::chrono::duration<double>(now - before).count(), 0.1);
    before = now;
    window.draw({0.06F, 0.06F, 0.07F}, [&] { viewer.build(passed); });
    window.show(1);
    framesLeft = std::max(framesLeft - 1, 0);
  }
}

int viewInWindow(const ViewOptions& options, const ViewerOptions& viewerOptions, InitialView first) {
  window::UiWindowOptions windowOptions;
  windowOptions.title = "Limen";
  windowOptions.sizePx = sizeOf(options.windowSize, "--window");
  windowOptions.fullScreen = options.fullScreen;
  windowOptions.monitor = options.monitor;
  windowOptions.scale = static_cast<float>(options.scale);
  windowOptions.resizable = true;
  windowOptions.density = window::UiDensity::Workbench;
  std::unique_ptr<window::UiWindow> made;
  try {
    made = std::make_unique<window::UiWindow>(windowOptions);
  } catch (const Error& error) {
    throw Error(error.what(), {}, "without a display, --screenshot FILE writes a picture of the viewer");
  }
  window::UiWindow& window = *made;
  Viewer viewer(window, viewerOptions, &window::UiWindow::wake);
  viewer.execute(command::Arrange{first.arrangement});
  viewer.execute(command::Predict{first.overlay});
  int code = 0;
  try {
    runWindow(window, viewer);
  } catch (...) {
    code = reportFailure(calledName("limen-view"));
  }
  // A single frame or reference can take minutes, and drivers cannot be asked to stop. Nothing is left to be
  // written.
  constexpr std::chrono::milliseconds kPatience{1000};
  if (!viewer.close(kPatience)) {
    std::fflush(nullptr);
    _exit(exitCodeAfter(code));
  }
  return code;
}

int view(const ViewOptions& options) {
  ViewerOptions viewerOptions;
  viewerOptions.setup = setupFrom(options);
  viewerOptions.resultsFolder = options.results;
  viewerOptions.shaderRoot = options.shaders;
  if (!options.shaders.empty()) gl::setShaderRoot(options.shaders);
  if (!options.video.file.empty()) {
    const std::string description = writePathVideo(viewerOptions.setup, options.video);
    std::printf("%s: %s\n", options.video.file.c_str(), description.c_str());
    return 0;
  }
  viewerOptions.display = perception::readDisplay(options.display);
  const InitialView first = initialView(options.arrangement);
  if (options.screenshot.empty()) return viewInWindow(options, viewerOptions, first);
  window::OffscreenUi ui(sizeOf(options.windowSize, "--window"),
                         options.scale > 0.0 ? static_cast<float>(options.scale) : 1.0F);
  Viewer viewer(ui, viewerOptions, [] {});
  viewer.execute(command::Arrange{first.arrangement});
  viewer.execute(command::Predict{first.overlay});
  writeScreenshot(ui, viewer, options.frames, options.screenshot);
  std::printf("%s\n", options.screenshot.c_str());
  const RenderResult& shown = *viewer.state().shown;
  std::string wrong = shown.error;
  for (const Rendered& one : shown.rendered) wrong += one.error + one.failure;
  if (wrong.empty()) return 0;
  std::fprintf(stderr, "%s: %s\n", calledName("limen-view").c_str(), printable(wrong).c_str());
  return 1;
}

int viewMain(int argc, char** argv) {
  installInterruptHandlers();
  ViewOptions options;
  int exitCode = 0;
  CLI::App app("Look at any scene with any technique, change any parameter, export what you find.",
               "limen-view");
  app.set_version_flag("--version", versionText("limen-view"));
  app.add_option("descriptor", options.descriptor, "Show the first run of this descriptor");
  app.add_option("--scene", options.scene, "Scene to start with")->capture_default_str();
  app.add_option("--technique", options.technique, "Technique to start with")->capture_default_str();
  app.add_option("--second", options.second, "Second technique to compare with");
  app.add_option("--reference", options.reference, "Reference for errors, or none (default: the usual one)");
  app.add_option("--set", options.set,
                 "Parameter, by its path: scene.light_size=2, technique.budget.rim=25, ...");
  app.add_option("--size", options.size, "Size of the rendered picture, pixels")->capture_default_str();
  app.add_option("--window", options.windowSize, "Size of the window, pixels")->capture_default_str();
  app.add_option("--scale", options.scale, "Scale of text and controls (default: the monitor's)")
      ->check(CLI::Range(0.5, 4.0));
  app.add_flag("--full-screen", options.fullScreen, "Open a full-screen window");
  app.add_option("--monitor", options.monitor, "Which monitor, from 0")->capture_default_str();
  app.add_option("--display", options.display, "Display to predict for: preset or YAML file")
      ->capture_default_str();
  app.add_option(
         "--arrangement", options.arrangement,
         "first, second, side_by_side, split, flicker, error, thresholds, single_thresholds or popping")
      ->capture_default_str();
  app.add_option("--results", options.results, "Folder for exported descriptors, pictures, views and paths")
      ->capture_default_str();
  app.add_option("--shaders", options.shaders, "Source tree to read shaders from and watch for changes");
  app.add_option_function<std::string>(
      "--device", [](const std::string& name) { setenv(gl::kDeviceVariable, name.c_str(), 1); },
      "GPU to render on: a part of its name or its index (limen sweep --list devices)");
  app.add_option("--screenshot", options.screenshot,
                 "Write a picture of the viewer (PNG) and exit; needs no display");
  app.add_option(
      "--video", options.video.file,
      "Write a video of the camera's path (.avi, .mkv lossless, .mp4) and exit; with --second both side "
      "by side; needs no display");
  app.add_option("--fps", options.video.framesPerSecond, "With --video: frames per second")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 1000.0));
  app.add_option("--seconds", options.video.seconds, "With --video: its length (default: to the path's end)")
      ->check(CLI::PositiveNumber);
  app.add_option("--frames", options.frames, "With --screenshot: frames after everything is on screen")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  app.callback([&] { exitCode = view(options); });
  return runProgram(app, argc, argv, exitCode);
}

}  // namespace
}  // namespace limen::viewer

int main(int argc, char** argv) { return limen::viewer::viewMain(argc, argv); }
