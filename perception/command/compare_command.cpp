// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive compare: how two images, sequences or videos differ.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

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
#include "perception/command/video_difference.h"
#include "perception/metrics/metric.h"

namespace limen::perception {
namespace {

struct CompareOptions : ImageOptions {
  CompareOptions() { displayName = "desktop_24"; }
  std::string test, reference, mapFolder;
  std::vector<std::string> metrics;
  bool all = false, regions = false;
  double framesPerSecond = 0.0;  ///< 0: that of the videos, if there are any
};

/// Named like a metric: the popping predictor on the pair, with nothing moving.
constexpr const char* kJnd = "jnd";

/// What to run, each with its settings (same order); `jnd` and ColorVideoVDP, which evaluates videos as a
/// whole, are separate from the metrics.
struct Selection {
  std::vector<std::string> metrics;
  bool jnd = false, video = false;
  std::vector<SettingsGroup> groups;  ///< of the metrics, then of ColorVideoVDP, then of jnd

  std::vector<std::string> names() const {
    std::vector<std::string> all = metrics;
    if (video) all.emplace_back(VideoDifference::kName);
    if (jnd) all.emplace_back(kJnd);
    return all;
  }
};

/// What everybody asks for first, in this order.
const std::vector<std::string>& usualMetrics() {
  static const std::vector<std::string> kNames = {"rmse", "psnr", "ssim", "flip", kJnd};
  return kNames;
}
const std::vector<std::string>& usualFigures() {
  static const std::vector<std::string> kNames = {"rmse", "psnr",        "ssim",
                                                  "flip", "largest_jnd", "visible_share"};
  return kNames;
}

/// Registered ones that take a pair of images; `jnd` is done here, on the CPU too.
std::vector<std::string> imageMetrics() {
  std::vector<std::string> names;
  for (const auto& [name, info] : MetricRegistry::instance().all())
    if (name != kJnd && !info.needsPath) names.push_back(name);
  return names;
}

std::vector<std::string> allMetrics() {
  std::vector<std::string> names = defaultMetrics();
  names.emplace_back(VideoDifference::kName);
  names.emplace_back(kJnd);
  return names;
}

Selection select(const std::vector<std::string>& asked, const DisplayProfile& display,
                 const std::string& displayName) {
  Selection out;
  for (auto name = asked.begin(); name != asked.end(); ++name) {
    if (std::find(asked.begin(), name, *name) != name)
      throw Error("'" + *name + "' is given twice", "--metrics", "give each metric once");
    if (*name == kJnd) {
      out.jnd = true;
    } else if (*name == VideoDifference::kName) {
      out.video = true;
    } else {
      out.metrics.push_back(*name);
    }
  }
  out.groups = metricSettings(out.metrics, display);
  if (out.video) out.groups.push_back(VideoDifference::settings(displayName));
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

/// Limits on and settings of anything but the usual figures and metrics ask for all of them.
bool needsAll(const CompareOptions& options) {
  const auto others = [](const std::vector<std::string>& texts, char end,
                         const std::vector<std::string>& usual) {
    return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
      return std::find(usual.begin(), usual.end(), text.substr(0, text.find(end))) == usual.end();
    });
  };
  return others(options.failAbove, '=', usualFigures()) || others(options.failBelow, '=', usualFigures()) ||
         others(options.set, '.', usualMetrics());
}

double valueOf(const Figures& figures, const std::string& name, double otherwise) {
  for (const Figure& figure : figures)
    if (figure.name == name && figure.value) return *figure.value;
  return otherwise;
}

/// FLIP averages over the image; a mean beyond this is plain to see.
constexpr double kPlainFlip = 0.1;

/// What the figures of one pair come down to, in a sentence.
std::string conclusion(const Figures& figures, bool identical, bool withJnd, const DisplayProfile& display) {
  if (identical) return "The images are identical.";
  const double largest = valueOf(figures, "largest_jnd", 0.0);
  const double share = valueOf(figures, "visible_share", 0.0);
  if (!withJnd) return "The images differ.";
  if (share > 0.0)
    return fmt::format(
        "A viewer can see the difference on the display {}: {:.2g} % of the pixels differ by 1 JND or more, "
        "at "
        "most by {:.3g} JND.",
        display.name, 100.0 * share, largest);
  const double flip = valueOf(figures, "flip", 0.0);
  if (flip >= kPlainFlip)
    return fmt::format(
        "The images differ plainly by FLIP ({:.2g}), though no pixel by 1 JND (at most {:.2g}): the JND "
        "model "
        "does not see changes that leave contrasts as they are, such as an even change of brightness.",
        flip, largest);
  return fmt::format(
      "A viewer is not expected to see the difference on the display {}: no pixel differs by 1 JND (at most "
      "{:.2g}).",
      display.name, largest);
}

/// The same of all frames.
struct Conclusions {
  size_t frames = 0, identical = 0, visible = 0;
  double worst = -1.0;
  std::string worstFrame;

