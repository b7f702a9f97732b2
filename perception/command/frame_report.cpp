// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/frame_report.h"

#include <algorithm>
#include <cstdio>

#include "experiments/base/build_facts.h"
#include "experiments/base/error.h"
#include "experiments/base/printable.h"
#include "experiments/base/text.h"
#include "perception/command/video_inputs.h"

namespace limen::perception {
namespace {

void printLine(const nlohmann::json& object) {
  // File names need not be UTF-8.
  std::printf("%s\n", object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  std::fflush(stdout);  // so that readers can follow frame by frame
}

nlohmann::json displayJson(const DisplayProfile& display) {
  return {{"name", display.name},
          {"line", display.line()},
          {"hash", display.hash()},
          {"pixels_per_degree", display.pixelsPerDegree()},
          {"profile", toYaml(display)}};
}

nlohmann::json frameJson(const FrameReport& report, const std::vector<std::string>& warnings) {
  nlohmann::json out = {{"frame", report.frame.label()}, {"figures", figuresAsJson(report.figures)}};
  if (report.frame.number) out["number"] = *report.frame.number;
  nlohmann::json units = nlohmann::json::object(), unavailable = nlohmann::json::object();
  for (const Figure& figure : report.figures) {
    units[figure.name] = figure.unit;
    if (!figure.value && !figure.reason.empty()) unavailable[figure.name] = figure.reason;
  }
  out["units"] = units;
  if (!unavailable.empty()) out["unavailable"] = unavailable;
  for (const auto& [role, input] : report.inputs) out["inputs"][role] = input->toJson();
  for (const auto& [what, path] : report.outputs) out["outputs"][what] = path;
  if (!report.sentence.empty()) out["sentence"] = report.sentence;
  out["warnings"] = warnings;
  if (report.extra.is_object()) out.update(report.extra);
  return out;
}

std::vector<std::string> allWarnings(const FrameReport& report) {
  std::vector<std::string> out;
  for (const auto& [role, input] : report.inputs)
    for (const std::string& warning : input->warnings) out.push_back(input->path + ": " + warning);
  out.insert(out.end(), report.warnings.begin(), report.warnings.end());
  return out;
}

}  // namespace

std::vector<VideoFacts> videosOf(const std::vector<ImageSequence>& sequences) {
  std::vector<VideoFacts> out;
  for (const ImageSequence& sequence : sequences) {
    if (!sequence.video) continue;
    const VideoFacts& facts = videoInput(sequence.argument).facts();
    const bool known = std::any_of(out.begin(), out.end(),
                                   [&](const VideoFacts& other) { return other.path == facts.path; });
    if (!known) out.push_back(facts);
  }
  return out;
}

std::string limenVersion() {
  std::string commit = buildCommit();
  const bool dirty = commit.find("-dirty") != std::string::npos;
  return "Limen " + projectVersion() + " (commit " + commit.substr(0, 10) + (dirty ? "-dirty)" : ")");
}

ReportPrinter::ReportPrinter(ReportHeader header, size_t frames, std::vector<Limit> limits)
    : header_(std::move(header)), frames_(frames), limits_(std::move(limits)) {
  if (!header_.json && !(header_.sentenceFirst && frames_ == 1)) printStatement();
}

void ReportPrinter::printStatement() const {
  std::printf("%s\n", header_.statement.c_str());
  // A single frame's line says it all.
  if (frames_ > 1)
    for (const VideoFacts& facts : header_.videos) std::printf("%s\n", videoLine(facts).c_str());
}

nlohmann::json ReportPrinter::headerJson() const {
  nlohmann::json limits = nlohmann::json::array();
  for (const Limit& limit : limits_)
    limits.push_back({{"figure", limit.figure}, {limit.below ? "fail_below" : "fail_above", limit.value}});
  nlohmann::json out = {{"command", header_.command},   {"statement", header_.statement},
                        {"version", projectVersion()},  {"commit", buildCommit()},
                        {"call", header_.words},        {"display", displayJson(header_.display)},
                        {"settings", header_.settings}, {"limits", limits},
                        {"exceeded", exceeded_}};
  for (const VideoFacts& facts : header_.videos)
    out["videos"].push_back({{"path", facts.path},
                             {"frames", facts.frames},
                             {"frames_per_second", facts.framesPerSecond},
                             {"codec", facts.codec},
                             {"colour", facts.colour},
                             {"decoder", facts.decoder}});
  if (header_.extra.is_object()) out.update(header_.extra);
  return out;
}

void ReportPrinter::printText(const FrameReport& report) const {
  if (frames_ == 1) {
    const auto printInputs = [&] {
      size_t width = 0;
      for (const auto& [role, input] : report.inputs) width = std::max(width, role.size());
      for (const auto& [role, input] : report.inputs)
        std::printf("%-*s  %s\n", static_cast<int>(width), role.c_str(), input->line().c_str());
    };
    if (header_.sentenceFirst) {
      std::printf("%s\n", report.sentence.c_str());
    } else {
      printInputs();
    }
    std::printf("\n%s", figureTable(shownOf(report.figures, header_.shownFigures)).c_str());
    if (!report.text.empty()) std::printf("\n%s", report.text.c_str());
    if (!report.outputs.empty()) std::printf("\n");
    for (const auto& [what, path] : report.outputs) std::printf("%s: %s\n", what.c_str(), path.c_str());
    if (header_.sentenceFirst) {
      std::printf("\n");
      printInputs();
      printStatement();
    }
  } else {
    std::string line;
    for (const std::string& name : header_.primaryFigures)
      for (const Figure& figure : report.figures)
        if (figure.name == name)
          line +=
              (line.empty() ? "" : ", ") + name + " " + (figure.value ? numberText(*figure.value) : "none");
    std::printf("%s: %s\n", report.frame.label().c_str(), line.c_str());
  }
  std::fflush(stdout);
}

void ReportPrinter::add(const FrameReport& report) {
  const std::vector<std::string> warnings = allWarnings(report);
  warnings_ += warnings.size();
  const std::string prefix = frames_ > 1 ? report.frame.label() + ": " : "";
  for (const std::string& warning : warnings)
    std::fprintf(stderr, "limen-perceive: %swarning: %s\n", printable(prefix).c_str(),
                 printable(warning).c_str());
  checkLimits(report.figures, prefix, false);
  summary_.add(report.figures, report.frame.label());

  if (!header_.json) {
    printText(report);
    return;
  }
  nlohmann::json line = frameJson(report, warnings);
  line["event"] = frames_ == 1 ? "result" : "frame";
  if (frames_ == 1) line.update(headerJson());
  printLine(line);
}

void ReportPrinter::checkLimits(const Figures& figures, const std::string& prefix, bool overall) {
  std::vector<Limit> own;
  for (const Limit& limit : limits_) {
    const bool isOverall = std::find(header_.overallFigures.begin(), header_.overallFigures.end(),
                                     limit.figure) != header_.overallFigures.end();
    if (isOverall == overall) own.push_back(limit);
  }
  for (const std::string& words : exceeded(figures, own)) exceeded_.push_back(prefix + words);
}

void ReportPrinter::addOverall(const Figures& figures, const nlohmann::json& extra) {
  checkLimits(figures, "", true);
  overall_.insert(overall_.end(), figures.begin(), figures.end());
  if (!header_.extra.is_object()) header_.extra = nlohmann::json::object();
  header_.extra.update(extra);
}

int ReportPrinter::finish(const std::string& sentence) {
  const std::string worst =
      header_.primaryFigures.empty() ? "" : summary_.worstFrame(header_.primaryFigures.front());
  if (frames_ > 1 && header_.json) {
    nlohmann::json line = headerJson();
    line["event"] = "summary";
    line["frames"] = frames_;
    line["figures"] = summary_.toJson();
    line["worst_frame"] = worst.empty() ? nlohmann::json() : nlohmann::json(worst);
    line["worst_by"] = header_.primaryFigures.empty() ? "" : header_.primaryFigures.front();
    line["warning_count"] = warnings_;
    if (!overall_.empty()) line["overall"] = figuresAsJson(overall_);
    if (!sentence.empty()) line["sentence"] = sentence;
    printLine(line);
  } else if (frames_ > 1) {
    if (!sentence.empty()) std::printf("\n%s\n", sentence.c_str());
    std::printf("\n%zu frames\n%s", frames_, summary_.table(header_.shownFigures).c_str());
    if (!overall_.empty()) std::printf("all frames together\n%s", figureTable(overall_).c_str());
    if (!worst.empty())
      std::printf("worst frame by %s: %s\n", header_.primaryFigures.front().c_str(), worst.c_str());
  }
  for (const std::string& words : exceeded_)
    std::fprintf(stderr, "limen-perceive: %s\n", printable(words).c_str());
  return exceeded_.empty() ? kExitSuccess : kExitFailedRuns;
}

}  // namespace limen::perception
