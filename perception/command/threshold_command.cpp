// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive threshold: which luminance differences stay invisible in an image.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/text.h"
#include "perception/command/frame_report.h"
#include "perception/command/image_commands.h"
#include "perception/command/image_options.h"
#include "perception/command/map_picture.h"
#include "perception/command/output_files.h"
#include "perception/metrics/quantile.h"
#include "perception/metrics/row_sums.h"
#include "perception/threshold_maps/reference.h"
#include "perception/threshold_maps/settings.h"

namespace limen::perception {
namespace {

struct ThresholdOptions : ImageOptions {
  std::string image;
  std::vector<std::string> outputs;
  double scaleCdM2 = 0.0;
};

std::vector<SettingsGroup> thresholdGroups() { return {{"", ThresholdMapSettings::table().parameters()}}; }

Figures thresholdFigures(const ThresholdMap& map) {
  std::vector<double> values = map.thresholdCdM2.data;
  CompensatedSum sum, luminance;
  for (const double value : values) sum.add(value);
  for (const double value : map.adaptationCdM2.data) luminance.add(value);
  const auto pixels = static_cast<double>(values.size());
  const auto rank = [&](double share) { return nearestRank(values, share); };
  const auto [least, most] =
      std::minmax_element(map.thresholdCdM2.data.begin(), map.thresholdCdM2.data.end());
  const std::string unit = "cd/m2";
  return {{"min", unit, "", false, *least, {}},
          {"p1", unit, "", false, rank(0.01), {}},
          {"p5", unit, "", false, rank(0.05), {}},
          {"p25", unit, "", false, rank(0.25), {}},
          {"median", unit, "", false, rank(0.5), {}},
          {"p75", unit, "", false, rank(0.75), {}},
          {"p95", unit, "", false, rank(0.95), {}},
          {"p99", unit, "", false, rank(0.99), {}},
          {"max", unit, "", false, *most, {}},
          {"mean", unit, "", false, sum.value() / pixels, {}},
          {"mean_adaptation",
           unit,
           "luminance to which the eye is adapted",
           false,
           luminance.value() / pixels,
           {}}};
}

bool isPicture(const std::string& path) {
  const std::string end = std::filesystem::path(path).extension().string();
  return end == ".png" || end == ".PNG";
}

int threshold(const ThresholdOptions& options, const std::vector<std::string>& words) {
  if (options.list) {
    printSettings(options, thresholdGroups());
    return kExitSuccess;
  }
  if (options.image.empty())
    throw Error("an image is missing", "threshold", "give one: limen-perceive threshold IMAGE");
  const DisplayProfile display = readDisplay(options.displayName);
  const std::vector<ParameterValues> values = parseSettings(options.set, thresholdGroups(), "--set");
  const ThresholdMapSettings settings = ThresholdMapSettings::table().read(values.front());
  const ParameterValues input = options.input();
  const std::vector<ImageSequence> sequences = {expandImages(options.image)};
  const std::vector<FrameSet> frames = alignSequences(sequences);
  std::vector<std::string> files;
  for (const FrameSet& frame : frames) files.push_back(frame.paths.front());
  OutputFiles outputs(frames, files);
  for (const std::string& output : options.outputs) outputs.addFile("--output", output, {".exr", ".png"});

  ReportHeader header;
  header.command = "threshold";
  const std::string changed = changedSettings(thresholdGroups(), values);
  header.statement =
      fmt::format("{} threshold map (Schwarz 2009, section 9.4; csf {}, masking {}, tvi {}{}), display {}",
                  limenVersion(), settings.csf, settings.masking, settings.tvi,
                  changed.empty() ? "" : "; " + changed, display.line());
  header.words = words;
  header.display = display;
  header.settings = valuesAsJson(thresholdGroups(), values);
  header.settings["input"] = input.toJson();
  header.json = options.json;
  header.videos = videosOf(sequences);
  header.primaryFigures = {"median", "min", "max"};
  ReportPrinter printer(header, frames.size(), {});
  // Pictures of a sequence share the scale of the first frame.
  double scale = options.scaleCdM2;
  for (const FrameSet& frame : frames) {
    const InputImage image = readInput(frame, 0, display, input);
    const ThresholdMap map = namingFile(frame.label(), [&] {
      return computeThresholdMap(luminancePlane(image.shown(), display), display.pixelsPerDegree(), settings);
    });
    FrameReport report;
    report.frame = frame;
    report.inputs = {{"image", &image}};
    report.figures = thresholdFigures(map);
    report.extra = {{"guarded_contrasts", map.guarded}};
    for (const std::string& output : options.outputs) {
      const std::string path = outputs.file(output, frame);
      const Image picture = toImage(map.thresholdCdM2);
      if (!isPicture(path)) {
        writeExr(path, picture, "threshold map, cd/m2; " + header.statement);
        report.outputs.emplace_back("threshold map, cd/m2", path);
        continue;
      }
      if (scale <= 0.0) scale = pictureScale(picture);
      const std::string meaning =
          writeMapPicture(path, picture, scale, "cd/m2", "threshold map; " + header.statement);
      report.extra["picture_scale_cd_m2"] = scale;
      report.outputs.emplace_back("picture, " + meaning, path);
    }
    printer.add(report);
  }
  return printer.finish();
}

}  // namespace

void addThresholdCommand(CLI::App& app, int& exitCode, const std::vector<std::string>& words) {
  const auto options = std::make_shared<ThresholdOptions>();
  CLI::App* const command = app.add_subcommand(
      "threshold", "Threshold map: the luminance differences that stay invisible in an image");
  command
      ->add_option("IMAGE", options->image,
                   "Image, sequence (frame_%04d.png, frame_####.png, 'frames/*.png') or video")
      ->type_name("");
  command
      ->add_option("-o,--output", options->outputs,
                   "EXR of the thresholds in cd/m2, or PNG for viewing; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      ->add_option("--scale", options->scaleCdM2,
                   "Threshold in cd/m2 shown as the brightest colour in a PNG (default: from the first map)")
      ->type_name("CD_M2")
      ->check(CLI::PositiveNumber);
  addImageOptions(*command, *options);
  addSettingsHelp(*command, thresholdGroups);
  command->callback([options, &exitCode, words] { exitCode = threshold(*options, words); });
}

}  // namespace limen::perception
