// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive compare: every metric on any two images or sequences.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/text.h"
#include "perception/command/frame_report.h"
#include "perception/command/image_commands.h"
#include "perception/command/image_metrics.h"
#include "perception/command/image_options.h"
#include "perception/command/map_picture.h"
#include "perception/command/output_files.h"
#include "perception/command/popping_report.h"
#include "perception/metrics/metric.h"

namespace limen::perception {
namespace {

struct CompareOptions : ImageOptions {
  std::string test, reference, mapFolder;
  std::vector<std::string> metrics;
};

/// Named like a metric: the popping predictor on the pair, with nothing moving.
constexpr const char* kJnd = "jnd";

/// What to run, each with its settings (same order); `jnd` is separate from the metrics.
struct Selection {
  std::vector<std::string> metrics;
  bool jnd = false;
  std::vector<SettingsGroup> groups;  ///< of the metrics, then of jnd

  std::vector<std::string> names() const {
    std::vector<std::string> all = metrics;
    if (jnd) all.emplace_back(kJnd);
    return all;
  }
};

Selection select(std::vector<std::string> asked, const DisplayProfile& display) {
  if (asked.empty()) {
    asked = defaultMetrics();
    asked.emplace_back(kJnd);
  }
  Selection out;
  for (auto name = asked.begin(); name != asked.end(); ++name) {
    if (std::find(asked.begin(), name, *name) != name)
      throw Error("'" + *name + "' is given twice", "--metrics", "give each metric once");
    if (*name == kJnd) {
      out.jnd = true;
    } else {
      out.metrics.push_back(*name);
    }
  }
  out.groups = metricSettings(out.metrics, display);
  if (out.jnd) out.groups.push_back({kJnd, PoppingSettings::table().parameters()});
  return out;
}

void append(Figures& figures, const Figures& more) {
  figures.insert(figures.end(), more.begin(), more.end());
}

/// EXR of the values and PNG for viewing.
void writeMap(const MetricMap& map, const std::string& folder, const std::string& statement,
              FrameReport& report) {
  const std::string base = (std::filesystem::path(folder) / map.name).string();
  const std::string description = map.name + "; " + statement;
  writeExr(base + ".exr", map.map, description);
  const std::string meaning = writeMapPicture(base + ".png", map.map, pictureScale(map.map), "", description);
  report.outputs.emplace_back(map.name, base + ".exr");
  report.outputs.emplace_back(map.name + " picture, " + meaning, base + ".png");
}

int compare(const CompareOptions& options, const std::vector<std::string>& words) {
  const DisplayProfile display = readDisplay(options.displayName);
  const Selection selected = select(options.metrics, display);
  if (options.list) {
    printSettings(options, selected.groups);
    return kExitSuccess;
  }
  if (options.test.empty() || options.reference.empty())
    throw Error("an image is missing", "compare", "give two: limen-perceive compare IMAGE REFERENCE");
  const std::vector<ParameterValues> values = parseSettings(options.set, selected.groups, "--set");
  const PoppingSettings popping =
      selected.jnd ? PoppingSettings::table().read(values.back()) : PoppingSettings{};
  const ParameterValues input = options.input();
  ImageMetrics metrics(selected.metrics, values);
  Figures declared = metrics.declared();
  if (selected.jnd) append(declared, declaredPoppingFigures());
  const std::vector<Limit> limits = parseLimits(options.failAbove, options.failBelow, declared, "");

  const ImageSequence tests = expandImages(options.test), references = expandImages(options.reference);
  const std::vector<FrameSet> frames = alignSequences({tests, references});
  std::vector<std::string> files;
  for (const FrameSet& frame : frames) files.insert(files.end(), frame.paths.begin(), frame.paths.end());
  OutputFiles outputs(frames, files);
  outputs.addFolder("--map", options.mapFolder);

  ReportHeader header;
  header.command = "compare";
  const std::string changed = changedSettings(selected.groups, values);
  header.statement =
      limenVersion() + " image comparison (" + join(selected.names()) +
      (selected.jnd ? ": popping predictor of " + poppingModelText(popping) + ", nothing moving" : "") +
      (changed.empty() ? "" : "; " + changed) + "), display " + display.line();
  header.words = words;
  header.display = display;
  header.settings = valuesAsJson(selected.groups, values);
  header.settings["input"] = input.toJson();
  header.json = options.json;
  header.primaryFigures = {"rmse", "psnr", "ssim", "de94", "flip", "largest_jnd"};
  ReportPrinter printer(header, frames.size(), limits);
  for (const FrameSet& frame : frames) {
    InputImage test = readInput(frame.paths[0], display, input);
    InputImage reference = readInput(frame.paths[1], display, input);
    matchInputs(test, reference);
    FrameReport report;
    report.frame = frame;
    report.inputs = {{"image", &test}, {"reference", &reference}};
    std::vector<MetricMap> maps;
    report.figures = namingFile(frame.label(), [&] {
      return metrics.run(test, reference, options.mapFolder.empty() ? nullptr : &maps);
    });
    report.extra = metrics.facts();
    if (selected.jnd) {
      PoppingInput pair;
      pair.actual = test.shown();
      pair.predicted = reference.shown();
      pair.linear = true;
      PoppingResult result = predictPopping(pair, display, popping);
      append(report.figures, poppingFigures(result));
      report.text = regionTable(result);
      report.extra["regions"] = regionsAsJson(result);
      report.extra["jnd_model"] = poppingModelAsJson(result.model);
      if (!options.mapFolder.empty()) maps.push_back({kJnd, std::move(result.jnd)});
    }
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
      app.add_subcommand("compare", "Difference between an image and a reference: every metric");
  command
      ->add_option("IMAGE", options->test,
                   "Image, or sequence: frame_%04d.png, frame_####.png, 'frames/*.png'")
      ->type_name("");
  command
      ->add_option("REFERENCE", options->reference,
                   "Image or sequence to compare with; one for all frames, or as many")
      ->type_name("");
  addImageOptions(*command, *options);
  command
      ->add_option("--metrics", options->metrics,
                   "Only these: " + join(MetricRegistry::instance().names()) +
                       ", jnd (the popping predictor, nothing moving)")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--map", options->mapFolder,
                   "Folder for the metrics' maps: EXR of the values, PNG for viewing")
      ->type_name("DIR");
  command
      ->add_option("--fail-above", options->failAbove,
                   "Exit with 1 if a figure is above a limit; may be repeated")
      ->type_name("FIGURE=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--fail-below", options->failBelow,
                   "Exit with 1 if a figure for which higher is better is below a limit")
      ->type_name("FIGURE=VALUE")
      ->allow_extra_args(false);
  addSettingsHelp(*command, [] { return select({}, displayPreset("schwarz_2009")).groups; });
  command->callback([options, &exitCode, words] { exitCode = compare(*options, words); });
}

}  // namespace limen::perception
