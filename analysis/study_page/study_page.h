// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/study/answers.h"

namespace limen::analysis {

struct StudyPageOptions {
  StudyChoice choice;  ///< protocol "": every one with sessions of the chosen observers
  std::string folder;
  bool ownFolders = false;  ///< each page in a folder of its own, even if it is the only one
};

/// What was written for one protocol.
struct StudyPageResult {
  std::string page, title, hash;
  size_t observers = 0, sessions = 0, answers = 0, figures = 0;
  bool simulated = false;
};

/// Writes a page for each protocol: report.html, tables/ and figures/ with SVG, PDF, script and data of each.
/// Several pages go into folders of their own below. Everything is read and made in a folder beside the named
/// one, and put in place at the end: an error leaves `folder` as it was. Throws Error as readStudyAnswers(),
/// for a folder that cannot be written, and as runGnuplot().
std::vector<StudyPageResult> writeStudyPages(const StudyPageOptions& options);

}  // namespace limen::analysis
