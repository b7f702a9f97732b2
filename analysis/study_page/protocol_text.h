// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/store/sessions.h"

namespace limen::analysis {

/// What a paper says of a part of a protocol. "" and 0: the protocol says nothing of it.
struct PartText {
  std::string name, question;
  std::vector<std::string> answers;
  std::string severityQuestion, confidenceQuestion;
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

}  // namespace limen::analysis
