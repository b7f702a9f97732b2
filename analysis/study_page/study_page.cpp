// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study_page/study_page.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "analysis/output/page.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/error.h"
#include "experiments/base/staged_folder.h"

namespace limen::embedded {
extern const char* const kStudyPageCss;
}  // namespace limen::embedded

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;

/// Protocols that have a session which may count, in order of their first; or the one that was named.
std::vector<std::string> chosenProtocols(const StudyChoice& choice) {
  const store::SessionReader reader(choice.store);
  std::vector<std::string> all, finished;
  for (const store::StudySession& session : reader.sessions()) {
    indexIn(all, session.protocol);
    if (isOther(choice.observers, isSimulated(reader.environment(session.environment)))) continue;
    if (session.state == "finished" || choice.unfinished) indexIn(finished, session.protocol);
  }
  // Where there is nothing to choose, or nothing that counts, the reader of answers has the word.
  if (!choice.protocol.empty() || all.size() < 2 || finished.empty()) return {choice.protocol};
  return finished;
}

void readValidation(StudyPage& page, const StudyChoice& choice) {
  const std::vector<store::StudyPrediction> predictions = store::readPredictions(choice.store);
  const bool any =
      std::any_of(predictions.begin(), predictions.end(), [&](const store::StudyPrediction& one) {
        return std::any_of(
            page.study.answers.begin(), page.study.answers.end(),
            [&](const StudyAnswer& answer) { return answer.stimulusHash == one.stimulusHash; });
      });
  if (!any) return;
  // The page shows no interval of the link, whose bootstrap takes half a minute.
  page.validationSetting.samples = 0;
  try {
    page.validation = validateStudy(
        page.study, predictions, displayNames(choice.store, page.study, predictions), page.validationSetting);
  } catch (const Error& error) {
    page.validationNote = error.what();
  }
}

StudyPage readPage(const StudyChoice& choice) {
  StudyPage page;
  page.exclusionsWanted = choice.exclusions;
  page.unfinishedWanted = choice.unfinished;
  page.study = readStudyAnswers(choice);
  StudyChoice all = choice;
  all.exclusions = false;
  page.everything = readStudyAnswers(all);
  page.protocol = store::SessionReader(choice.store).protocol(page.study.plan.hash);
  page.text = readProtocolText(page.protocol);
  page.facts = readSessionFacts(choice, page.study.plan.hash);
  page.rates = studyRates(page.study);
  page.allRates = studyRates(page.everything);
  page.anova = studyAnova(page.study);
  page.sensitivity = studySensitivity(page.study);
  page.fits = studyFits(page.study, choice.store);
  page.thresholds = adaptiveThresholds(page.study);
  page.scales = studyScales(page.study);
  readValidation(page, choice);
  return page;
}

StudyPageResult writePage(const StudyPage& page, const fs::path& folder, const fs::path& shownFolder) {
  PageWriter out;
  addHead(page, out);
  addExclusions(page, out);
  // What a procedure was for comes before rates, which say more of it than of observers.
  const bool adaptive = !page.thresholds.empty();
  addThresholds(page, out);
  if (adaptive) addFits(page, out);
  addRates(page, out);
  addAnova(page, out);
  addSensitivity(page, out);
  if (!adaptive) addFits(page, out);
  addScales(page, out);
  addValidation(page, out);
  addAnswers(page, out);
  addMethods(page, out);
  addProvenance(page, out);
  fs::create_directories(folder / "figures");
  fs::create_directories(folder / "tables");
  for (const PageFile& file : out.files()) writeFileBytes((folder / file.path).string(), file.bytes);
  const auto drawn = drawFigures(out.figures(), (folder / "figures").string());
  writeFileBytes((folder / "report.html").string(),
                 renderDocument(page.study.plan.title, embedded::kStudyPageCss,
                                "<main class=\"study\">\n" + out.body(drawn) + "</main>\n"));
  const StudyAnswers& study = page.study;
  return {(shownFolder / "report.html").string(),
          study.plan.title,
          study.plan.hash,
          study.observers.size(),
          study.sessions,
          study.answers.size(),
          out.figures().size(),
          study.simulated > 0};
}

}  // namespace

std::string StudyPage::stem(const std::string& part) const {
  // Names that differ in what a file's name may not hold are told apart by their place.
  std::string own = slug(part);
  size_t same = 0, place = 0, index = 0;
  for (const StudyPart& one : study.plan.parts) {
    if (slug(one.name) == own) ++same;
    if (one.name == part) place = index;
    ++index;
  }
  if (own.empty()) own = "part";
  return same > 1 || slug(part).empty() ? own + "_" + std::to_string(place + 1) : own;
}

std::vector<StudyPageResult> writeStudyPages(const StudyPageOptions& options) {
  std::vector<StudyPage> pages;
  for (const std::string& protocol : chosenProtocols(options.choice)) {
    StudyChoice choice = options.choice;
    choice.protocol = protocol;
    pages.push_back(readPage(choice));
  }
  const StagedFolder staged(options.folder);
  std::vector<StudyPageResult> results;
  for (const StudyPage& page : pages) {
    const bool own = options.ownFolders || pages.size() > 1;
    const fs::path below = own ? slug(page.study.plan.title) + "_" + page.study.plan.hash.substr(0, 8) : "";
    results.push_back(writePage(page, staged.path() / below, fs::path(options.folder) / below));
  }
  staged.putInPlace();
  return results;
}

}  // namespace limen::analysis
