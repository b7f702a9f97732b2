// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp/reference.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>

#include "experiments/base/error.h"
#include "perception/metrics/color_video_vdp/pyramid.h"
#include "perception/metrics/color_video_vdp/sensitivity.h"
#include "perception/metrics/row_sums.h"

namespace limen::perception::cvvdp {
namespace {

using Opponent = std::array<Plane, 3>;  ///< A, RG, YV of one frame

Opponent toOpponent(const Image& image, const Pair& pair, const Options& options, const char* role) {
  if (image.width != pair.width || image.height != pair.height || image.channels < 1 || image.channels == 2)
    throw Error(std::string("a ") + role + " frame has another size or kind than the first", {},
                "all frames of both videos must have one size and 1, 3 or 4 channels");
  const glm::dmat3 dklOfRgb = options.display.colours.dklOfRgb();
  Opponent out;
  for (Plane& plane : out) plane = Plane(pair.width, pair.height);
  forEachRow(pair.height, static_cast<size_t>(pair.width), [&](int y) {
    for (int x = 0; x < pair.width; ++x) {
      glm::dvec3 value;
      for (int c = 0; c < 3; ++c) {
        value[c] = image.at(x, y, image.channels < 3 ? 0 : c);
        if (options.codeSteps > 0.0) value[c] = std::round(value[c] * options.codeSteps) / options.codeSteps;
      }
      const glm::dvec3 dkl = dklOfRgb * (options.values == Values::Relative ? options.display.lightOfRelative(value)
                                                                            : options.display.light(value));
      for (int c = 0; c < 3; ++c) out[static_cast<size_t>(c)].at(x, y) = dkl[c];
    }
  });
  return out;
}

/// Frames of one signal in opponent channels, filtered in time.
class Signal {
 public:
  Signal(const Pair& pair, const Options& options, const FrameSource& source, const char* role)
      : pair_(pair), options_(options), source_(source), role_(role) {
    if (pair.frames == 1) return;
    for (int c = 0; c < kChannels; ++c) filters_.push_back(temporalFilter(c, options.framesPerSecond));
  }

  Planes at(int frame) {
    Planes out;
    if (filters_.empty()) {
      Opponent still = toOpponent(source_(frame), pair_, options_, role_);
      for (size_t c = 0; c < still.size(); ++c) out[c] = std::move(still[c]);
      return out;
    }
    for (Plane& plane : out) plane = Plane(pair_.width, pair_.height);
    const int taps = static_cast<int>(filters_[0].size());
    for (int tap = taps - 1; tap >= 0; --tap) {
      const Opponent& past = opponent(paddedFrame(frame - tap, pair_.frames, options_.padding));
      for (size_t c = 0; c < kChannels; ++c) {
        const double weight = filters_[c][static_cast<size_t>(tap)];
        const std::vector<double>& from = past[c % 3].data;
        for (size_t i = 0; i < from.size(); ++i) out[c].data[i] += weight * from[i];
      }
    }
    // Later frames see at most taps - 1 frames back, or in a mirror up to the same number from the start.
    std::erase_if(kept_, [&](const auto& entry) {
      return entry.first <= frame + 1 - taps && (frame >= taps || entry.first > taps);
    });
    return out;
  }

 private:
  const Opponent& opponent(int frame) {
    auto found = kept_.find(frame);
    if (found == kept_.end())
      found = kept_.emplace(frame, toOpponent(source_(frame), pair_, options_, role_)).first;
    return found->second;
  }

  const Pair& pair_;
  const Options& options_;
  const FrameSource& source_;
  const char* role_;
  std::vector<std::vector<double>> filters_;
  std::map<int, Opponent> kept_;
};

class Evaluation {
 public:
  Evaluation(const Pair& pair, const Options& options)
      : options_(options),
        video_(pair.frames > 1),
        channels_(video_ ? kChannels : kChannels - 1),
        frequencies_(bandFrequenciesCpd(pair.width, pair.height, options.display.pixelsPerDegree)) {
    for (const double frequency : frequencies_) {
      std::vector<Sensitivity>& band = sensitivities_.emplace_back();
      for (int c = 0; c < kChannels; ++c) band.emplace_back(c, frequency);
    }
  }

