// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "perception/vision/display.h"

namespace limen::study {

/// Width and height of a bank card: ID-1 of ISO/IEC 7810.
inline constexpr double kCardWidthM = 0.08560, kCardHeightM = 0.05398;

/// Pixel pitch [m] of a screen on which a card is `cardWidthPx` pixels wide. Throws Error on a width that
/// implies pixels outside 0.02 to 2 mm.
double pitchFromCard(double cardWidthPx);

/// A grey of the display and its luminance.
struct Reading {
  double level = 0.0;  ///< pixel value in [0, 1]
  double cdM2 = 0.0;
};

/// A curve through readings.
struct TransferFit {
  perception::TransferCurve curve = perception::TransferCurve::Gamma;
  double gamma = 2.2;  ///< of TransferCurve::Gamma
  double blackCdM2 = 0.0, peakCdM2 = 0.0;
  std::vector<double> residualCdM2;          ///< reading minus curve, in the readings' order
  double rmsCdM2 = 0.0, largestShare = 0.0;  ///< the largest residual as a share of peak minus black
};

/// L = black + (peak - black) u^gamma by least squares, all three free. Readings are weighted by their
/// relative error (with 1e-4 of the brightest one added to each), so that black is fitted closely.
TransferFit fitGamma(const std::vector<Reading>& readings);
/// The same with the sRGB curve in place of the power law, black and peak free.
TransferFit fitSrgb(const std::vector<Reading>& readings);
/// Whichever of the two leaves smaller weighted residuals.
TransferFit fitTransfer(const std::vector<Reading>& readings);
// All throw Error on readings unfit for calibration: fewer than four levels, none near black or
// near white, values outside of their range, luminance that falls by more than 2 % of its range while the
// level rises, and a largest residual of more than kLargestResidual of the range.
inline constexpr double kLargestResidual = 0.03;

/// A dithered field in which the share `proportion` of the pixels is white looks as bright as the level
/// `level`.
struct Match {
  double proportion = 0.0, level = 0.0;  ///< both strictly between 0 and 1
};
struct MatchFit {
  double gamma = 2.2;
  std::vector<double> residual;  ///< proportion minus level^gamma
  double largestResidual = 0.0;
};
/// level^gamma = proportion, least squares on logarithms: gamma = sum(ln p ln u) / sum(ln^2 u). Throws Error
/// on values out of range, a gamma outside 1 to 4, and a residual of more than kLargestMatchResidual.
MatchFit fitMatches(const std::vector<Match>& matches);
inline constexpr double kLargestMatchResidual = 0.06;

/// Reads "level,cd/m2" lines: a header line is skipped, '#' starts a comment. Throws Error with the line.
std::vector<Reading> readReadings(const std::string& path);
/// "0.25=0.53,0.5=0.72". Throws Error.
std::vector<Match> parseMatches(const std::string& text);

/// Writes a profile that readDisplay() reads, after `comments`, one line each. Checks it first. Throws Error
/// if the file already exists, unless `force`, or cannot be written.
void writeProfile(const std::string& path, const perception::DisplayProfile& profile,
                  const std::vector<std::string>& comments, bool force);

}  // namespace limen::study
