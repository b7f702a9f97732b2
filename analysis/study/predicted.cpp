// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/predicted.h"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {

namespace {

int levelOf(double value, const std::array<double, 3>& edges) {
  return 1 + static_cast<int>(
                 std::count_if(edges.begin(), edges.end(), [&](double edge) { return value >= edge; }));
}

void checkEdges(const std::array<double, 3>& edges, const std::string& option) {
  const bool finite = std::all_of(edges.begin(), edges.end(), [](double e) { return std::isfinite(e); });
  if (!finite || !(edges[0] < edges[1] && edges[1] < edges[2]))
    throw Error("the edges do not grow", option, "give three growing numbers");
}

}  // namespace

void checkScoreBins(const ScoreBins& bins) {
  checkEdges(bins.coverage, "--coverage-edges");
  checkEdges(bins.rating, "--rating-edges");
  if (bins.coverage.front() < 0.0 || bins.coverage.back() > 1.0)
    throw Error("coverage is a share from 0 to 1", "--coverage-edges", "write 0.05 for 5 %");
  if (bins.topRegions == 0) throw Error("no region would be averaged", "--top-regions", "give 1 or more");
}

int coverageLevel(double coverage, const ScoreBins& bins) { return levelOf(coverage, bins.coverage); }
int ratingLevel(double rating, const ScoreBins& bins) { return levelOf(rating, bins.rating); }

int detectionScore(int ratingLevel, int coverageLevel) {
  assert(ratingLevel >= 1 && ratingLevel <= 4 && coverageLevel >= 1 && coverageLevel <= 4);
  // Rows: very low, low, high, very high; columns: tiny, small, large, huge.
  constexpr int kTable[4][4] = {{1, 1, 2, 2}, {1, 2, 3, 3}, {2, 3, 4, 5}, {3, 3, 5, 5}};
  return kTable[ratingLevel - 1][coverageLevel - 1];
}

double ratingScore(std::vector<double> ratings, double without, size_t top) {
  if (ratings.empty()) return without;
  std::sort(ratings.begin(), ratings.end(), std::greater<>());
  const size_t count = std::min(top, ratings.size());
  return std::accumulate(ratings.begin(), ratings.begin() + static_cast<std::ptrdiff_t>(count), 0.0) /
         static_cast<double>(count);
}

const std::vector<PredictorName>& studyPredictors() {
  static const std::vector<PredictorName> kNames = {
      {"rating", "R of the region rated highest, at the cue if there is one"},
      {"rest_rating", "R of the region rated highest away from the cue"},
      {"detection_score", "Table 10.1 of rating score and coverage"},
      {"rating_score", "mean R of the most highly rated regions, at the cue if there is one"},
      {"rating_level", "level of that mean; what the thesis correlates as its rating score"},
      {"coverage_score", "level of the popping pixels' share of the object"},
      {"detection_probability", "of the rating, by the link that the prediction was made with"},
      {"largest_jnd", "largest visible difference"},
      {"coverage", "popping pixels' share of the window"},
      {"coverage_of_object", "popping pixels' share of the object"},
      {"region_count", "number of popping regions"},
      {"max_de94", "largest CIE94 difference of the frames"},
      {"mean_de94", "mean CIE94 difference of the frames"},
      {"flip", "mean FLIP of the frames"},
      {"one_minus_ssim", "1 - SSIM of the frames"},
      {"color_video_vdp", "10 - JOD of the frames by ColorVideoVDP"},
      {"color_video_vdp_clip", "10 - JOD of the clip around the change by ColorVideoVDP"},
      {"rmse", "RMS difference of light"},
      {"rmse_coded", "RMS difference of pixel values"}};
  return kNames;
}

