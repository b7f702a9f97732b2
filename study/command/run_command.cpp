// SPDX-License-Identifier: BSD-3-Clause
// limen study run: a person takes part.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "experiments/base/build_facts.h"
#include "experiments/base/interrupt.h"
#include "renderer/catalogue.h"
#include "renderer/gl/window_context.h"
#include "renderer/gl/window_system.h"
#include "study/application/presented_player.h"
#include "study/application/protocol_lettering.h"
#include "study/application/window_front_end.h"
#include "study/command/commands.h"
#include "study/presentation/markers.h"
#include "study/session/privacy.h"
#include "study/session/run.h"
#include "study/session/session_seed.h"
#include "study/stimulus/display_coding.h"

namespace limen::study {
namespace {

struct RunOptions {
  std::string protocol, participant, session = "1", store, display, screenshots;
  std::optional<uint64_t> seed;
  std::string window, photodiode, markers;
  int monitor = 0;
  double scale = 0.0;
  bool resume = false, fullScreen = false, announce = false, anyTiming = false, experimenter = false;
  int experimenterMonitor = 0;
};

/// "lower_left:64".
PhotodiodePatch patchOf(const std::string& text) {
  if (text.empty()) return {};
  const size_t colon = text.find(':');
  const std::string size = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (size.empty() || size.size() > 4 || size.find_first_not_of("0123456789") != std::string::npos ||
      std::stoi(size) < 1)
    throw Error("'" + text + "' is not a patch", "--photodiode",
                "write CORNER:PIXELS, such as lower_left:64");
  return {std::stoi(size), cornerOf(text.substr(0, colon))};
}

glm::ivec2 sizeOf(const std::string& text) {
  int width = 0, height = 0, used = 0;
  const int read = std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used);
  if (read != 2 || used != static_cast<int>(text.size()) || width < 1 || height < 1)
    throw Error("'" + text + "' is not a size", "--window",
                "write WIDTHxHEIGHT in pixels, such as 1280x1024");
  return {width, height};
}

void checkMonitor(const std::string& option, int number) {
  std::vector<gl::Monitor> all;
  try {
    all = gl::monitors();
  } catch (const Error& error) {
    throw Error(error.message(), error.where(), error.hint() + "; limen study simulate needs no window");
  }
  if (number < 0 || number >= static_cast<int>(all.size()))
    throw Error(fmt::format("there is no monitor {}", number), option,
                all.empty() ? "none is connected" : fmt::format("connected are 0 to {}", all.size() - 1));
}

std::unique_ptr<window::UiWindow> openWindow(const RunOptions& options, const Protocol& protocol) {
  checkMonitor("--monitor", options.monitor);
  if (options.experimenter) checkMonitor("--experimenter-monitor", options.experimenterMonitor);
  window::UiWindowOptions wanted;
  wanted.title = protocol.title;
  wanted.lettering = letteringFor(protocol);
  wanted.fullScreen = options.window.empty();
  if (!wanted.fullScreen) wanted.sizePx = sizeOf(options.window);
  wanted.monitor = options.monitor;
  wanted.scale = static_cast<float>(options.scale);
  return std::make_unique<window::UiWindow>(wanted);
}

// Why timing measured here is not fit for a laboratory.
std::vector<std::string> doubts(window::UiWindow& window, const perception::DisplayProfile& display) {
  std::vector<std::string> all = objectionsTo(window.context());
  const window::UiMonitor monitor = window.monitor();
  // Window systems round rates: 59.94 Hz is called 59 or 60.
  if (monitor.refreshHz > 0 && std::abs(monitor.refreshHz - display.refreshHz) > 1.0)
    all.push_back(fmt::format("the monitor runs at {:g} Hz, the display profile {} at {:g} Hz",
                              monitor.refreshHz, display.name, display.refreshHz));
  if (monitor.sizePx != display.resolutionPx)
    all.push_back(fmt::format("the monitor has {} x {} px, the display profile {} {} x {} px",
                              monitor.sizePx.x, monitor.sizePx.y, display.name, display.resolutionPx.x,
                              display.resolutionPx.y));
  return all;
}

SessionRequest requestOf(const RunOptions& options, const Protocol& protocol) {
  SessionRequest request;
  request.store = options.store.empty() ? "results/" + protocol.name + ".sqlite" : options.store;
  request.participant = options.participant;
  request.session = options.session;
  request.seed = options.seed ? *options.seed : randomSessionSeed();
  request.resume = options.resume;
  request.display = perception::readDisplay(options.display.empty() ? protocol.display : options.display);
  const std::filesystem::path folder = std::filesystem::path(request.store).parent_path();
  std::error_code failed;
  if (!folder.empty()) std::filesystem::create_directories(folder, failed);
  return request;
}

void report(const SessionEnd& end, const WindowFrontEnd& frontEnd, const SessionWatch& watch,
            const SessionRequest& request, const RunOptions& options) {
  switch (end.kind) {
    case Step::Kind::Finished:
      std::puts("The session is complete.");
      break;
    case Step::Kind::Aborted:
      std::puts("The session was ended early.");
      break;
    case Step::Kind::Screen:
    case Step::Kind::Trial:
      if (!frontEnd.stopReason().empty()) std::printf("Stopped: %s.\n", frontEnd.stopReason().c_str());
      std::printf(
          "The session can be resumed: limen study run %s --participant %s --session %s --store %s "
          "--resume\n",
          options.protocol.c_str(), request.participant.c_str(), request.session.c_str(),
          request.store.c_str());
      break;
  }
  for (const std::string& line : watch.lines()) std::printf("  %s\n", line.c_str());
  std::printf("  store: %s\n", request.store.c_str());
}

void runStudy(const RunOptions& options, Run& run) {
  const Protocol protocol = readProtocol(options.protocol, catalogueFromRegistries());
  checkLettering(protocol);
  checkCode(options.participant, "participant");
  checkCode(options.session, "session");
  const SessionRequest request = requestOf(options, protocol);
  const bool fullScreen = options.window.empty();
  // Before anything opens: a recorder that hears nothing is noticed now, not after the session.
  std::unique_ptr<Markers> markers;
  if (!options.markers.empty())
    markers = std::make_unique<Markers>(openMarkerPort(options.markers), protocol.markers);

  // A session that is stopped is stored as paused, which takes as long as a frame may take to come to the
  // screen.
  constexpr double kGraceS = 3.0;
  installInterruptHandlers(kGraceS);
  const std::unique_ptr<window::UiWindow> window = openWindow(options, protocol);
  std::unique_ptr<ExperimenterWindow> experimenter;
  if (options.experimenter)
    experimenter = std::make_unique<ExperimenterWindow>(options.experimenterMonitor, window->scale(),
                                                        experimenterNotes());
  PresentedPlayer player(*window, protocol, request.display, options.anyTiming, patchOf(options.photodiode));
  player.checkFit();

  WindowFrontEnd::Setting setting;
  setting.background =
      glm::vec3(static_cast<float>(displayCode(request.display, protocol.window.background)) / 255.0F);
  setting.fullScreen = fullScreen;
  setting.screenshots = options.screenshots;
  setting.markers = markers.get();
  if (options.announce)
    setting.announce = [](const std::string& line) {
      std::puts(line.c_str());
      std::fflush(stdout);
    };
  std::vector<std::string> why = doubts(*window, request.display);
  if (player.pacedByTimer())
    why.push_back("a timer paces the frames because nothing here waits for the display");
  if (!options.screenshots.empty()) why.push_back("pictures of the screen are taken (--screenshots)");
  if (options.anyTiming) why.push_back("frame times are not checked (--any-timing)");
  for (const std::string& doubt : why)
    std::fprintf(stderr, "warning: timing is not fit for a lab: %s\n", doubt.c_str());
  setting.facts = {{"lab_ready", why.empty()},
                   {"lab_doubts", why},
                   {"language", protocol.words["language"]},
                   {"words_sha256", protocol.words.hash()}};
  if (markers) {
    setting.facts["markers"]["port"] = markers->port();
    for (size_t i = 0; i < markers->codes().size(); ++i)
      setting.facts["markers"]["codes"][std::string(limen::toText(static_cast<MarkerKind>(i)))] =
          markers->codes()[i];
  }

  SessionWatch watch;
  WindowFrontEnd frontEnd(*window, player, watch, experimenter.get(), setting);
  try {
    const SessionEnd end = runSession(protocol, request, frontEnd);
    if (end.kind != Step::Kind::Finished) run.exitCode = kExitFailedRuns;
    report(end, frontEnd, watch, request, options);
  } catch (const Interrupted&) {
    run.exitCode = kExitFailedRuns;
    SessionEnd end;
    end.kind = Step::Kind::Screen;
    report(end, frontEnd, watch, request, options);
  }
}

}  // namespace