  void add(const Figures& figures, bool same, const std::string& frame) {
    ++frames;
    identical += same;
    visible += valueOf(figures, "visible_share", 0.0) > 0.0;
    const double largest = valueOf(figures, "largest_jnd", 0.0);
    if (largest > worst) worst = largest, worstFrame = frame;
  }
  std::string sentence(bool withJnd, const DisplayProfile& display) const {
    if (identical == frames) return "The images are identical in every frame.";
    if (!withJnd) return fmt::format("The images differ in {} of {} frames.", frames - identical, frames);
    return fmt::format(
        "In {} of {} frames pixels differ by 1 JND or more on the display {}; most in {}, by {:.3g} JND.",
        visible, frames, display.name, worstFrame, worst);
  }
};

/// Frame rate of the videos among the inputs, or as stated; 0 if nothing says.
double rateOf(const CompareOptions& options, const std::vector<VideoFacts>& videos) {
  if (options.framesPerSecond > 0.0) return options.framesPerSecond;
  double rate = 0.0;
  for (const VideoFacts& facts : videos) {
    if (!(facts.framesPerSecond > 0.0)) continue;
    if (rate > 0.0 && facts.framesPerSecond != rate)
      throw Error(fmt::format("the videos have {:.6g} and {:.6g} frames/s", rate, facts.framesPerSecond),
                  "--fps", "state the rate at which both are shown");
    rate = facts.framesPerSecond;
  }
  return rate;
}

bool areIdentical(const InputImage& a, const InputImage& b) {
  return a.nonFinite == 0 && b.nonFinite == 0 && a.linear.channels == b.linear.channels &&
         a.linear.data == b.linear.data;
}

/// The popping predictor on the pair, with nothing moving.
void predictJnd(const InputImage& test, const InputImage& reference, const DisplayProfile& display,
                const PoppingSettings& settings, bool withRegions, FrameReport& report,
                std::vector<MetricMap>* maps) {
  PoppingInput pair;
  pair.actual = test.shown();
  pair.predicted = reference.shown();
  pair.linear = true;
  PoppingResult result = predictPopping(pair, display, settings);
  append(report.figures, poppingFigures(result));
  report.extra["jnd_model"] = poppingModelAsJson(result.model);
  if (withRegions) {
    report.text = regionTable(result);
    report.extra["regions"] = regionsAsJson(result);
  }
  if (maps) maps->push_back({kJnd, std::move(result.jnd)});
}

int compare(const CompareOptions& options, const std::vector<std::string>& words) {
  const DisplayProfile display = readDisplay(options.displayName);
  const bool usual = options.metrics.empty() && !options.all && !options.list && !needsAll(options);
  const Selection selected = select(!options.metrics.empty() ? options.metrics
                                    : usual                  ? usualMetrics()
                                                             : allMetrics(),
                                    display, options.displayName);
  if (options.list) {
    printSettings(options, selected.groups);
    return kExitSuccess;
  }
  if (options.test.empty() || options.reference.empty())
    throw Error("an image is missing", "compare", "give two: limen-perceive compare IMAGE REFERENCE");
  if (options.regions && !selected.jnd)
    throw Error("there are no regions without jnd", "--regions", "add jnd to --metrics");
  const std::vector<ParameterValues> values = parseSettings(options.set, selected.groups, "--set");
  const PoppingSettings popping =
      selected.jnd ? PoppingSettings::table().read(values.back()) : PoppingSettings{};
  const ParameterValues input = options.input();
  ImageMetrics metrics(selected.metrics, values);

  const std::vector<ImageSequence> sequences = {expandImages(options.test), expandImages(options.reference)};
  const std::vector<FrameSet> frames = alignSequences(sequences);
  std::vector<std::string> files;
  for (const FrameSet& frame : frames) files.insert(files.end(), frame.paths.begin(), frame.paths.end());
  const double rate = selected.video ? rateOf(options, videosOf(sequences)) : 0.0;
  std::optional<VideoDifference> video;
  if (selected.video)
    video.emplace(values[selected.metrics.size()], options.displayName, frames.size(), rate);
  Figures declared = metrics.declared();
  if (video) append(declared, VideoDifference::declared(video->isVideo()));
  if (selected.jnd) append(declared, declaredPoppingFigures());
  const std::vector<Limit> limits = parseLimits(options.failAbove, options.failBelow, declared, "");
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
  header.sentenceFirst = true;
  header.videos = videosOf(sequences);
  if (video && video->isVideo()) header.overallFigures = {VideoDifference::kVideoName};
  if (usual) header.shownFigures = usualFigures();
  header.primaryFigures = {"rmse", "psnr", "ssim", "de94", "flip", VideoDifference::kName, "largest_jnd"};
  ReportPrinter printer(header, frames.size(), limits);
  Conclusions conclusions;
  for (const FrameSet& frame : frames) {
    InputImage test = readInput(frame, 0, display, input);
    InputImage reference = readInput(frame, 1, display, input);
    matchInputs(test, reference);
    FrameReport report;
    report.frame = frame;
    report.inputs = {{"image", &test}, {"reference", &reference}};
    std::vector<MetricMap> maps;
    std::vector<MetricMap>* const wanted = options.mapFolder.empty() ? nullptr : &maps;
    report.figures = namingFile(frame.label(), [&] { return metrics.run(test, reference, wanted); });
    report.extra = metrics.facts();
    if (video) {
      append(report.figures, namingFile(frame.label(), [&] { return video->add(test, reference, wanted); }));
      report.extra[VideoDifference::kName] = video->facts();
    }
    if (selected.jnd) predictJnd(test, reference, display, popping, options.regions, report, wanted);
    for (const MetricMap& map : maps)
      writeMap(map, outputs.folder(options.mapFolder, frame), header.statement, report);
    const bool identical = areIdentical(test, reference);
    report.sentence = conclusion(report.figures, identical, selected.jnd, display);
    conclusions.add(report.figures, identical, frame.label());
    printer.add(report);
  }
  std::string sentence = conclusions.sentence(selected.jnd, display);
  if (video && video->isVideo()) {
    const Figures overall = video->finish();
    printer.addOverall(overall, {{VideoDifference::kName, video->facts()}});
    if (const std::string more = video->sentence(overall); !more.empty()) sentence += "\n" + more;
  }
  return printer.finish(sentence);
}

}  // namespace