std::map<std::string, double> predictorValues(const nlohmann::json& figures, const ScoreBins& bins) {
  std::map<std::string, double> out;
  const auto number = [&](const char* name) { return figures.contains(name) && figures[name].is_number(); };
  for (const PredictorName& predictor : studyPredictors())
    if (number(predictor.name.c_str())) out[predictor.name] = figures[predictor.name].get<double>();
  if (number("ssim")) out["one_minus_ssim"] = 1.0 - figures["ssim"].get<double>();
  if (number("rating") && figures.contains("regions")) {
    std::vector<double> ratings;
    for (const nlohmann::json& region : figures["regions"])
      if (region.value("at_cue", true)) ratings.push_back(region.at("rating").get<double>());
    out["region_count"] = static_cast<double>(figures["regions"].size());
    out["rating_score"] = ratingScore(ratings, out["rating"], bins.topRegions);
    const int rating = ratingLevel(out["rating_score"], bins);
    out["rating_level"] = rating;
    if (number("coverage_of_object")) {
      const int coverage = coverageLevel(out["coverage_of_object"], bins);
      out["coverage_score"] = coverage;
      out["detection_score"] = detectionScore(rating, coverage);
    }
  }
  return out;
}

std::map<std::string, std::string> displayNames(const std::string& store, const StudyAnswers& study,
                                                const std::vector<store::StudyPrediction>& predictions) {
  std::map<std::string, std::string> names;
  const store::SessionReader reader(store);
  for (const StudyAnswer& answer : study.answers)
    if (!names.count(answer.displayHash)) names[answer.displayHash] = reader.display(answer.displayHash).name;
  for (const store::StudyPrediction& one : predictions)
    if (!names.count(one.displayHash)) names[one.displayHash] = reader.display(one.displayHash).name;
  return names;
}

std::string wantedDisplay(const std::string& used, const std::map<std::string, std::string>& names,
                          const PredictionChoice& choice) {
  if (choice.display.empty()) return used;
  std::vector<std::string> fitting, known;
  for (const auto& [hash, name] : names) {
    known.push_back(name);
    if (name == choice.display || (choice.display.size() >= 8 && hash.rfind(choice.display, 0) == 0))
      fitting.push_back(hash);
  }
  if (fitting.empty())
    throw Error("no display '" + choice.display + "' in the store", "--display",
                suggest(choice.display, known));
  if (fitting.size() > 1)
    throw Error("several displays are named '" + choice.display + "'", "--display",
                "give the first digits of a SHA-256: " + join(fitting));
  return fitting.front();
}

ChosenPredictions choosePredictions(const std::vector<store::StudyPrediction>& predictions,
                                    const StudyPlan& plan, const std::set<PredictionKey>& wanted,
                                    const PredictionChoice& choice) {
  ChosenPredictions out;
  std::set<std::string> settings;
  for (auto one = predictions.rbegin(); one != predictions.rend() && out.settingsHash.empty(); ++one) {
    const std::string hash = store::settingsHash(one->settings);
    settings.insert(hash.substr(0, 12));
    if (!wanted.count({one->stimulusHash, one->displayHash})) continue;
    if (!choice.settings.empty() && hash.rfind(choice.settings, 0) != 0) continue;
    out.settingsHash = hash;
    out.programVersion = one->programVersion;
    out.version = one->settings.value("popping_version", 1);
  }
  if (!choice.settings.empty() && out.settingsHash.empty())
    throw Error("no prediction with settings '" + choice.settings + "'", "--settings",
                "known: " + join({settings.begin(), settings.end()}));
  for (const store::StudyPrediction& one : predictions)
    if (one.programVersion == out.programVersion && one.widthPx == plan.widthPx &&
        one.heightPx == plan.heightPx && store::settingsHash(one.settings) == out.settingsHash)
      out.values[{one.stimulusHash, one.displayHash}] = predictorValues(one.figures, choice.bins);
  const auto missing = std::count_if(wanted.begin(), wanted.end(),
                                     [&](const PredictionKey& key) { return out.values.count(key) == 0; });
  if (missing > 0)
    throw Error(fmt::format("{} of {} stimuli have no prediction", missing, wanted.size()), plan.name,
                "make them with limen study predict, for the display that is asked for");
  return out;
}

}  // namespace limen::analysis