void addRunCommand(CLI::App& app, Run& run) {
  CLI::App* command = app.add_subcommand("run", "Runs a session with a person in a window");
  auto options = std::make_shared<RunOptions>();
  command->add_option("protocol", options->protocol, "Name of a shipped protocol, or a file")
      ->type_name("NAME|FILE")
      ->required();
  command
      ->add_option("--participant", options->participant, "Code of the participant (not a name), such as p01")
      ->required();
  command->add_option("--session", options->session, "Number or name of the sitting")->capture_default_str();
  command->add_option("--seed", options->seed,
                      "Seed of all orders, for tests (default: a random one, stored with the session)");
  command->add_option("--store", options->store, "Result store (default: results/PROTOCOL.sqlite)");
  command->add_option("--display", options->display,
                      "Display profile, preset or file (default: the protocol's)");
  command->add_flag("--resume", options->resume, "Resume a session that was stopped");
  auto* window =
      command->add_option("--window", options->window, "A window of WIDTHxHEIGHT px, to try things out");
  command->add_flag("--full-screen", options->fullScreen, "Fill the monitor (default)")->excludes(window);
  command->add_option("--monitor", options->monitor, "Number of the monitor, from 0")->capture_default_str();
  command->add_option("--scale", options->scale, "Scale of text and buttons (default: the monitor's)")
      ->check(CLI::Range(0.5, 8.0));
  command->add_option("--screenshots", options->screenshots,
                      "Folder for a PNG of every screen and of a frame of every stimulus");
  command->add_flag("--announce", options->announce, "Print the name of every screen when it is shown");
  command->add_flag("--any-timing", options->anyTiming,
                    "Trials count even if frames were late: for trying things out, not for data");
  command->add_option(
      "--photodiode", options->photodiode,
      "A square for a light sensor, CORNER:PIXELS (lower_left:64): white while a stimulus shows its state "
      "after the change, otherwise on every other frame. The sensor must cover it, since it gives answers "
      "away");
  command->add_option(
      "--markers", options->markers,
      "Port to a recorder that gets a byte when a stimulus begins, changes and ends, at the "
      "question and the answer: serial:DEVICE[:BAUD] or parallel:DEVICE. Codes: 'markers' of the "
      "protocol");
  command->add_flag("--experimenter-window", options->experimenter,
                    "A second window: progress, timing, notes");
  command->add_option("--experimenter-monitor", options->experimenterMonitor, "Monitor of that window")
      ->capture_default_str();
  command->callback([options, &run] { runStudy(*options, run); });
}

}  // namespace limen::study
