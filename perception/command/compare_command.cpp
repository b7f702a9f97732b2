// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive compare: every metric on any two images or sequences.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/text.h"
#include "perception/command/frame_report.h"
#include "perception/command/image_commands.h"
#include "perception/command/image_metrics.h"
#include "perception/command/image_options.h"
#include "perception/command/output_files.h"
#include "perception/metrics/error_map.h"
#include "perception/metrics/metric.h"

namespace limen::perception {
namespace {

struct CompareOptions : ImageOptions {
  std::string test, reference, mapFolder;
  std::vector<std::string> metrics;
};

std::vector<std::string> metricNames(const CompareOptions& options) {
  std::vector<std::string> names = options.metrics.empty() ? defaultMetrics() : options.metrics;
  for (size_t i = 0; i < names.size(); ++i)
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      throw Error("'" + names[i] + "' is named twice", "--metrics", "name each metric once");
  return names;
}

/// EXR of the values and PNG to look at. Returns what was written.
void writeMap(const MetricMap& map, const std::string& folder, const std::string& statement,
              FrameReport& report) {
  const double scale = errorScale(map.map);
  const std::filesystem::path base = std::filesystem::path(folder) / map.name;
  const std::string description = map.name + "; " + statement;
  writeExr(base.string() + ".exr", map.map, description);
  writePng(base.string() + ".png", errorPicture(map.map, scale),
           "black 0, pale yellow " + shortestNumber(scale) + " and above; " + description);
  report.outputs.emplace_back(map.name, base.string() + ".exr");
  report.outputs.emplace_back(map.name + " picture, 0 to " + shortestNumber(scale), base.string() + ".png");
}

int compare(const CompareOptions& options, const std::vector<std::string>& words) {
  const DisplayProfile display = readDisplay(options.displayName);
  const std::vector<std::string> names = metricNames(options);
  const std::vector<SettingsGroup> groups = metricSettings(names, display);
  if (options.list) {
    printSettings(options, groups);
    return kExitSuccess;
  }
  if (options.test.empty() || options.reference.empty())
    throw Error("an image is missing", "compare", "name two: limen-perceive compare IMAGE REFERENCE");
  const std::vector<ParameterValues> values = parseSettings(options.set, groups, "--set");
  const ParameterValues input = options.input();
  ImageMetrics metrics(names, values);
  const std::vector<Limit> limits = parseLimits(options.failAbove, options.failBelow, metrics.declared(), "");

  const ImageSequence tests = expandImages(options.test), references = expandImages(options.reference);
  const std::vector<FrameSet> frames = alignSequences({tests, references});
  std::vector<std::string> files;
  for (const FrameSet& frame : frames) files.insert(files.end(), frame.paths.begin(), frame.paths.end());
  OutputFiles outputs(frames, files);
  outputs.addFolder("--map", options.mapFolder);

  ReportHeader header;
  header.command = "compare";
  const std::string changed = changedSettings(groups, values);
  header.statement = limenVersion() + " image comparison (" + join(names) +
                     (changed.empty() ? "" : "; " + changed) + "), display " + display.line();
  header.words = words;
  header.display = display;
  header.settings = valuesAsJson(groups, values);
  header.settings["input"] = input.toJson();
  header.extra = metrics.facts();
  header.json = options.json;
  header.primaryFigures = {"rmse", "psnr", "ssim", "de94", "flip"};
  ReportPrinter printer(header, frames.size(), limits);
  for (const FrameSet& frame : frames) {
    InputImage test = readInput(frame.paths[0], display, input);
    InputImage reference = readInput(frame.paths[1], display, input);
    matchInputs(test, reference);
    FrameReport report;
    report.frame = frame;
    report.inputs = {{"image", &test}, {"reference", &reference}};
    std::vector<MetricMap> maps;
    report.figures = metrics.run(test, reference, options.mapFolder.empty() ? nullptr : &maps);
    for (const MetricMap& map : maps)
      writeMap(map, outputs.folder(options.mapFolder, frame), header.statement, report);
    printer.add(report);
  }
  return printer.finish();
}

}  // namespace

void addCompareCommand(CLI::App& app, int& exitCode, const std::vector<std::string>& words) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* const command =
      app.add_subcommand("compare", "How far an image is from a reference: every metric");
  command
      ->add_option("IMAGE", options->test,
                   "Image, or sequence: frame_%04d.png, frame_####.png, 'frames/*.png'")
      ->type_name("");
  command
      ->add_option("REFERENCE", options->reference,
                   "What it is compared with; one for all frames, or as many")
      ->type_name("");
  addImageOptions(*command, *options);
  command
      ->add_option("--metrics", options->metrics,
                   "These metrics only: " + join(MetricRegistry::instance().names()))
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--map", options->mapFolder,
                   "Folder for the metrics' maps: EXR of the values, PNG to look at")
      ->type_name("DIR");
  command->add_option("--fail-above", options->failAbove, "Exit with 1 if a figure is above; may be repeated")
      ->type_name("FIGURE=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--fail-below", options->failBelow, "Exit with 1 if a figure that is better high is below")
      ->type_name("FIGURE=VALUE")
      ->allow_extra_args(false);
  addSettingsHelp(*command, [] { return metricSettings(defaultMetrics(), displayPreset("schwarz_2009")); });
  command->callback([options, &exitCode, words] { exitCode = compare(*options, words); });
}

}  // namespace limen::perception
