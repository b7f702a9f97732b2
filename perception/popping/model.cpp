// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "perception/multiscale/pyramid.h"
#include "perception/popping/predictor.h"
#include "perception/popping/sensitivity.h"

namespace limen::perception {
namespace {

constexpr int kMostLevels = 12;

}  // namespace

PoppingModel poppingModel(int widthPx, int heightPx, const DisplayProfile& display,
                          const PoppingSettings& settings) {
  if (widthPx < 1 || heightPx < 1)
    throw Error("an image has no pixels", "popping", "give images of 1 x 1 or more");
  checkDisplay(display, "popping");
  settings.bands.check();
  PoppingModel model;
  model.pixelsPerDegree = display.pixelsPerDegree();
  const auto* fixedArea = std::get_if<FixedArea>(&settings.sensitivity.stimulusArea);
  const double shownArea = display.areaDeg2({widthPx, heightPx});
  model.areaDeg2 = fixedArea ? fixedArea->deg2 : shownArea;
  model.widthDeg = 2.0 * std::atan(0.5 * widthPx * display.pitchM() / display.distanceM) * 180.0 / M_PI;

  // Nothing is upsampled in a stack.
  const bool isStack = settings.bands.isStack();
  const PeakModel peakModel = isStack && settings.bands.peakModel == PeakModel::WithUpsample
                                  ? PeakModel::NoUpsample
                                  : settings.bands.peakModel;
  const std::vector<BandPeak> peaks =
      bandPeaks(settings.bands.kernel(), settings.bands.upsampler(), peakModel, kMostLevels - 2);
  int levels = kMostLevels;
  if (const auto* count = std::get_if<LevelCount>(&settings.bands.levels)) {
    levels = count->gaussian;
  } else {
    const double leastPeakCpd = std::get<LevelsByPeak>(settings.bands.levels).leastPeakCpd;
    int bands = 1;
    while (bands < kMostLevels - 2 &&
           peaks[static_cast<size_t>(bands)].frequencyCpd(model.pixelsPerDegree) >= leastPeakCpd)
      ++bands;
    levels = bands + 2;
  }
  model.gaussianLevels = std::min({levels, kMostLevels, mostLevels(widthPx, heightPx)});
  model.contrastLevels = std::max(0, model.gaussianLevels - 2);
  for (int i = 0; i < model.contrastLevels; ++i) {
    const BandPeak& peak = peaks[static_cast<size_t>(i)];
    model.peakCpd.push_back(peak.frequencyCpd(model.pixelsPerDegree));
    model.gain.push_back(settings.bands.compensatesGain() ? peak.gain : 1.0);
  }
  const auto* given = std::get_if<LevelAdaptation>(&settings.adaptation);
  const int degree = given ? given->level : static_cast<int>(std::lround(std::log2(model.pixelsPerDegree)));
  model.adaptationLevel = std::clamp(degree, 0, model.gaussianLevels - 1);

  const std::array<double, 3> scale =
      calibration(settings, viewingPoint(model.areaDeg2, model.widthDeg, display));
  model.scaleA = scale[0], model.scaleRg = scale[1], model.scaleBy = scale[2];
  return model;
}

std::vector<std::string> poppingStages(const PoppingModel& model) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name, int level) {
    names.push_back(name + "_" + std::to_string(level));
  };
  for (const std::string frame : {"actual", "predicted"})
    for (int i = 0; i < model.gaussianLevels; ++i) add("lms_" + frame, i);
  for (int i = 0; i < model.contrastLevels; ++i) {
    for (const std::string frame : {"actual", "predicted"})
      for (const std::string stage : {"contrast_", "luminance_", "velocity_", "response_"})
        add(stage + frame, i);
    add("difference", i);
  }
  for (const char* name : {"jnd", "signed_jnd", "weight", "weighted_jnd", "seeds", "labels", "rating"})
    names.push_back(name);
  return names;
}

}  // namespace limen::perception
