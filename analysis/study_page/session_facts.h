// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/study/answers.h"
#include "experiments/store/sessions.h"

namespace limen::analysis {

/// What a paper says of a part of a protocol. "" and 0: the protocol says nothing of it.
struct PartText {
  std::string name, question;
  std::vector<std::string> answers;
  std::string severityQuestion;
  std::vector<std::string> severityLabels, confidenceLabels;
  std::string order;                ///< of trials: a kind; "shuffle" if left out, as protocols mean it
  std::string blockBy, blockOrder;  ///< factor, and a kind or the levels in their order; "fixed" if left out
  int breakEveryTrials = 0;
  bool practiceFeedback = false;
  std::string procedure;  ///< type of the procedure that chose the stimuli
};

struct FormText {
  std::string name, label;
  std::vector<std::string> choices;
};

/// Source, question and procedure of a protocol, from the text that is stored with its sessions.
struct ProtocolText {
  std::string question, source, partOrder;
  std::string background;  ///< of the window, linear light
  std::vector<PartText> parts;
  std::vector<FormText> form;

  const PartText* part(const std::string& name) const;
};

/// Only what is named here is read: the protocol was checked when its sessions were run. Throws Error on text
/// that is no YAML.
ProtocolText readProtocolText(const store::StudyProtocol& protocol);

/// A display as it was stored; what its profile lacks is missing.
struct DisplayFacts {
  std::string hash, name, transfer;
  std::optional<double> widthPx, heightPx, widthM, heightM, distanceM;
  std::optional<double> blackCdM2, peakCdM2, ambientLux, refreshHz;
  nlohmann::json calibration;  ///< how it was measured; {}: it was not

  /// Of the screen's middle: 2 d tan(1/2 degree) / pitch. None if size, distance or resolution are missing.
  std::optional<double> pixelsPerDegree() const;
};

/// Numbers of something for each observer: the least and the most.
struct CountRange {
  size_t least = 0, most = 0;
  std::string text() const;  ///< "3", "2 to 3"
};

/// What the showings of a part's trials say of its stimuli and its course.
struct PartFacts {
  std::set<std::string> scenes, presentations;
  std::set<double> durationsS, showings;
  CountRange answers;  ///< of an observer, practice and what does not count left out
  CountRange changeRepetitions, catchRepetitions;  ///< of an observer in a condition
  CountRange practice;                             ///< practice trials of an observer
  size_t notValid = 0;                             ///< showings that were disturbed
  size_t conditions = 0;
  bool severityAlways = false;  ///< asked after another answer than yes, too
};

/// A session without what could tell who it was or when.
struct SessionRow {
  std::string participant, name, state, display, programVersion;
  size_t answers = 0;
  bool used = false;  ///< finished, or taken although it is not
};

/// Of the sessions that a page is about: with what, when and by whom they were run.
struct SessionFacts {
  std::vector<DisplayFacts> displays;
  std::set<std::string> renderers, openGl, systems, programVersions, doubts;
  std::set<std::string> observerKinds;  ///< of simulated observers
  size_t softwareRenderer = 0;
  std::string firstDay, lastDay;  ///< "2026-01-31"; no time of day. "" for simulated observers
  std::map<std::string, std::map<std::string, size_t>> form;  ///< field -> choice -> participants
  size_t participants = 0;
  std::map<std::string, PartFacts> parts;
  std::vector<SessionRow> sessions;
};

/// Reads what readStudyAnswers(choice) reads. `hash` is that of the protocol. Throws Error.
SessionFacts readSessionFacts(const StudyChoice& choice, const std::string& hash);

}  // namespace limen::analysis