  const std::vector<double>& frequencies() const { return frequencies_; }

  /// Fills in the stages of a frame whose filtered inputs are given.
  void run(FrameStages& stages) const {
    Planes test = stages.test, reference = stages.reference;
    const int bands = static_cast<int>(frequencies_.size());
    for (int band = 0; band < bands; ++band) {
      BandStages& out = stages.bands.emplace_back();
      if (band + 1 == bands) {
        baseBand(test, reference, out);
        break;
      }
      const Planes testNext = reduced(test), referenceNext = reduced(reference);
      contrast(test, testNext, band, out.testContrast);
      const Plane background = contrast(reference, referenceNext, band, out.referenceContrast);
      for (size_t c = 0; c < channels_; ++c) {
        out.sensitivity[c] = Plane(background.width, background.height);
        const Sensitivity& sensitivity = sensitivities_[static_cast<size_t>(band)][c];
        for (size_t i = 0; i < background.pixels(); ++i)
          out.sensitivity[c].data[i] = sensitivity.at(std::log10(background.data[i]));
      }
      mask(out);
      test = testNext, reference = referenceNext;
    }
  }

  FrameDifferences poolPixels(const FrameStages& stages) const {
    const double exponent = parameters().pixelExponent;
    FrameDifferences out;
    for (const BandStages& band : stages.bands) {
      Channels& pooled = out.emplace_back(Channels{});
      for (size_t c = 0; c < channels_; ++c) {
        CompensatedSum sum;
        for (const double d : band.difference[c].data) sum.add(offsetPower(d, exponent));
        const double mean = sum.value() / static_cast<double>(band.difference[c].pixels());
        pooled[c] = offsetPower(mean, 1.0 / exponent);
      }
    }
    return out;
  }

  Plane map(const FrameStages& stages) const {
    const Parameters& p = parameters();
    const int bands = static_cast<int>(stages.bands.size());
    Plane sum;
    for (int band = bands - 1; band >= 0; --band) {
      const Planes& difference = stages.bands[static_cast<size_t>(band)].difference;
      const bool base = band + 1 == bands;
      Plane here(difference[0].width, difference[0].height);
      for (size_t i = 0; i < here.pixels(); ++i) {
        double channels = 0.0;
        for (size_t c = 0; c < channels_; ++c) {
          const double weight =
              p.channelWeight[c] * (video_ ? 1.0 : p.imageFactor) * (base ? p.baseBandWeight[c] : 1.0);
          channels += offsetPower(weight * difference[c].data[i], p.channelExponent);
        }
        here.data[i] = offsetPower(channels, 1.0 / p.channelExponent) / bandMultiplier(band, bands);
      }
      if (!base) {
        const Plane coarse = expand(sum, here.width, here.height);
        for (size_t i = 0; i < here.pixels(); ++i) here.data[i] += coarse.data[i];
      }
      sum = std::move(here);
    }
    for (double& value : sum.data) value = 1.0 - jodOf(value) / 10.0;
    return sum;
  }

 private:
  Planes reduced(const Planes& planes) const {
    Planes out;
    for (size_t c = 0; c < channels_; ++c) out[c] = reduce(planes[c], options_.referenceBorders);
    return out;
  }

  /// Contrasts of a band and the background they are relative to: the sustained achromatic channel.
  Plane contrast(const Planes& fine, const Planes& coarse, int band, Planes& out) const {
    const Parameters& p = parameters();
    const int width = fine[0].width, height = fine[0].height;
    Plane background = expand(coarse[0], width, height);
    for (double& value : background.data) value = std::max(value, p.leastBackground);
    const double multiplier = bandMultiplier(band, static_cast<int>(frequencies_.size()));
    for (size_t c = 0; c < channels_; ++c) {
      out[c] = expand(coarse[c], width, height);
      for (size_t i = 0; i < out[c].pixels(); ++i) {
        const double detail = fine[c].data[i] - out[c].data[i];
        out[c].data[i] = std::min(detail / background.data[i], p.largestContrast) * multiplier;
      }
    }
    return background;
  }

