// SPDX-License-Identifier: BSD-3-Clause
#include "perception/band_thresholds/reference.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "perception/multiscale/pyramid.h"

namespace limen::perception {
namespace {

constexpr double kLargestCdM2 = 1e8;

PyramidSettings pyramidOf(const PoppingSettings& predictor, int levels) {
  return {levels, predictor.bands.kernel(), predictor.bands.upsampler(), Border::Clamp};
}

/// Luminance adapted to, at the size of a level, as the predictor has it.
Plane adaptation(const std::vector<Plane>& levels, int level, const PoppingModel& model,
                 const PoppingSettings& predictor) {
  const Plane& own = levels[static_cast<size_t>(level)];
  if (const auto* fixed = std::get_if<FixedAdaptation>(&predictor.adaptation))
    return Plane(own.width, own.height, fixed->luminanceCdM2);
  if (std::holds_alternative<MeanAdaptation>(predictor.adaptation)) {
    double sum = 0.0;
    for (const double value : levels.back().data) sum += value;
    return Plane(own.width, own.height, sum / static_cast<double>(levels.back().data.size()));
  }
  const int from = std::max(model.adaptationLevel, level);
  const Plane& source = levels[static_cast<size_t>(from)];
  if (from == level) return source;
  return resample(source, bilinearTaps(source.width, own.width, true, from - level, Border::Clamp),
                  bilinearTaps(source.height, own.height, true, from - level, Border::Clamp));
}

/// Smallest value within `reach` samples along both axes.
Plane smallestAround(const Plane& plane, int reach) {
  Plane rows(plane.width, plane.height), out(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x)
      rows.at(x, y) = *std::min_element(plane.row(y) + std::max(x - reach, 0),
                                        plane.row(y) + std::min(x + reach, plane.width - 1) + 1);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      double least = rows.at(x, y);
      for (int i = std::max(y - reach, 0); i <= std::min(y + reach, plane.height - 1); ++i)
        least = std::min(least, rows.at(x, i));
      out.at(x, y) = least;
    }
  return out;
}

Plane doubled(const Plane& plane, const Plane& finer) {
  return resample(plane, bilinearTaps(plane.width, finer.width, true, 1, Border::Clamp),
                  bilinearTaps(plane.height, finer.height, true, 1, Border::Clamp));
}

/// From the coarsest band to the finest: the smaller of a band's own threshold and the coarser ones'.
void combine(BandThresholds& out, int reach) {
  Plane combined, limiting;
  for (size_t band = out.bands.size(); band-- > 0;) {
    const Plane own = smallestAround(out.bands[band].anySpectrumCdM2, reach);
    const Plane index(own.width, own.height, static_cast<double>(band));
    if (combined.data.empty()) {
      combined = own;
      limiting = index;
      continue;
    }
    combined = doubled(combined, own);
    // Which band it is does not blend: the sample to the left and above.
    Plane next = index;
    for (int y = 0; y < own.height; ++y)
      for (int x = 0; x < own.width; ++x) {
        if (own.at(x, y) <= combined.at(x, y)) {
          combined.at(x, y) = own.at(x, y);
        } else {
          next.at(x, y) =
              limiting.at(std::min(x / 2, limiting.width - 1), std::min(y / 2, limiting.height - 1));
        }
      }
    limiting = std::move(next);
  }
  out.combinedCdM2 = std::move(combined);
  out.limitingBand = std::move(limiting);
}

}  // namespace

