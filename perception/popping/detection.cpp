// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/detection.h"

#include <cmath>
#include <limits>

// Where the defaults come from. Schwarz 2009, section 10.3.4, says that R < 1 predicts "rarely visible" and R
// > 3 "easily detectable" popping, and section 10.4 counts the votes of trials without popping.
//  - Guess rate: 10 of 224 catch trials of the first study were answered yes: 0.0446.
//  - Midpoint and scale: "rarely" is read as one detection in ten, "easily" as nine in ten, both after the
//  guesses
//    and lapses are taken out. A logistic with F(1) = 0.1 and F(3) = 0.9 has its midpoint at (1 + 3) / 2 = 2
//    and its scale at (3 - 1) / (2 ln 9) = 0.45512.
//  - Lapse rate: 2 %, the usual order in yes/no tasks of adults (Wichmann and Hill 2001 bound it by 6 %); the
//    thesis tells of two subjects who missed an obvious pop.

namespace limen::perception {

double DetectionModel::probability(double rating) const {
  const double exponent =
      std::isnan(rating) ? -std::numeric_limits<double>::infinity() : (rating - midpointR) / scaleR;
  // Of the two forms, the one whose exponential cannot overflow.
  const double logistic =
      exponent >= 0.0 ? 1.0 / (1.0 + std::exp(-exponent)) : std::exp(exponent) / (1.0 + std::exp(exponent));
  return guessRate + (1.0 - guessRate - lapseRate) * logistic;
}

double DetectionModel::rating(double probability) const {
  const double share = (probability - guessRate) / (1.0 - guessRate - lapseRate);
  if (!(share > 0.0)) return -std::numeric_limits<double>::infinity();
  if (share >= 1.0) return std::numeric_limits<double>::infinity();
  return midpointR + scaleR * std::log(share / (1.0 - share));
}

double DetectionModel::probabilityOfAny(const std::vector<double>& ratings) const {
  double missed = 1.0;
  for (const double rating : ratings) missed *= (1.0 - probability(rating)) / (1.0 - guessRate);
  return 1.0 - (1.0 - guessRate) * missed;
}

const SettingsTable<DetectionModel>& DetectionModel::table() {
  using S = DetectionModel;
  const std::string derived = "derived from Schwarz 2009, sections 10.3.4 and 10.4";
  static const SettingsTable<S> kTable = {
      Binding(&S::guessRate, "guess_rate", Range{0.0, 0.49}, "", "detections reported without popping",
              "Schwarz 2009, section 10.4")
          .formerly({"guess_rate"}),
      Binding(&S::lapseRate, "lapse_rate", Range{0.0, 0.49}, "", "pops missed however strong", "choice")
          .formerly({"lapse_rate"}),
      Binding(&S::midpointR, "midpoint", Range{-10.0, 20.0}, "",
              "rating R that is detected half the time, apart from guesses and lapses", derived)
          .formerly({"rating_midpoint"}),
      Binding(&S::scaleR, "scale", Range{0.01, 10.0}, "", "scale of the logistic of detection over R",
              derived)
          .formerly({"rating_scale_r"})};
  return kTable;
}

}  // namespace limen::perception