  /// Differences after masking within and across channels.
  void mask(BandStages& band) const {
    const Parameters& p = parameters();
    Planes masker;
    for (size_t c = 0; c < channels_; ++c) {
      const std::vector<double>& s = band.sensitivity[c].data;
      Plane mutual(band.sensitivity[c].width, band.sensitivity[c].height);
      for (size_t i = 0; i < s.size(); ++i)
        mutual.data[i] = std::min(std::abs(band.testContrast[c].data[i] * s[i] * p.channelGain[c]),
                                  std::abs(band.referenceContrast[c].data[i] * s[i] * p.channelGain[c]));
      masker[c] = blurMasker(mutual);
      for (double& value : masker[c].data) value = offsetPower(p.maskScale * value, p.maskerExponent[c]);
    }
    for (size_t c = 0; c < channels_; ++c) {
      const std::vector<double>& s = band.sensitivity[c].data;
      band.difference[c] = Plane(band.sensitivity[c].width, band.sensitivity[c].height);
      for (size_t i = 0; i < s.size(); ++i) {
        double masking = 0.0;
        for (size_t k = 0; k < channels_; ++k) masking += p.crossMasking[k][c] * masker[k].data[i];
        const double difference =
            std::abs(band.testContrast[c].data[i] * s[i] * p.channelGain[c] -
                     band.referenceContrast[c].data[i] * s[i] * p.channelGain[c]);
        const double masked = offsetPower(difference, p.maskExponent) / (1.0 + masking);
        band.difference[c].data[i] = p.largestDifference * masked / (p.largestDifference + masked);
      }
    }
  }

  /// What the last level holds, relative to each signal's mean luminance; unmasked.
  void baseBand(const Planes& test, const Planes& reference, BandStages& out) const {
    const Parameters& p = parameters();
    const auto meanOf = [&](const Plane& plane) {
      CompensatedSum sum;
      for (const double value : plane.data) sum.add(std::max(value, p.leastBackground));
      return sum.value() / static_cast<double>(plane.pixels());
    };
    const double testMean = meanOf(test[0]), referenceMean = meanOf(reference[0]);
    for (size_t c = 0; c < channels_; ++c) {
      const double s = sensitivities_.back()[c].at(std::log10(referenceMean));
      for (Plane* plane : {&out.testContrast[c], &out.referenceContrast[c], &out.difference[c]})
        *plane = Plane(test[c].width, test[c].height);
      out.sensitivity[c] = Plane(test[c].width, test[c].height, s);
      for (size_t i = 0; i < test[c].pixels(); ++i) {
        const double t = std::min(test[c].data[i] / testMean, p.largestContrast);
        const double r = std::min(reference[c].data[i] / referenceMean, p.largestContrast);
        out.testContrast[c].data[i] = t;
        out.referenceContrast[c].data[i] = r;
        out.difference[c].data[i] = std::abs(t - r) * s;
      }
    }
  }

  const Options& options_;
  bool video_;
  size_t channels_;
  std::vector<double> frequencies_;
  std::vector<std::vector<Sensitivity>> sensitivities_;  ///< [band][channel]
};

}  // namespace

ReferenceResult evaluate(const Pair& pair, const Options& options, const StageVisitor& visit) {
  check(pair, options);
  const Evaluation evaluation(pair, options);
  Signal test(pair, options, pair.test, "test"), reference(pair, options, pair.reference, "reference");
  ReferenceResult out;
  std::vector<FrameDifferences> frames;
  for (int frame = 0; frame < pair.frames; ++frame) {
    FrameStages stages;
    stages.frame = frame;
    stages.test = test.at(frame);
    stages.reference = reference.at(frame);
    evaluation.run(stages);
    frames.push_back(evaluation.poolPixels(stages));
    if (options.map) out.maps.push_back(evaluation.map(stages));
    if (visit) visit(stages);
  }
  out.score = pool(std::move(frames), evaluation.frequencies(), pair.frames > 1);
  return out;
}

}  // namespace limen::perception::cvvdp
