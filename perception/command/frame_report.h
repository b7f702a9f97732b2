// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/video.h"
#include "perception/command/figures.h"
#include "perception/command/image_input.h"
#include "perception/command/image_sequence.h"
#include "perception/vision/display.h"

namespace limen::perception {

/// What applies to a whole call. With it and the files a call can be repeated.
struct ReportHeader {
  std::string command;             ///< "compare"
  std::string statement;           ///< one line fit for a paper
  std::vector<std::string> words;  ///< the command line as typed
  DisplayProfile display;
  nlohmann::json settings;  ///< every parameter with its value
  nlohmann::json extra;     ///< further members of the JSON result; an object or null
  std::vector<std::string>
      primaryFigures;  ///< shown for each frame of a sequence; the first determines the worst
  std::vector<std::string> shownFigures;    ///< in text; empty: all
  std::vector<std::string> overallFigures;  ///< that addOverall() will give
  std::vector<VideoFacts> videos;           ///< that are read
  bool sentenceFirst = false;  ///< of a single image: its sentence comes first, the statement last
  bool json = false;
};

/// The videos among them.
std::vector<VideoFacts> videosOf(const std::vector<ImageSequence>& sequences);

/// The result for one frame.
struct FrameReport {
  FrameSet frame;
  std::vector<std::pair<std::string, const InputImage*>> inputs;  ///< with their roles
  Figures figures;
  std::string sentence;  ///< what they come down to
  std::string text;      ///< further lines, shown for single images
  nlohmann::json extra;  ///< further members of the frame's JSON object; an object or null
  std::vector<std::pair<std::string, std::string>> outputs;  ///< what, path
  std::vector<std::string> warnings;                         ///< beyond those of the inputs
};

/// "Limen 0.1.0 (commit 0123456789)": the program that produced the result.
std::string limenVersion();

/// Prints what a command finds: text, or with --json one JSON object for a single image; for a sequence one
/// line per frame and a final summary line. Warnings go to stderr as well.
class ReportPrinter {
 public:
  ReportPrinter(ReportHeader header, size_t frames, std::vector<Limit> limits);

  /// Throws Error if a limit is on a figure that cannot be determined.
  void add(const FrameReport& report);
  /// Figures of all frames together, for the summary, with further members of its JSON object.
  void addOverall(const Figures& figures, const nlohmann::json& extra);
  /// Prints the summary. Returns the exit code: kExitFailedRuns if a limit was exceeded (said on stderr),
  /// else success.
  /// `sentence`, if given, says what the frames of a sequence come down to.
  int finish(const std::string& sentence = {});

 private:
  nlohmann::json headerJson() const;
  void printStatement() const;
  void printText(const FrameReport& report) const;
  /// Records which limits on figures of a frame, or on those of all frames together, are exceeded.
  void checkLimits(const Figures& figures, const std::string& prefix, bool overall);

  ReportHeader header_;
  size_t frames_;
  std::vector<Limit> limits_;
  FigureSummary summary_;
  Figures overall_;
  std::vector<std::string> exceeded_;
  size_t warnings_ = 0;
};

}  // namespace limen::perception
