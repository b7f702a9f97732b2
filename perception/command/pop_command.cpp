// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive pop: where a change from one frame to another pops visibly, and how strongly.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/text.h"
#include "perception/command/frame_report.h"
#include "perception/command/image_commands.h"
#include "perception/command/image_options.h"
#include "perception/command/output_files.h"
#include "perception/command/popping_report.h"
#include "perception/image_analysis/motion_compensation.h"
#include "perception/image_analysis/optical_flow.h"
#include "perception/metrics/error_map.h"
#include "perception/popping/comparator.h"
#include "perception/popping/overlay.h"

namespace limen::perception {
namespace {

struct PopOptions : ImageOptions {
  std::string before, after, motion, oldMotion, overlay, jnd, stages;
  std::vector<std::string> weights;
};

/// What --motion takes besides a file.
constexpr const char *kNoMotion = "none", *kFlow = "flow";

/// Where displacements come from.
enum class MotionSource {
  None,         ///< nothing moves
  File,         ///< given
  Flow,         ///< optical flow from the previous frame of the same sequence
  Compensated,  ///< of one sequence: the previous frame is moved along the flow, then compared
};

std::vector<SettingsGroup> poppingGroups() { return {{"", PoppingSettings::table().parameters()}}; }

Figures allFigures() {
  Figures figures = declaredPoppingFigures();
  figures.push_back({"max_de94", "dE94", "comparator: largest CIE94 difference of a pixel", false, {}, {}});
  return figures;
}

/// Sequences of the call, in the order of FrameSet::paths.
enum Role : size_t { kOld, kNew, kMotion, kOldMotion, kFirstWeight };

/// Drops maps of frames that are not evaluated, such as the very first one.
void keepNumbersOf(const ImageSequence& frames, ImageSequence& maps) {
  if (frames.single || maps.single || maps.frames.empty() || !frames.frames.front().number ||
      !maps.frames.front().number)
    return;
  std::set<int64_t> wanted;
  for (const SequenceFrame& frame : frames.frames) wanted.insert(*frame.number);
  std::erase_if(maps.frames, [&](const SequenceFrame& map) { return wanted.count(*map.number) == 0; });
  if (maps.frames.empty())
    throw Error("'" + maps.argument + "' has none of the frames of '" + frames.argument + "'", "pop",
                "give maps with the frames' numbers");
}

bool isKeyword(const std::string& motion) { return motion == kNoMotion || motion == kFlow; }

/// OLD and NEW side by side, or each frame of one sequence with the next.
std::vector<ImageSequence> sequencesOf(const PopOptions& options) {
  const auto optional = [](const std::string& argument) {
    return argument.empty() ? ImageSequence{} : expandImages(argument);
  };
  ImageSequence before = expandImages(options.before), after = optional(options.after);
  if (after.frames.empty()) {
    if (before.single || before.frames.size() < 2)
      throw Error("'" + options.before + "' is one image", "pop",
                  "give two: limen-perceive pop OLD NEW; or a sequence, of which each frame is compared with "
                  "the next");
    if (!before.missing.empty())
      throw Error("'" + options.before + "' lacks frame " + std::to_string(before.missing.front()), "pop",
                  "frames compared with the next one must be consecutive");
    after = before;
    after.frames.erase(after.frames.begin());
    before.frames.pop_back();
    // A pair has the number of its new frame.
    for (size_t i = 0; i < before.frames.size(); ++i) before.frames[i].number = after.frames[i].number;
  }
  std::vector<ImageSequence> sequences = {
      before, after, optional(isKeyword(options.motion) ? "" : options.motion), optional(options.oldMotion)};
  for (const std::string& weight : options.weights) sequences.push_back(expandImages(weight));
  for (size_t i = kMotion; i < sequences.size(); ++i) {
    if (sequences[i].video)
      throw Error("'" + sequences[i].argument + "' is a video", i < kFirstWeight ? "--motion" : "--weight",
                  "maps hold numbers that no video format keeps: give EXR files");
    keepNumbersOf(after, sequences[i]);
  }
  return sequences;
}

MotionSource motionSource(const PopOptions& options, const std::vector<ImageSequence>& sequences) {
  if (isKeyword(options.motion) && !options.oldMotion.empty())
    throw Error("'" + options.motion + "' and a file contradict each other", "--old-motion",
                "leave it out, or give --motion a file too");
  if (!sequences[kMotion].frames.empty() || !sequences[kOldMotion].frames.empty()) return MotionSource::File;
  const bool alone = options.after.empty();
  const bool moves = !sequences[kOld].single || !sequences[kNew].single;
  if (options.motion == kFlow) {
    if (!moves)
      throw Error("two images alone do not show how the scene moves", "--motion",
                  "flow is found between the frames of a sequence or video");
    return alone ? MotionSource::Compensated : MotionSource::Flow;
  }
  // Between two frames of one sequence flow would explain away what pops, so it has to be asked for.
  return options.motion == kNoMotion || alone || !moves ? MotionSource::None : MotionSource::Flow;
}

const char* motionText(MotionSource source) {
  switch (source) {
    case MotionSource::File:
      return "motion given";
    case MotionSource::Flow:
      return "motion by optical flow";
    case MotionSource::Compensated:
      return "previous frame moved along optical flow";
    case MotionSource::None:
      break;
  }
  return "nothing moving";
}

/// Product of all weight maps.
Image readWeights(const FrameSet& frame, const InputImage& like) {
  Image product;
  for (size_t i = kFirstWeight; i < frame.paths.size(); ++i) {
    const Image map = readMap(frame.paths[i], "--weight", 1, like);
    if (product.data.empty()) product = Image(map.width, map.height, 1, 1.0F);
    for (size_t pixel = 0; pixel < product.pixels(); ++pixel)
      product.data[pixel] *= map.data[pixel * static_cast<size_t>(map.channels)];
  }
  return product;
}

void writeStages(const PoppingResult& result, const std::string& folder, const std::string& statement,
                 FrameReport& report) {
  for (const auto& [name, stage] : result.stages)
    writeExr((std::filesystem::path(folder) / (name + ".exr")).string(), stage, name + "; " + statement);
  report.outputs.emplace_back("stages (" + std::to_string(result.stages.size()) + " EXR files)", folder);
}

struct Call {
  const PopOptions& options;
  DisplayProfile display;
  ParameterValues input;
  PoppingSettings settings;
  std::string statement;
  MotionSource motion = MotionSource::None;
};

/// Pixel values, which optical flow works on, whatever the file holds.
Image flowPicture(const FrameSet& frame, Role role, const Call& call) {
  return displayPicture(readInput(frame, role, call.display, call.input).shown());
}

bool follows(const FrameSet& frame, const FrameSet& before) {
  return !frame.number || !before.number || *frame.number == *before.number + 1;
}

/// Displacements by optical flow; without a previous frame nothing moves. Returns a word for the result.
std::string estimateMotion(const Call& call, const FrameSet& frame, const FrameSet* previous,
                           PoppingInput& input) {
  if (call.motion == MotionSource::Compensated) {
    const CompensatedFrame moved = compensateMotion(
        input.predicted, input.actual, displayPicture(input.predicted), displayPicture(input.actual));
    input.actualDisplacement = moved.displacement;
    input.predicted = moved.picture;
    if (input.disocclusion.data.empty())
      input.disocclusion = Image(moved.weight.width, moved.weight.height, 1, 1.0F);
    for (size_t pixel = 0; pixel < moved.weight.pixels(); ++pixel)
      input.disocclusion.data[pixel] *= moved.weight.data[pixel];
    return "previous frame moved along optical flow";
  }
  if (!previous || !follows(frame, *previous)) return "none: there is no previous frame";
  input.actualDisplacement = opticalFlow(flowPicture(*previous, kNew, call), displayPicture(input.actual));
  input.predictedDisplacement =
      opticalFlow(flowPicture(*previous, kOld, call), displayPicture(input.predicted));
  return "optical flow";
}

void predict(const Call& call, const FrameSet& frame, const FrameSet* previous, const OutputFiles& outputs,
             ReportPrinter& printer) {
  InputImage before = readInput(frame, kOld, call.display, call.input);
  InputImage after = readInput(frame, kNew, call.display, call.input);
  matchInputs(before, after);
  PoppingInput input;
  input.actual = after.shown();
  input.predicted = before.shown();
  input.linear = true;
  input.isSwitch = true;
  if (!frame.paths[kMotion].empty())
    input.actualDisplacement = readMap(frame.paths[kMotion], "--motion", 2, after);
  if (!frame.paths[kOldMotion].empty())
    input.predictedDisplacement = readMap(frame.paths[kOldMotion], "--old-motion", 2, after);
  input.disocclusion = readWeights(frame, after);
  const bool estimated = call.motion == MotionSource::Flow || call.motion == MotionSource::Compensated;
  const std::string motion = estimated ? estimateMotion(call, frame, previous, input) : "";
  PoppingOptions wish;
  if (!call.options.stages.empty()) wish.stages = {"all"};
  const PoppingResult result = predictPopping(input, call.display, call.settings, wish);
  const LargestColourDifference difference = largestColourDifference(input, call.display);

  FrameReport report;
  report.frame = frame;
  report.inputs = {{"old", &before}, {"new", &after}};
  report.figures = poppingFigures(result);
  report.figures.push_back(allFigures().back());
  report.figures.back().value = difference.value;
  report.text = regionTable(result);
  report.warnings = poppingWarnings(result);
  report.extra = {{"regions", regionsAsJson(result)},
                  {"model", poppingModelAsJson(result.model)},
                  {"max_de94_at_px", {difference.x, difference.y}},
                  {"guarded_contrasts", result.guardedContrasts}};
  if (estimated) report.extra["motion"] = motion;
  const char* const names[] = {"motion", "old_motion"};
  for (size_t role = kMotion; role < kFirstWeight; ++role)
    if (!frame.paths[role].empty()) report.extra["maps"][names[role - kMotion]] = frame.paths[role];
  for (size_t i = kFirstWeight; i < frame.paths.size(); ++i)
    report.extra["maps"]["weights"].push_back(frame.paths[i]);

  if (!call.options.jnd.empty()) {
    const std::string path = outputs.file(call.options.jnd, frame);
    writeExr(path, result.jnd, "popping, JND; " + call.statement);
    report.outputs.emplace_back("difference map, JND", path);
  }
  if (!call.options.overlay.empty()) {
    const std::string path = outputs.file(call.options.overlay, frame);
    writePng(path, poppingOverlay(displayPicture(input.actual), result.regions),
             "popping regions, coloured by rating R; " + call.statement);
    report.outputs.emplace_back("overlay", path);
  }
  if (!call.options.stages.empty())
    writeStages(result, outputs.folder(call.options.stages, frame), call.statement, report);
  printer.add(report);
}

int pop(const PopOptions& options, const std::vector<std::string>& words) {
  if (options.list) {
    printSettings(options, poppingGroups());
    return kExitSuccess;
  }
  if (options.before.empty())
    throw Error("images are missing", "pop", "give two: limen-perceive pop OLD NEW");
  const std::vector<ParameterValues> values = parseSettings(options.set, poppingGroups(), "--set");
  Call call{options,
            readDisplay(options.displayName),
            options.input(),
            PoppingSettings::table().read(values.front()),
            {},
            MotionSource::None};
  const std::vector<Limit> limits = parseLimits(options.failAbove, options.failBelow, allFigures(), "rating");
  const std::vector<ImageSequence> sequences = sequencesOf(options);
  const std::vector<FrameSet> frames = alignSequences(sequences);
  call.motion = motionSource(options, sequences);
  std::vector<std::string> files;
  for (const FrameSet& frame : frames) files.insert(files.end(), frame.paths.begin(), frame.paths.end());
  OutputFiles outputs(frames, files);
  outputs.addFile("--overlay", options.overlay, {".png"});
  outputs.addFile("--jnd", options.jnd, {".exr"});
  outputs.addFolder("--stages", options.stages);

  const std::string changed = changedSettings(poppingGroups(), values);
  call.statement = limenVersion() + " popping predictor (" + poppingModelText(call.settings) + ", " +
                   motionText(call.motion) + (options.weights.empty() ? "" : ", weights given") +
                   (changed.empty() ? "" : "; " + changed) + "), display " + call.display.line();
  ReportHeader header;
  header.command = "pop";
  header.statement = call.statement;
  header.words = words;
  header.display = call.display;
  header.settings = valuesAsJson(poppingGroups(), values);
  header.settings["input"] = call.input.toJson();
  header.extra = {{"frames_are", options.after.empty() ? "each compared with the previous one" : "pairs"}};
  header.primaryFigures = {"rating", "region_count", "largest_jnd", "max_de94"};
  header.json = options.json;
  header.videos = videosOf(sequences);
  ReportPrinter printer(header, frames.size(), limits);
  const FrameSet* previous = nullptr;
  for (const FrameSet& frame : frames) {
    namingFile(frame.label(), [&] { predict(call, frame, previous, outputs, printer); });
    previous = &frame;
  }
  return printer.finish();
}

}  // namespace

void addPopCommand(CLI::App& app, int& exitCode, const std::vector<std::string>& words) {
  const auto options = std::make_shared<PopOptions>();
  CLI::App* const command = app.add_subcommand(
      "pop", "Popping: regions in which the change from an old to a new level of detail is visible");
  command
      ->add_option("OLD", options->before,
                   "The frame with the old level of detail, a sequence (frame_%04d.png, frame_####.png, "
                   "'frames/*.png') or a "
                   "video; if given alone: each frame against the next, for a static camera and scene unless "
                   "--motion flow")
      ->type_name("");
  command->add_option("NEW", options->after, "The same frame with the new level of detail")->type_name("");
  const auto file = [&](const char* name, std::string& target, const char* text) {
    command->add_option(name, target, text)->type_name("FILE");
  };
  command
      ->add_option(
          "--motion", options->motion,
          "EXR: displacement of each pixel against the previous frame (x, y; pixels). flow: estimated from "
          "the frames (default for OLD and NEW that are sequences or videos; with OLD alone the previous "
          "frame is moved along it before it is compared). none: nothing moves (default otherwise)")
      ->type_name("FILE|flow|none");
  file("--old-motion", options->oldMotion,
       "The same for the old level of detail (default: that of --motion)");
  command
      ->add_option("--weight", options->weights,
                   "Map of factors 0..1 on the difference (disocclusion, flicker); may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  file("--overlay", options->overlay, "PNG: regions coloured by rating on the new frame");
  file("--jnd", options->jnd, "EXR of the difference map in JND");
  command
      ->add_option("--stages", options->stages,
                   "Folder for EXR files of all intermediate images of the model")
      ->type_name("DIR");
  command
      ->add_option(
          "--fail-above", options->failAbove,
          "Exit with 1 if the rating (or FIGURE=VALUE: another figure) is above a limit; may be repeated")
      ->type_name("RATING")
      ->allow_extra_args(false);
  addImageOptions(*command, *options);
  addSettingsHelp(*command, poppingGroups);
  command->callback([options, &exitCode, words] { exitCode = pop(*options, words); });
}

}  // namespace limen::perception
