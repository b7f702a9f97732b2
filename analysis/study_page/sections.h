// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/study/analyses.h"
#include "analysis/study/rates.h"
#include "analysis/study/thresholds.h"
#include "analysis/study/validation.h"
#include "analysis/study_page/page_writer.h"
#include "analysis/study_page/session_facts.h"
#include "experiments/store/predictions.h"

namespace limen::analysis {

/// All that a page is made of.
struct StudyPage {
  StudyAnswers study;       ///< exclusions applied, unless they were refused
  StudyAnswers everything;  ///< the same sessions, nothing excluded
  bool exclusionsWanted = true, unfinishedWanted = false;
  store::StudyProtocol protocol;
  ProtocolText text;
  SessionFacts facts;
  StudyRates rates, allRates;  ///< of `study`, of `everything`
  std::vector<PartAnova> anova;
  std::vector<PartSensitivity> sensitivity;
  std::vector<PartFit> fits;
  std::vector<PartThresholds> thresholds;  ///< of adaptive parts
  std::vector<PartScale> scales;
  std::optional<StudyValidation> validation;
  std::string validationNote;  ///< why there is none although predictions are stored
  ValidationSetting validationSetting;

  /// Of a part, for names of files.
  std::string stem(const std::string& part) const;
};

// Each writes its section, figures and files, or nothing if the study has nothing for it.
void addHead(const StudyPage& page, PageWriter& out);
void addExclusions(const StudyPage& page, PageWriter& out);
void addRates(const StudyPage& page, PageWriter& out);
void addAnova(const StudyPage& page, PageWriter& out);
void addSensitivity(const StudyPage& page, PageWriter& out);
void addThresholds(const StudyPage& page, PageWriter& out);
void addFits(const StudyPage& page, PageWriter& out);
void addScales(const StudyPage& page, PageWriter& out);
void addValidation(const StudyPage& page, PageWriter& out);
void addAnswers(const StudyPage& page, PageWriter& out);
void addMethods(const StudyPage& page, PageWriter& out);
/// Last: lists the files that the others wrote.
void addProvenance(const StudyPage& page, PageWriter& out);

// Figures that take more than a few lines.
std::optional<Figure> rateFigure(const StudyPage& page, const StudyPart& part);
void addValidationFigures(const StudyPage& page, const PartValidation& part, PageWriter& out);

// What the methods say of them, "" if there are none.
std::string fitMethods(const StudyPage& page);
std::string thresholdMethods(const StudyPage& page);
std::string scaleMethods(const StudyPage& page);

/// One sentence that answers the protocol's question: thresholds of adaptive parts, rates and thresholds of
/// others, the best and worst items of pairs. "" if there is nothing to say.
std::string answerText(const StudyPage& page);

/// "a, b and c".
std::string listed(const std::vector<std::string>& items);
/// A rule of a protocol in words: "said yes in more than 25 % of the trials without a change".
std::string ruleText(const std::string& rule, double limit);

// What the methods say of the sessions, in English for a paper. Every number comes from the store; what that
// does not have is said not to have been recorded.
std::string participantsText(const StudyPage& page);
std::string apparatusText(const StudyPage& page);
/// Stimuli, task, order and numbers of trials of one part.
std::string procedureText(const StudyPart& part, const PartText* text, const PartFacts& facts);
/// "Trials came in an order shuffled for each session", by a kind of order of protocols.
std::string orderText(const std::string& kind, const std::string& what);

std::vector<std::string> listOf(const std::set<std::string>& set);

}  // namespace limen::analysis
