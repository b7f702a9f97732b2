// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/published.h"

#include <algorithm>

namespace limen::analysis {
namespace {

const char* const kFirst = "Schwarz 2009, section 10.4.1";
const char* const kSecond = "Schwarz 2009, section 10.4.2";

}  // namespace

const std::vector<PublishedDesign>& publishedDesigns() {
  static const std::vector<PublishedDesign> kAll = {{"experiment_1", 8, 112, kFirst},
                                                    {"experiment_2", 12, 64, kSecond}};
  return kAll;
}

const std::vector<PublishedRateOf>& publishedRates() {
  static const std::vector<PublishedRateOf> kAll = {
      {"experiment_1", "main", true, {0.6771, 0.1201, kFirst}},
      {"experiment_1", "main", false, {0.0446, 0.0458, kFirst}},
      {"experiment_2", "object", true, {0.6146, 0.1661, kSecond}},
      {"experiment_2", "object", false, {0.0417, 0.0487, kSecond}},
      {"experiment_2", "terrain", true, {0.6771, 0.3359, kSecond}},
      {"experiment_2", "terrain", false, {0.0313, 0.0421, kSecond}}};
  return kAll;
}

const std::vector<PublishedScenariosOf>& publishedScenarios() {
  static const std::vector<PublishedScenariosOf> kAll = {
      {"experiment_2",
       "terrain",
       "static",
       {0.75, 0.0833, 2.20, 0.24, "coverage at least large, rating at least high", 3, 3,
        "an SD of 8.33 % comes of dividing by n, and of no eight rates of twelve observers by n - 1: SDs "
        "over scenarios are taken by n",
        kSecond}}};
  return kAll;
}

const std::vector<PublishedEffectOf>& publishedEffects() {
  static const std::vector<PublishedEffectOf> kAll = {
      {"experiment_1", "main", {"lod_change"}, {98.926, 1, 7, "< 0.0001", false, "", kFirst}},
      {"experiment_1", "main", {"switch_distance"}, {30.226, 6, 42, "< 0.0001", false, "", kFirst}},
      {"experiment_1", "main", {"lod_change", "switch_distance"}, {3.139, 6, 42, "0.012", false, "", kFirst}},
      {"experiment_1", "main", {"presentation"}, {29.377, 1, 7, "< 0.001", false, "", kFirst}},
      {"experiment_2", "object", {"presentation"}, {5.337, 1, 11, "0.041", false, "", kSecond}},
      {"experiment_2", "object", {"scenario"}, {18.222, 7, 77, "< 0.0001", false, "", kSecond}},
      {"experiment_2",
       "terrain",
       {"presentation"},
       {5.337, 1, 11, "0.004", false, "F and p as printed do not fit: this F has p = 0.041", kSecond}},
      {"experiment_2",
       "terrain",
       {"scenario"},
       {1.53, 7, 77, "0.170", true, "F was not printed; derived from p", kSecond}}};
  return kAll;
}

const std::vector<PublishedAgreementOf>& publishedAgreements() {
  static const std::vector<PublishedAgreementOf> kAll = {
      {"experiment_1", "main", "static", "rating", false, {0.933, 0.915, true, kFirst}},
      {"experiment_1", "main", "dynamic", "rating", false, {0.808, 0.932, true, kFirst}},
      {"experiment_1", "main", "both", "rating", false, {0.790, 0.902, true, kFirst}},
      {"experiment_1", "main", "static", "max_de94", false, {0.723, 0.806, true, kFirst}},
      {"experiment_1", "main", "dynamic", "max_de94", false, {0.561, 0.747, true, kFirst}},
      {"experiment_1", "main", "both", "max_de94", false, {0.589, 0.786, true, kFirst}},
      {"experiment_2", "object", "static", "detection_score", false, {0.833, 0.922, false, kSecond}},
      {"experiment_2", "object", "dynamic", "detection_score", false, {0.917, 0.929, false, kSecond}},
      {"experiment_2", "object", "both", "detection_score", false, {0.830, 0.927, false, kSecond}},
      {"experiment_2", "object", "static", "coverage_score", false, {0.750, 0.816, false, kSecond}},
      {"experiment_2", "object", "dynamic", "coverage_score", false, {0.792, 0.860, false, kSecond}},
      {"experiment_2", "object", "both", "coverage_score", false, {0.750, 0.848, false, kSecond}},
      {"experiment_2", "object", "static", "rating_level", true, {0.938, 0.916, false, kSecond}},
      {"experiment_2", "object", "dynamic", "rating_level", true, {0.750, 0.829, false, kSecond}},
      {"experiment_2", "object", "both", "rating_level", true, {0.781, 0.878, false, kSecond}},
      {"experiment_2", "terrain", "dynamic", "coverage_score", false, {0.234, 0.285, false, kSecond}},
      {"experiment_2", "terrain", "dynamic", "rating_level", false, {0.750, 0.811, false, kSecond}}};
  return kAll;
}

std::optional<PublishedRate> publishedRate(const std::string& protocol, const std::string& part,
                                           bool change) {
  for (const PublishedRateOf& one : publishedRates())
    if (protocol == one.protocol && part == one.part && change == one.change) return one.rate;
  return {};
}

std::optional<PublishedScenarios> publishedScenario(const std::string& protocol, const std::string& part,
                                                    const std::string& presentation) {
  for (const PublishedScenariosOf& one : publishedScenarios())
    if (protocol == one.protocol && part == one.part && presentation == one.presentation)
      return one.scenarios;
  return {};
}

std::optional<PublishedEffect> publishedEffect(const std::string& protocol, const std::string& part,
                                               const std::vector<std::string>& factors) {
  for (const PublishedEffectOf& one : publishedEffects())
    if (protocol == one.protocol && part == one.part &&
        std::is_permutation(factors.begin(), factors.end(), one.factors.begin(), one.factors.end()))
      return one.effect;
  return {};
}

std::optional<PublishedAgreement> publishedAgreement(const std::string& protocol, const std::string& part,
                                                     const std::string& set, const std::string& predictor,
                                                     bool severity) {
  for (const PublishedAgreementOf& one : publishedAgreements())
    if (protocol == one.protocol && part == one.part && set == one.set && predictor == one.predictor &&
        severity == one.severity)
      return one.agreement;
  return {};
}

}  // namespace limen::analysis
