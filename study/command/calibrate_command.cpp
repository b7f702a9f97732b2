// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/base/text.h"
#include "renderer/gl/window_system.h"
#include "study/command/commands.h"
#include "study/presentation/calibration.h"
#include "study/presentation/calibration_screens.h"
#include "study/presentation/gl_screen.h"

namespace limen::study {
namespace {

struct CalibrateOptions {
  std::string out, name, readings, matches, transfer = "auto";
  std::vector<int> resolutionPx;
  double cardWidthPx = 0.0, distanceCm = 0.0, refreshHz = 0.0;
  std::optional<double> blackCdM2, peakCdM2;
  double ambientLux = 0.0, reflectance = 0.005;
  int monitor = 0;
  bool interactive = false, force = false, json = false;
};

double guessCardPx(const gl::Monitor& monitor) {
  constexpr double kUsualPitchM = 0.25e-3;
  const double pitchM = monitor.sizeMm.x > 0 ? 1e-3 * monitor.sizeMm.x / monitor.sizePx.x : kUsualPitchM;
  return kCardWidthM / pitchM;
}

/// Values not given are set by eye on the screen itself.
void ask(CalibrateOptions& options) {
  const std::vector<gl::Monitor> all = gl::monitors();
  if (options.monitor < 0 || options.monitor >= static_cast<int>(all.size()))
    throw Error(fmt::format("no monitor {}", options.monitor), "--monitor",
                fmt::format("{} are connected", all.size()));
  const gl::Monitor& monitor = all[static_cast<size_t>(options.monitor)];
  if (options.resolutionPx.empty()) options.resolutionPx = {monitor.sizePx.x, monitor.sizePx.y};
  if (!(options.refreshHz > 0.0)) options.refreshHz = monitor.refreshHz;
  const bool matches = options.readings.empty() && options.matches.empty() && options.transfer != "srgb";
  std::fprintf(stderr,
               "Left and right change by one, up and down by ten, Enter accepts, Escape cancels.\n"
               "First a frame: make it as large as a bank card held against the screen.\n%s",
               matches ? "Then three squares in fields of lines: step back until the lines blend, then make "
                         "each as bright as its field.\n"
                       : "");
  gl::WindowSetting setting;
  setting.title = "Limen calibration";
  setting.fullScreen = true;
  setting.monitor = options.monitor;
  gl::WindowContext context(setting);
  if (context.framebufferSizePx() != glm::ivec2(options.resolutionPx[0], options.resolutionPx[1]))
    throw Error("the monitor has a different number of pixels", "--resolution-px", "leave it out");
  perception::DisplayProfile raw;
  raw.transfer = perception::TransferCurve::Linear;
  GlScreen screen(context, raw);
  const auto taken = [](std::optional<double> value) {
    if (!value) throw Error("cancelled before the last value was set", "calibration", "start it again");
    return *value;
  };
  if (!(options.cardWidthPx > 0.0))
    options.cardWidthPx = taken(adjustCardWidth(screen, guessCardPx(monitor)));
  if (!matches) return;
  for (const double proportion : kMatchProportions) {
    const double level = taken(adjustMatch(screen, proportion, std::pow(proportion, 1.0 / 2.2)));
    options.matches +=
        fmt::format("{}{}={}", options.matches.empty() ? "" : ",", proportion, shortestNumber(level));
  }
}

void checkComplete(const CalibrateOptions& options) {
  std::vector<std::string> missing;
  if (options.resolutionPx.empty()) missing.push_back("--resolution-px");
  if (!(options.cardWidthPx > 0.0)) missing.push_back("--card-width-px");
  if (!(options.refreshHz > 0.0)) missing.push_back("--refresh-hz");
  if (missing.empty()) return;
  throw Error("not known: " + join(missing), {},
              options.interactive ? "the monitor does not report it, so give it"
                                  : "give them, or --interactive to set them by eye");
}

struct Result {
  perception::DisplayProfile profile;
  std::vector<std::string> notes;
  nlohmann::json fit = nlohmann::json::object();
};

void useReadings(const CalibrateOptions& options, Result& result) {
  if (options.blackCdM2 || options.peakCdM2)
    throw Error("black and peak follow from the readings", "--readings",
                "leave --black-cd-m2 and --peak-cd-m2 out");
  const std::vector<Reading> readings = readReadings(options.readings);
  const TransferFit fit = options.transfer == "gamma"  ? fitGamma(readings)
                          : options.transfer == "srgb" ? fitSrgb(readings)
                                                       : fitTransfer(readings);
  result.profile.transfer = fit.curve;
  if (fit.curve == perception::TransferCurve::Gamma) result.profile.gamma = fit.gamma;
  result.profile.blackCdM2 = fit.blackCdM2;
  result.profile.peakCdM2 = fit.peakCdM2;
  const std::string curve =
      fit.curve == perception::TransferCurve::Srgb ? "sRGB" : fmt::format("gamma {:.4g}", fit.gamma);
  result.notes.push_back(
      fmt::format("transfer: {} on {} photometer readings, residuals {:.3g} cd/m2 RMS, {:.2f} % of "
                  "the range at most",
                  curve, readings.size(), fit.rmsCdM2, 100.0 * fit.largestShare));
  result.fit = {{"curve", fit.curve == perception::TransferCurve::Srgb ? "srgb" : "gamma"},
                {"gamma", result.profile.gamma},
                {"residual_cd_m2", fit.residualCdM2},
                {"rms_cd_m2", fit.rmsCdM2},
                {"largest_share", fit.largestShare}};
}

void useMatches(const CalibrateOptions& options, Result& result) {
  const std::vector<Match> matches = parseMatches(options.matches);
  const MatchFit fit = fitMatches(matches);
  result.profile.transfer = perception::TransferCurve::Gamma;
  result.profile.gamma = fit.gamma;
  result.notes.push_back(
      fmt::format("transfer: gamma {:.4g} by {} visual matches, {:.3f} of the light off at most", fit.gamma,
                  matches.size(), fit.largestResidual));
  result.fit = {{"curve", "gamma"},
                {"gamma", fit.gamma},
                {"residual", fit.residual},
                {"largest_residual", fit.largestResidual}};
}

Result calibrate(const CalibrateOptions& options) {
  if (!options.readings.empty() && !options.matches.empty())
    throw Error("readings and matches both give the transfer curve", "--match", "give one of them");
  Result out;
  perception::DisplayProfile& profile = out.profile;
  profile.name = options.name;
  profile.resolutionPx = {options.resolutionPx[0], options.resolutionPx[1]};
  const double pitchM = pitchFromCard(options.cardWidthPx);
  profile.widthM = pitchM * profile.resolutionPx.x;
  profile.heightM = pitchM * profile.resolutionPx.y;
  out.notes.push_back(fmt::format("size: a card of 85.60 mm is {} px wide: pixels of {:.4f} mm",
                                  shortestNumber(options.cardWidthPx), 1000.0 * pitchM));
  profile.distanceM = options.distanceCm / 100.0;
  profile.refreshHz = options.refreshHz;
  profile.ambientLux = options.ambientLux;
  profile.screenReflectance = options.reflectance;
  if (!options.readings.empty()) {
    useReadings(options, out);
    return out;
  }
  if (!options.blackCdM2 || !options.peakCdM2)
    throw Error("the luminance of black and white is unknown", {},
                "give --readings, or --black-cd-m2 and --peak-cd-m2");
  profile.blackCdM2 = *options.blackCdM2;
  profile.peakCdM2 = *options.peakCdM2;
  if (!options.matches.empty()) {
    useMatches(options, out);
  } else if (options.transfer == "srgb") {
    profile.transfer = perception::TransferCurve::Srgb;
    out.notes.push_back("transfer: sRGB as stated, not measured");
  } else {
    throw Error("the transfer curve is unknown", {},
                "give --readings or --match; --transfer srgb assumes that of sRGB without measuring");
  }
  return out;
}

void run(CalibrateOptions options) {
  if (!options.force && std::filesystem::exists(options.out))
    throw Error("already exists", options.out, "name another file, or give --force to overwrite it");
  if (options.interactive) ask(options);
  checkComplete(options);
  const Result result = calibrate(options);
  writeProfile(options.out, result.profile, result.notes, options.force);
  if (options.json) {
    fmt::print("{}\n", nlohmann::json{{"profile", options.out},
                                      {"hash", result.profile.hash()},
                                      {"pixels_per_degree", result.profile.pixelsPerDegree()},
                                      {"width_m", result.profile.widthM},
                                      {"height_m", result.profile.heightM},
                                      {"black_cd_m2", result.profile.blackCdM2},
                                      {"peak_cd_m2", result.profile.peakCdM2},
                                      {"fit", result.fit}}
                           .dump(2));
    return;
  }
  for (const std::string& note : result.notes) fmt::print("{}\n", note);
  fmt::print("{}\nwritten to {}\n", result.profile.line(), options.out);
}

}  // namespace

void addCalibrateCommand(CLI::App& app, Run&) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command = app.add_subcommand(
      "calibrate", "Makes a display profile from measurements of a screen and the viewing position.");
  command->add_option("-o,--output", options->out, "Profile to write (YAML)")->required();
  command->add_option("--name", options->name, "Name of the display (default: the file's name)");
  command->add_option("--resolution-px", options->resolutionPx, "Resolution of the screen, as 1920,1080")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::PositiveNumber);
  command->add_option("--card-width-px", options->cardWidthPx, "A bank card's long side on the screen [px]")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--distance-cm", options->distanceCm,
                   "Distance from the viewer's eye to the centre of the screen")
      ->required();
  command
      ->add_option("--refresh-hz", options->refreshHz, "Refresh rate, as measured by limen study timing-test")
      ->check(CLI::PositiveNumber);
  command->add_flag("--interactive", options->interactive,
                    "Set card and matches by eye on the screen, unless given");
  command->add_option("--monitor", options->monitor, "Monitor for --interactive; the primary one is 0")
      ->capture_default_str();
  command->add_option("--readings", options->readings, "CSV file of level (0 to 1) and luminance [cd/m2]");
  command->add_option(
      "--match", options->matches,
      "Visual matches: proportion of white in a dithered field = grey level that looks the same, as "
      "0.25=0.53,0.5=0.73");
  command
      ->add_option("--transfer", options->transfer,
                   "Curve: auto selects the one that fits the readings better")
      ->check(CLI::IsMember({"auto", "gamma", "srgb"}))
      ->capture_default_str();
  command->add_option("--black-cd-m2", options->blackCdM2,
                      "Luminance of black in the dark, without --readings");
  command->add_option("--peak-cd-m2", options->peakCdM2,
                      "Luminance of white in the dark, without --readings");
  command->add_option("--ambient-lux", options->ambientLux, "Illuminance on the screen")
      ->capture_default_str();
  command->add_option("--screen-reflectance", options->reflectance, "Diffuse reflectance of the screen")
      ->capture_default_str();
  command->add_flag("--force", options->force, "Overwrite the profile");
  command->add_flag("--json", options->json, "Machine-readable output");
  command->callback([options] { run(*options); });
}

}  // namespace limen::study