void addCompareCommand(CLI::App& app, int& exitCode, const std::vector<std::string>& words) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* const command =
      app.add_subcommand("compare", "How an image differs from a reference, and whether a viewer can see it");
  command
      ->add_option("IMAGE", options->test,
                   "Image, sequence (frame_%04d.png, frame_####.png, 'frames/*.png') or video")
      ->type_name("");
  command
      ->add_option("REFERENCE", options->reference,
                   "Image, sequence or video to compare with; one image for all frames, or as many")
      ->type_name("");
  addImageOptions(*command, *options);
  CLI::Option* const all =
      command->add_flag("--all", options->all, "Every metric, not only rmse, psnr, ssim, flip and JND");
  command->add_flag("--regions", options->regions,
                    "The regions in which the change would pop as a switch between two frames");
  command
      ->add_option("--metrics", options->metrics,
                   "Only these: " + join(imageMetrics()) +
                       ", jnd (the popping predictor, nothing moving)")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->excludes(all);
  command
      ->add_option(
          "--fps", options->framesPerSecond,
          "Frames per second of the sequences, for color_video_vdp (default: as the videos state; of "
          "images none, each is then compared by itself)")
      ->type_name("RATE")
      ->check(CLI::Range(1.0, 1000.0));
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
  addSettingsHelp(*command,
                  [] { return select(allMetrics(), displayPreset("desktop_24"), "desktop_24").groups; });
  command->callback([options, &exitCode, words] { exitCode = compare(*options, words); });
}

}  // namespace limen::perception
