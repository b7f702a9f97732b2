// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/temporal_filter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>

namespace limen::perception {
namespace {

constexpr double kBrightest = 1e4;  // cd/m2, as castleTemporal()
// Nodes of OnsetTable. The onset's response is flat below the first frequency.
constexpr double kLowestHz = 0.01;
constexpr int kColumns = 257, kRows = kCastleKinkRows;

// Luminance enters the transient mechanism by a power of its best frequency alone, which is what rows are
// equal steps of: over luminance itself the mechanism has a kink.
double powerOfBestHz(double luminanceCdM2) {
  return std::pow(castleTransientHz(luminanceCdM2), kCastleKinkExponent);
}

double rowPlace(double luminanceCdM2) {
  return powerOfBestHz(luminanceCdM2) / powerOfBestHz(kBrightest) * (kRows - 1);
}

/// The inverse of rowPlace(): the best frequency grows with the logarithm of luminance.
double luminanceOfRow(int row) {
  const double kink = castleKinkCdM2();
  const double share = std::pow(static_cast<double>(row) / (kRows - 1), 1.0 / kCastleKinkExponent);
  return kink * std::pow(kBrightest / kink, share);
}

}  // namespace

TemporalFilter::TemporalFilter(CastleMechanism mechanism, double luminanceCdM2, double refreshHz,
                               double windowS)
    : samplesPerFrame_(std::max(1, static_cast<int>(std::ceil(kLeastTemporalRateHz / refreshHz)))),
      rateHz_(samplesPerFrame_ * refreshHz) {
  assert(refreshHz > 0.0 && windowS > 0.0);
  const int half = std::max(1, static_cast<int>(std::lround(0.5 * windowS * rateHz_))), count = 2 * half + 1;
  std::vector<double> responses;
  for (int k = 0; k <= half; ++k)
    responses.push_back(castleTemporal(mechanism, k * rateHz_ / count, luminanceCdM2));
  std::vector<double> cosines;
  for (int i = 0; i < count; ++i) cosines.push_back(std::cos(2.0 * std::numbers::pi * i / count));
  for (int n = -half; n <= half; ++n) {
    double sum = 0.0;
    for (int k = half; k >= 1; --k)
      sum += responses[static_cast<size_t>(k)] *
             cosines[static_cast<size_t>(static_cast<long>(k) * std::abs(n) % count)];
    taps_.push_back((responses[0] + 2.0 * sum) / count);
  }
}

std::vector<double> TemporalFilter::respond(const std::vector<double>& frames) const {
  assert(!frames.empty());
  const int half = static_cast<int>(taps_.size()) / 2;
  const int samples = static_cast<int>(frames.size()) * samplesPerFrame_;
  std::vector<double> out;
  for (int n = 0; n < samples; ++n) {
    double sum = 0.0;
    for (int j = -half; j <= half; ++j) {
      const int at = std::clamp(n - j, 0, samples - 1);
      sum += taps_[static_cast<size_t>(j + half)] * frames[static_cast<size_t>(at / samplesPerFrame_)];
    }
    out.push_back(sum);
  }
  return out;
}

double TemporalFilter::onset(double hz) const {
  const int half = static_cast<int>(taps_.size()) / 2;
  const double turn = -2.0 * std::numbers::pi * hz / rateHz_;
  const std::complex<double> step = std::polar(1.0, turn);
  std::complex<double> sum = 0.0, phase = std::polar(1.0, -half * turn);
  double largest = 0.0;
  for (int n = -half; n <= half; ++n, phase *= step) {
    sum += taps_[static_cast<size_t>(n + half)] * phase;
    largest = std::max(largest, std::abs(sum));
  }
  return largest;
}

OnsetTable::OnsetTable(CastleMechanism mechanism, double refreshHz, double windowS)
    : mechanism_(mechanism), rows_(mechanism == CastleMechanism::Transient ? kRows : 1) {
  for (int row = 0; row < rows_; ++row) {
    const TemporalFilter filter(mechanism, luminanceOfRow(row), refreshHz, windowS);
    highestHz_ = 0.5 * filter.rateHz();
    for (int column = 0; column < kColumns; ++column)
      values_.push_back(filter.onset(
          kLowestHz * std::pow(highestHz_ / kLowestHz, static_cast<double>(column) / (kColumns - 1))));
  }
}

std::shared_ptr<const OnsetTable> OnsetTable::shared(CastleMechanism mechanism, double refreshHz,
                                                     double windowS) {
  // Few displays and windows are in use at a time; what is still in use when it goes lives on.
  constexpr size_t kKept = 64;
  static std::mutex guard;
  static std::map<std::tuple<CastleMechanism, double, double>, std::shared_ptr<const OnsetTable>> kept;
  const std::scoped_lock lock(guard);
  if (kept.size() >= kKept) kept.clear();
  std::shared_ptr<const OnsetTable>& found = kept[{mechanism, refreshHz, windowS}];
  if (!found) found = std::make_shared<const OnsetTable>(mechanism, refreshHz, windowS);
  return found;
}

double OnsetTable::operator()(double hz, double luminanceCdM2) const {
  hz = std::isnan(hz) ? 0.0 : std::abs(hz);
  const double response = castleTemporal(mechanism_, hz, luminanceCdM2);
  // What flickers faster than the table is fused by all mechanisms.
  if (hz > highestHz_) return response;
  const double x =
      std::log(std::max(hz, kLowestHz) / kLowestHz) / std::log(highestHz_ / kLowestHz) * (kColumns - 1);
  const double y = rows_ == 1 ? 0.0 : rowPlace(luminanceCdM2);
  const int column = std::min(static_cast<int>(x), kColumns - 2),
            row = std::min(static_cast<int>(y), rows_ - 1);
  const int next = std::min(row + 1, rows_ - 1);
  const double tx = x - column, ty = y - row;
  const auto at = [&](int r, int c) { return values_[static_cast<size_t>(r) * kColumns + c]; };
  return (1.0 - ty) * ((1.0 - tx) * at(row, column) + tx * at(row, column + 1)) +
         ty * ((1.0 - tx) * at(next, column) + tx * at(next, column + 1));
}

double holdBlur(double cpd, double eyeDegS, double refreshHz, double share) {
  const double x = std::numbers::pi * std::abs(cpd * eyeDegS * share / refreshHz);
  if (!(x > 1e-8)) return 1.0;
  return std::isinf(x) ? 0.0 : std::abs(std::sin(x) / x);
}

}  // namespace limen::perception
