// SPDX-License-Identifier: BSD-3-Clause
#include "perception/band_thresholds/settings.h"

#include "experiments/base/error.h"

namespace limen::perception {

const SettingsTable<BandOutput>& BandOutput::table() {
  static const SettingsTable<BandOutput> kTable = {
      {&BandOutput::band, "band", {0, 9}, "", "frequency band; 0 is the finest"}};
  return kTable;
}

const SettingsTable<BandThresholdSettings>& BandThresholdSettings::table() {
  using S = BandThresholdSettings;
  static const SettingsTable<S> kTable = {
      {&S::predictor, "predictor", "the predictor whose responses must not change visibly"},
      {&S::jnd, "jnd", {1e-2, 10.0}, "JND", "largest change of a band's response that counts as invisible"},
      {&S::reach,
       "reach",
       {0, kMostReach},
       "samples",
       "samples of a level, on each side, over which the smallest threshold counts in the combined map"},
      Binding(&S::output, "output", "thresholds of the map").formerly({"map"})};
  return kTable;
}

void BandThresholdSettings::check() const {
  if (predictor.bands.isStack())
    throw Error("thresholds by band are those of a pyramid, not of a stack", "predictor.bands.decomposition",
                "use pyramid");
  if (std::holds_alternative<ExtendedMasking>(predictor.neighbourhood))
    throw Error("thresholds by band invert point-wise masking, not masking by neighbours",
                "predictor.neighbourhood", "use none");
  // Three parts of a band have contrasts and responses of their own; one response is inverted here.
  if (predictor.bands.isFitted())
    throw Error("thresholds by band invert one weight per band, not the three of fitted weights",
                "predictor.bands.weights", "use peak");
}

void BandThresholdSettings::checkBand(int bands) const {
  const auto* one = std::get_if<BandOutput>(&output);
  if (one && bands > 0 && one->band >= bands)
    throw Error("there is no frequency band " + std::to_string(one->band) + ", only 0 to " +
                    std::to_string(bands - 1),
                "output.band", "use one of these; small images and near viewers have fewer");
}

}  // namespace limen::perception
