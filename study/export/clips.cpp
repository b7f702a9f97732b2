// SPDX-License-Identifier: BSD-3-Clause
#include "study/export/clips.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/image.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/replace_file.h"
#include "experiments/base/staged_folder.h"
#include "experiments/base/video.h"
#include "experiments/store/predictions.h"
#include "perception/vision/display_yaml.h"
#include "renderer/gl/context.h"
#include "study/stimulus/stimulus_renderer.h"
#include "study/stimulus/stored_window.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;

/// A stimulus in one window of one display.
struct Clip {
  nlohmann::json stimulus;
  std::string stimulusHash, displayHash;
  glm::ivec2 windowPx{0};
};

/// The clips by name, and the table of the trials that showed them.
struct Seen {
  std::map<std::string, Clip> clips;
  Table trials;
};

Seen readSeen(const ClipRequest& request) {
  Seen out;
  out.trials.columns = {{"subject", "Pseudonym of the participant", "", {}},
                        {"session", "Name of the sitting", "", {}},
                        {"part", "Part of the protocol", "", {}},
                        {"trial", "Number in the session's plan", "", {}},
                        {"attempt", "Attempt at that trial, from 0", "", {}},
                        {"interval", "Interval or position, from 1", "", {}},
                        {"clip", "Name of what was shown", "", {}}};
  const store::SessionReader reader(request.sessions.store);
  std::map<std::string, glm::ivec2> windows;  // by protocol
  for (const ExportedSession& session : loadSessions(request.sessions)) {
    const auto [window, fresh] = windows.try_emplace(session.protocolHash);
    if (fresh) window->second = windowOf(reader.protocol(session.protocolHash), request.sessions.store);
    for (const store::StudyTrial& trial : session.trials)
      for (size_t i = 0; i < trial.stimuli.size(); ++i) {
        const std::string& hash = trial.stimulusHashes.at(i);
        const std::string name =
            store::clipName(hash, session.displayHash, window->second.x, window->second.y);
        out.clips.try_emplace(name, Clip{trial.stimuli[i], hash, session.displayHash, window->second});
        out.trials.add({session.subject, session.name, trial.part, std::to_string(trial.number),
                        std::to_string(trial.attempt), std::to_string(i + 1), name});
      }
  }
  return out;
}

/// Light relative to the display's white.
Image lightOf(Image codes, const perception::DisplayProfile& display) {
  for (float& value : codes.data) value = static_cast<float>(display.decode(value));
  return codes;
}

/// A clip's frames in every format; `reference`: as if nothing changed.
void writeFrames(StimulusRenderer& renderer, const fs::path& base, const std::vector<std::string>& formats,
                 const perception::DisplayProfile& display, bool reference) {
  const Timeline& timeline = renderer.timeline();
  std::vector<std::unique_ptr<VideoWriter>> videos;
  bool light = false;
  for (const std::string& format : formats) {
    if (format == ".exr") {
      light = true;
      fs::create_directories(base);
    } else {
      videos.push_back(std::make_unique<VideoWriter>(base.string() + format, renderer.sizePx().x,
                                                     renderer.sizePx().y, timeline.refreshHz));
    }
  }
  // Frames that look alike are rendered once; of these only the first is written as light.
  int held = -1;
  double heldTimeS = 0.0;
  Image picture;
  for (int frame = 0; frame < renderer.frameCount(); ++frame) {
    throwIfInterrupted();
    const double timeS = timeline.sceneTimeS(frame);
    const bool same = reference ? held >= 0 && timeS == heldTimeS : renderer.pictureOf(frame) == held;
    if (!same) {
      picture = reference ? renderer.readBackState(timeS, false) : renderer.readBack(frame);
      if (light)
        writeExr((base / fmt::format("frame_{:04d}.exr", frame)).string(), lightOf(picture, display),
                 "light relative to the white of display " + display.name);
    }
    held = reference ? 0 : renderer.pictureOf(frame);
    heldTimeS = timeS;
    for (const auto& video : videos) video->add(picture);
  }
  for (const auto& video : videos) video->finish();
}

}  // namespace

WrittenClips writeClips(const ClipRequest& request) {
  for (const std::string& format : request.formats)
    if (format != ".exr") videoFormatOf("clip" + format, "--clip-format");
  if (request.formats.empty())
    throw Error("no format of clips is named", "--clip-format", "give .mkv or .exr");
  const Seen seen = readSeen(request);
  const store::SessionReader reader(request.sessions.store);
  const std::unique_ptr<gl::Context> context = gl::createHeadlessContext();
  SceneCache scenes;
  const Readers readers = request.sessions.codes ? Readers::OwnerOnly : Readers::Usual;
  const StagedFolder folder(request.folder, readers);
  Table clips;
  clips.columns = {
      {"clip", "Name: the beginning of its files' names", "", {}},
      {"reference", "Name of the same clip without the change; none without a change", "", {}},
      {"stimulus_hash", "SHA-256 of the stimulus", "", {}},
      {"display", "Display it was shown on", "", {}},
      {"display_hash", "SHA-256 of that display", "", {}},
      {"width", "Width of the window", "px", {}},
      {"height", "Height of the window", "px", {}},
      {"frames_per_second", "Frames per second", "Hz", {}},
      {"frames", "Frames shown", "", {}},
      {"change_frame", "First frame after the change, from 0; none without a change", "", {}},
      {"video", "Its video; none without one", "", {}},
      {"pictures", "Folder of its frames as light, each frame that differs from the one before", "", {}}};
  size_t done = 0;
  for (const auto& [name, clip] : seen.clips) {
    const store::StudyDisplay stored = reader.display(clip.displayHash);
    const perception::DisplayProfile display = perception::displayFromYaml(stored.profile, stored.name);
    StimulusRenderer renderer(*context, stimulusFromJson(clip.stimulus), clip.windowPx, display, &scenes);
    writeFrames(renderer, folder.path() / name, request.formats, display, false);
    const Timeline& timeline = renderer.timeline();
    const bool changes = timeline.changed < timeline.frames;
    if (changes) writeFrames(renderer, folder.path() / (name + "_reference"), request.formats, display, true);
    std::optional<std::string> videoFile, pictures;
    for (const std::string& format : request.formats)
      (format == ".exr" ? pictures : videoFile) = name + (format == ".exr" ? "" : format);
    clips.add({name, changes ? std::optional(name + "_reference") : std::nullopt, clip.stimulusHash,
               stored.name, clip.displayHash, std::to_string(clip.windowPx.x),
               std::to_string(clip.windowPx.y), toText(timeline.refreshHz), std::to_string(timeline.frames),
               changes ? std::optional(std::to_string(timeline.changed)) : std::nullopt, videoFile,
               pictures});
    if (request.progress) request.progress(++done, seen.clips.size());
  }
  replaceFile((folder.path() / "clips.csv").string(), toCsv(clips), {}, readers);
  replaceFile((folder.path() / "clip_trials.csv").string(), toCsv(seen.trials), {}, readers);
  folder.putInPlaceAsNew();
  return {seen.clips.size(), seen.trials.rows.size(), {"clips.csv", "clip_trials.csv"}};
}

}  // namespace limen::study
