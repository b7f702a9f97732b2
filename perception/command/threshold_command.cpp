// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive threshold: which luminance differences stay invisible in an image.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/text.h"
#include "perception/band_thresholds/reference.h"
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

/// Which map: thresholds by frequency band, combined by default, or the single map of the thesis.
enum class MapKind { Bands, Single };
constexpr EnumNames<MapKind, 2> enumNames(MapKind) {
  return {{{{MapKind::Bands, "bands"}, {MapKind::Single, "single"}}}};
}

struct ThresholdOptions : ImageOptions {
  std::string image, map = "bands";
  std::vector<std::string> outputs;
  double scaleCdM2 = 0.0;

  MapKind kind() const { return map == "single" ? MapKind::Single : MapKind::Bands; }
};

std::vector<SettingsGroup> thresholdGroups(MapKind kind) {
  return {{"", kind == MapKind::Single ? ThresholdMapSettings::table().parameters()
                                       : BandThresholdSettings::table().parameters()}};
}

/// A map and what else is said of it.
struct MapOfFrame {
  Plane thresholdCdM2;
  std::optional<Plane> adaptationCdM2;
  nlohmann::json extra = nlohmann::json::object();
};

/// Computes maps of one kind with settings.
struct MapMaker {
  MapKind kind;
  DisplayProfile display;
  ThresholdMapSettings single = {};
  BandThresholdSettings bands = {};

  MapMaker(MapKind wanted, DisplayProfile shownOn, const ParameterValues& values)
      : kind(wanted), display(std::move(shownOn)) {
    if (kind == MapKind::Single)
      single = ThresholdMapSettings::table().read(values);
    else
      bands = BandThresholdSettings::table().read(values);
  }

  std::string models() const {
    if (kind == MapKind::Single)
      return fmt::format("single threshold map (Schwarz 2009, section 9.4; csf {}, masking {}, tvi {}",
                         single.csf, single.masking, single.tvi);
    const PoppingSettings& predictor = bands.predictor;
    return fmt::format("threshold map by frequency band (csf {}, masking {}",
                       predictor.sensitivity.achromatic.csf.name, predictor.masking.name);
  }

  MapOfFrame make(const Image& shown) const {
    const Plane luminance = luminancePlane(shown, display);
    if (kind == MapKind::Single) {
      ThresholdMap map = computeThresholdMap(luminance, display.pixelsPerDegree(), single);
      return {
          std::move(map.thresholdCdM2), std::move(map.adaptationCdM2), {{"guarded_contrasts", map.guarded}}};
    }
    const BandThresholds thresholds = computeBandThresholds(luminance, display, bands);
    MapOfFrame out{thresholdMapOf(thresholds, bands), {}, {{"guarded_contrasts", thresholds.guarded}}};
    nlohmann::json list = nlohmann::json::array();
    for (const BandThreshold& band : thresholds.bands) {
      std::vector<double> values = band.thresholdCdM2.data;
      list.push_back({{"frequency_cpd", band.frequencyCpd}, {"median_cd_m2", nearestRank(values, 0.5)}});
    }
    out.extra["bands"] = std::move(list);
    return out;
  }
};

Figures thresholdFigures(const MapOfFrame& map) {
  std::vector<double> values = map.thresholdCdM2.data;
  CompensatedSum sum, luminance;
  for (const double value : values) sum.add(value);
  const auto pixels = static_cast<double>(values.size());
  const auto rank = [&](double share) { return nearestRank(values, share); };
  const auto [least, most] =
      std::minmax_element(map.thresholdCdM2.data.begin(), map.thresholdCdM2.data.end());
  const std::string unit = "cd/m2";
  Figures out = {
      {"min", unit, "", false, *least, {}},       {"p1", unit, "", false, rank(0.01), {}},
      {"p5", unit, "", false, rank(0.05), {}},    {"p25", unit, "", false, rank(0.25), {}},
      {"median", unit, "", false, rank(0.5), {}}, {"p75", unit, "", false, rank(0.75), {}},
      {"p95", unit, "", false, rank(0.95), {}},   {"p99", unit, "", false, rank(0.99), {}},
      {"max", unit, "", false, *most, {}},        {"mean", unit, "", false, sum.value() / pixels, {}}};
  if (!map.adaptationCdM2) return out;
  for (const double value : map.adaptationCdM2->data) luminance.add(value);
  out.push_back({"mean_adaptation",
                 unit,
                 "luminance to which the eye is adapted",
                 false,
                 luminance.value() / pixels,
                 {}});
  return out;
}

bool isPicture(const std::string& path) {
  const std::string end = std::filesystem::path(path).extension().string();
  return end == ".png" || end == ".PNG";
}

int threshold(const ThresholdOptions& options, const std::vector<std::string>& words) {
  if (options.list) {
    printSettings(options, thresholdGroups(options.kind()));
    return kExitSuccess;
  }
  if (options.image.empty())
    throw Error("an image is missing", "threshold", "give one: limen-perceive threshold IMAGE");
  const DisplayProfile display = readDisplay(options.displayName);
  const std::vector<SettingsGroup> groups = thresholdGroups(options.kind());
  const std::vector<ParameterValues> values = parseSettings(options.set, groups, "--set");
  const MapMaker maker(options.kind(), display, values.front());
  const ParameterValues input = options.input();
  const std::vector<ImageSequence> sequences = {expandImages(options.image)};
  const std::vector<FrameSet> frames = alignSequences(sequences);
  std::vector<std::string> files;
  for (const FrameSet& frame : frames) files.push_back(frame.paths.front());
  OutputFiles outputs(frames, files);
  for (const std::string& output : options.outputs) outputs.addFile("--output", output, {".exr", ".png"});

  ReportHeader header;
  header.command = "threshold";
  const std::string changed = changedSettings(groups, values);
  header.statement = fmt::format("{} {}{}), display {}", limenVersion(), maker.models(),
                                 changed.empty() ? "" : "; " + changed, display.line());
  header.words = words;
  header.display = display;
  header.settings = valuesAsJson(groups, values);
  header.settings["input"] = input.toJson();
  header.json = options.json;
  header.videos = videosOf(sequences);
  header.primaryFigures = {"median", "min", "max"};
  ReportPrinter printer(header, frames.size(), {});
  // Pictures of a sequence share the scale of the first frame.
  double scale = options.scaleCdM2;
  for (const FrameSet& frame : frames) {
    const InputImage image = readInput(frame, 0, display, input);
    const MapOfFrame map = namingFile(frame.label(), [&] { return maker.make(image.shown()); });
    FrameReport report;
    report.frame = frame;
    report.inputs = {{"image", &image}};
    report.figures = thresholdFigures(map);
    report.extra = map.extra;
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
      "threshold", "Threshold map: the luminance differences that the predictor does not see in an image");
  command
      ->add_option("IMAGE", options->image,
                   "Image, sequence (frame_%04d.png, frame_####.png, 'frames/*.png') or video")
      ->type_name("");
  command
      ->add_option(
          "--map", options->map,
          "bands: inverse of the JND predictor of 'compare', combined over frequency bands, or one band's "
          "(--set output=band); single: that of Schwarz 2009, section 9.4, for comparison: differences "
          "below it may be plainly visible")
      ->type_name("KIND")
      ->check(CLI::IsMember({"bands", "single"}))
      ->capture_default_str();
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
  addSettingsHelp(*command, [options] { return thresholdGroups(options->kind()); });
  command->callback([options, &exitCode, words] { exitCode = threshold(*options, words); });
}

}  // namespace limen::perception
