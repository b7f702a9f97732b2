// SPDX-License-Identifier: BSD-3-Clause
// limen study stimuli: what a protocol shows, as videos.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

#include "experiments/base/interrupt.h"
#include "experiments/base/replace_file.h"
#include "experiments/base/staged_folder.h"
#include "experiments/base/text.h"
#include "experiments/base/video.h"
#include "renderer/catalogue.h"
#include "renderer/gl/context.h"
#include "study/command/commands.h"
#include "study/protocol/describe.h"
#include "study/protocol/design.h"
#include "study/stimulus/stimulus_renderer.h"

namespace limen::study {
namespace {

struct StimuliOptions {
  std::string protocol, folder, display, ending = ".avi";
  uint64_t seed = 1;
};

/// A stimulus that trials show, with what it stands for.
struct Shown {
  Stimulus stimulus;
  std::string hash, part, condition;
  bool changes = true;
};

std::string conditionText(const std::map<std::string, std::string>& condition) {
  std::vector<std::string> words;
  for (const auto& [factor, level] : condition) words.push_back(factor + "=" + level);
  return join(words, "; ");
}

/// In order of their first trials, each once. `adaptive` counts trials whose stimulus a procedure chooses.
std::vector<Shown> shownBy(const Protocol& protocol, uint64_t seed, size_t& adaptive) {
  std::vector<Shown> out;
  std::set<std::string> known;
  const Design design = makeDesign(protocol, seed, 0);
  for (const PlannedBlock& block : design.blocks)
    for (const PlannedTrial& trial : block.trials) {
      if (trial.procedure >= 0) {
        ++adaptive;
        continue;
      }
      for (const Stimulus& stimulus : stimuliOf(protocol, trial)) {
        const std::string hash = stimulusHash(stimulus);
        if (!known.insert(hash).second) continue;
        out.push_back({stimulus, hash, protocol.parts.at(static_cast<size_t>(trial.part)).name,
                       conditionText(trial.condition), stimulus.changes});
      }
    }
  return out;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// Frames that look alike are rendered once and written as often as they are shown.
void writeStimulus(StimulusRenderer& renderer, const std::string& path) {
  VideoWriter writer(path, renderer.sizePx().x, renderer.sizePx().y, renderer.timeline().refreshHz);
  int held = -1;
  Image picture;
  for (int frame = 0; frame < renderer.frameCount(); ++frame) {
    throwIfInterrupted();
    if (renderer.pictureOf(frame) != held) picture = renderer.readBack(frame);
    held = renderer.pictureOf(frame);
    writer.add(picture);
  }
  writer.finish();
}

void writeStimuli(const StimuliOptions& options) {
  installInterruptHandlers();
  const Protocol protocol = readProtocol(options.protocol, catalogueFromRegistries());
  videoFormatOf("stimulus" + options.ending, "--format");
  const perception::DisplayProfile display =
      perception::readDisplay(options.display.empty() ? protocol.display : options.display);
  size_t adaptive = 0;
  const std::vector<Shown> stimuli = shownBy(protocol, options.seed, adaptive);
  if (stimuli.empty())
    throw Error("every stimulus of '" + protocol.name + "' is chosen by a procedure during the session",
                options.protocol, "videos can be made of stimuli that the protocol fixes");
  const std::unique_ptr<gl::Context> context = gl::createHeadlessContext();
  SceneCache scenes;
  const StagedFolder folder(options.folder);
  std::string table = "file,stimulus_sha256,part,condition,changes,frames,frames_per_second\n";
  for (size_t i = 0; i < stimuli.size(); ++i) {
    const Shown& shown = stimuli[i];
    const std::string name = fmt::format("stimulus_{:04d}{}", i + 1, options.ending);
    StimulusRenderer renderer(*context, shown.stimulus, {protocol.window.widthPx, protocol.window.heightPx},
                              display, &scenes);
    writeStimulus(renderer, (folder.path() / name).string());
    table +=
        fmt::format("{},{},{},{},{},{},{}\n", name, shown.hash, quoted(shown.part), quoted(shown.condition),
                    shown.changes, renderer.frameCount(), shortestNumber(renderer.timeline().refreshHz));
    std::fprintf(stderr, "%zu of %zu stimuli\n", i + 1, stimuli.size());
  }
  replaceFile((folder.path() / "stimuli.csv").string(), table);
  folder.putInPlaceAsNew();
  std::printf("%s: %zu videos and stimuli.csv, pixel values for display %s\n", options.folder.c_str(),
              stimuli.size(), display.name.c_str());
  if (adaptive > 0)
    std::printf("%zu trials are left out: a procedure chooses their stimuli during the session\n", adaptive);
}

}  // namespace

void addStimuliCommand(CLI::App& app, Run&) {
  CLI::App* command = app.add_subcommand(
      "stimuli",
      "Writes what a protocol shows as videos, one for each stimulus, and a table of them. Sessions\nrender "
      "their stimuli themselves; these are for looking at them and for publishing.");
  auto options = std::make_shared<StimuliOptions>();
  command->add_option("protocol", options->protocol, "Name of a shipped protocol, or a file")->required();
  command->add_option("-o,--output", options->folder, "Folder to create")->required();
  command->add_option("--format", options->ending, ".avi (JPEG pictures), .mkv (lossless), .mp4")
      ->capture_default_str();
  command->add_option("--display", options->display, "Preset or profile (default: the protocol's)");
  command->add_option("--seed", options->seed, "Seed of the session's orders")->capture_default_str();
  command->callback([options] { writeStimuli(*options); });
}

}  // namespace limen::study