BandThresholds computeBandThresholds(const Plane& luminanceCdM2, const DisplayProfile& display,
                                     const BandThresholdSettings& settings) {
  const BandThresholdModel model(settings, display, luminanceCdM2.width, luminanceCdM2.height);
  const PyramidSettings pyramid = pyramidOf(settings.predictor, model.predictor().gaussianLevels);
  const std::vector<Plane> levels = gaussianPyramid(finiteNonNegative(luminanceCdM2, kLargestCdM2), pyramid);
  const double epsilon = settings.predictor.bands.denominatorEpsilon;

  BandThresholds out;
  for (int band = 0; band < model.bands(); ++band) {
    const Plane& own = levels[static_cast<size_t>(band)];
    const Plane next = upsampleLevel(levels, band + 1, band, pyramid),
                after = upsampleLevel(levels, band + 2, band, pyramid),
                adapted = adaptation(levels, band, model.predictor(), settings.predictor);
    const double gain = model.predictor().gain[static_cast<size_t>(band)];
    const Plane empty(own.width, own.height);
    BandThreshold result{
        model.predictor().peakCpd[static_cast<size_t>(band)], empty, empty, empty, empty, gain};
    for (const double below : after.data) out.guarded += below >= epsilon ? 0 : 1;
    forRowBlocks(own.height, static_cast<size_t>(own.width) * 400, [&](int first, int end) {
      for (int y = first; y < end; ++y)
        for (int x = 0; x < own.width; ++x) {
          const double denominator = std::max(after.at(x, y), epsilon);
          result.denominatorCdM2.at(x, y) = denominator;
          result.contrast.at(x, y) = (own.at(x, y) - next.at(x, y)) / (denominator * gain);
          const double contrast = std::abs(result.contrast.at(x, y));
          const double step = model.contrastStep(band, contrast, adapted.at(x, y));
          result.thresholdCdM2.at(x, y) = step * denominator * gain;
          result.anySpectrumCdM2.at(x, y) = model.anySpectrumCdM2(band, contrast, step, denominator);
        }
    });
    out.bands.push_back(std::move(result));
  }
  if (!out.bands.empty()) {
    combine(out, settings.reach);
    return out;
  }
  const Plane adapted = adaptation(levels, 0, model.predictor(), settings.predictor);
  out.combinedCdM2 = out.limitingBand = Plane(adapted.width, adapted.height);
  for (size_t i = 0; i < adapted.data.size(); ++i)
    out.combinedCdM2.data[i] = model.uniformCdM2(std::max(adapted.data[i], epsilon));
  return out;
}

Plane thresholdMapOf(const BandThresholds& thresholds, const BandThresholdSettings& settings) {
  const auto* output = std::get_if<BandOutput>(&settings.output);
  if (!output || thresholds.bands.empty()) return thresholds.combinedCdM2;
  settings.checkBand(static_cast<int>(thresholds.bands.size()));
  const Plane& map = thresholds.bands[static_cast<size_t>(output->band)].thresholdCdM2;
  if (output->band == 0) return map;
  const Plane& full = thresholds.combinedCdM2;
  return resample(map, bilinearTaps(map.width, full.width, true, output->band, Border::Clamp),
                  bilinearTaps(map.height, full.height, true, output->band, Border::Clamp));
}

BandRatios compareWithThresholds(const Plane& differenceCdM2, const BandThresholds& thresholds,
                                 const BandThresholdSettings& settings) {
  BandRatios out;
  const int width = differenceCdM2.width, height = differenceCdM2.height;
  out.pooled = Plane(width, height);
  if (thresholds.bands.empty()) return out;
  const auto count = static_cast<int>(thresholds.bands.size());
  const PyramidSettings pyramid = pyramidOf(settings.predictor, count + 2);
  const std::vector<Plane> levels = gaussianPyramid(differenceCdM2, pyramid);
  const double exponent = settings.predictor.minkowskiExponent;
  for (int band = 0; band < count; ++band) {
    const auto& [cpd, allowed, anySpectrum, contrast, denominator, gain] =
        thresholds.bands[static_cast<size_t>(band)];
    Plane ratio = levels[static_cast<size_t>(band)];
    const Plane next = upsampleLevel(levels, band + 1, band, pyramid),
                after = upsampleLevel(levels, band + 2, band, pyramid);
    assert(allowed.data.size() == ratio.data.size());
    for (size_t i = 0; i < ratio.data.size(); ++i) {
      const double below =
          std::max(denominator.data[i] + after.data[i], settings.predictor.bands.denominatorEpsilon);
      const double change =
          ((ratio.data[i] - next.data[i]) / gain - contrast.data[i] * after.data[i]) / below;
      ratio.data[i] = change * denominator.data[i] * gain / allowed.data[i];
    }
    const Plane full = band == 0
                           ? ratio
                           : resample(ratio, bilinearTaps(ratio.width, width, true, band, Border::Clamp),
                                      bilinearTaps(ratio.height, height, true, band, Border::Clamp));
    for (size_t i = 0; i < full.data.size(); ++i)
      out.pooled.data[i] += std::pow(std::abs(full.data[i]), exponent);
    out.ratios.push_back(std::move(ratio));
  }
  for (double& value : out.pooled.data) value = std::pow(value, 1.0 / exponent);
  return out;
}

}  // namespace limen::perception
