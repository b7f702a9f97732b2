// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/validation.h"

namespace limen::analysis {
namespace {

struct Published {
  const char *protocol, *part, *set, *predictor;
  bool severity;
  PublishedAgreement agreement;
};

const char* const kFirst = "Schwarz 2009, section 10.4.1";
const char* const kSecond = "Schwarz 2009, section 10.4.2";

constexpr Published kPublished[] = {
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
    {"experiment_2", "object", "static", "rating_score", true, {0.938, 0.916, false, kSecond}},
    {"experiment_2", "object", "dynamic", "rating_score", true, {0.750, 0.829, false, kSecond}},
    {"experiment_2", "object", "both", "rating_score", true, {0.781, 0.878, false, kSecond}},
    {"experiment_2", "terrain", "dynamic", "coverage_score", false, {0.234, 0.285, false, kSecond}},
    {"experiment_2", "terrain", "dynamic", "rating_score", false, {0.750, 0.811, false, kSecond}}};

}  // namespace

std::optional<PublishedAgreement> publishedAgreement(const std::string& protocol, const std::string& part,
                                                     const std::string& set, const std::string& predictor,
                                                     bool severity) {
  for (const Published& one : kPublished)
    if (protocol == one.protocol && part == one.part && set == one.set && predictor == one.predictor &&
        severity == one.severity)
      return one.agreement;
  return {};
}

}  // namespace limen::analysis
