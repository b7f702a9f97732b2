// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/base/enum_names.h"
#include "perception/multiscale/pyramid.h"

/// Peak frequencies of the bands of a decomposition, at which a CSF has to be read for them. Frequencies in
/// cycles per pixel of the finest level, along an axis; gain: amplitude of the band there for a grating of
/// amplitude 1. Source: Schwarz 2009, section 10.3 ("almost four" between the first two peaks), and transfer
/// functions derived from the kernels.
namespace limen::perception {

enum class PeakModel {
  Halving,      ///< each half the previous one, starting at Nyquist, gains 1: wrong, for comparison
  NoUpsample,   ///< differences of the Gaussian levels' transfer functions
  WithUpsample  ///< the upsampling filter included
};
constexpr EnumNames<PeakModel, 3> enumNames(PeakModel) {
  return {{{{PeakModel::Halving, "halving"},
            {PeakModel::NoUpsample, "no_upsample"},
            {PeakModel::WithUpsample, "with_upsample"}}}};
}

struct BandPeak {
  double frequencyCyclesPerPx = 0.5, gain = 1.0;
  double frequencyCpd(double pixelsPerDegree) const { return frequencyCyclesPerPx * pixelsPerDegree; }
};

/// Transfer of Gaussian level `level` at w radians per pixel of the finest level.
double gaussianLevelTransfer(const Kernel& kernel, int level, double w);
/// Transfer of band `level`, G_i - G_i+1. PeakModel::Halving has none (returns that of NoUpsample).
double bandTransfer(const Kernel& kernel, Upsampler upsampler, PeakModel model, int level, double w);
/// Peaks of bands 0 .. count - 1 of a pyramid.
std::vector<BandPeak> bandPeaks(const Kernel& kernel, Upsampler upsampler, PeakModel model, int count);
/// The same for a true Gaussian stack (sigma as in gaussianStack()).
std::vector<BandPeak> stackBandPeaks(const Kernel& kernel, int count, double sigmaPx = 0.0);

/// Peaks found by sending sine gratings through a decomposition: `decompose` gets a grating of mean 1 and
/// amplitude 1/2 and returns Gaussian levels, each at its own size (as gaussianPyramid() or a stack does).
/// With `upsampler` the bands are formed as in the pyramid, otherwise from the levels' amplitudes alone.
struct GratingSweep {
  int widthPx = 2048, heightPx = 64;
  double lowestCyclesPerPx = 0.006, step = 1.04;
  bool upsampled = false;
  PyramidSettings settings;
};
std::vector<BandPeak> measureBandPeaks(const std::function<std::vector<Plane>(const Plane&)>& decompose,
                                       int count, const GratingSweep& sweep);
/// Largest relative deviation of `measured` peak frequencies from the `assumed` ones. Above a tenth, a
/// CSF read at the assumed frequencies says nothing about the bands (the mistake of section 9.6).
double largestPeakMismatch(const std::vector<BandPeak>& measured, const std::vector<BandPeak>& assumed);
inline constexpr double kLargestAllowedPeakMismatch = 0.1;
/// Throws Error naming the band if a decomposition's peaks lie elsewhere than assumed.
void requirePeaks(const std::vector<BandPeak>& measured, const std::vector<BandPeak>& assumed,
                  const std::string& where);

}  // namespace limen::perception
