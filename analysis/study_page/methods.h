// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "analysis/study_page/sections.h"

namespace limen::analysis {

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
