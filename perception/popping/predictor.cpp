// SPDX-License-Identifier: BSD-3-Clause
//
// Schwarz 2009, section 10.3, step by step under the headings below. Where the thesis leaves a choice:
//  - displacements enter as speed, which is filtered and halved like the colours, so that each level has the
//  velocity of its pixels' content;
//  - adaptation luminance is interpolated linearly from the level of about a degree; levels coarser than that
//    use their own;
//  - differences of coarse levels are interpolated linearly, sign and all, before they are raised
//    (Collapse::Signed).
#include "perception/popping/predictor.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <set>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/multiscale/pyramid.h"
#include "perception/popping/input.h"
#include "perception/popping/sensitivity.h"
#include "perception/popping/summed_differences.h"
#include "perception/popping/temporal_sensitivity.h"
#include "perception/vision/colour.h"
#include "perception/vision/masking.h"

namespace limen::perception {
namespace {

using Planes = std::array<Plane, 3>;

/// Gaussian pyramids of a frame.
struct FrameLevels {
  std::array<std::vector<Plane>, 3> lms;
  std::vector<Plane> speedPx;  ///< pixels per frame; empty: at rest
};

/// Y of cone responses: the inverse of lmsFromXyz()'s matrix, second row.
glm::dvec3 luminanceRow() {
  const glm::dmat3 lmsOfXyz(lmsFromXyz({1, 0, 0}), lmsFromXyz({0, 1, 0}), lmsFromXyz({0, 0, 1}));
  const glm::dmat3 inverse = glm::inverse(lmsOfXyz);
  return {inverse[0].y, inverse[1].y, inverse[2].y};
}

/// What a level of a frame shows, if the model over time is used.
struct Content {
  Planes contrast;  ///< A, a, b over the band's gain; of fitted parts, as if all were at the band's peak
  Plane luminance;
};

class Predictor {
 public:
  Predictor(const PoppingInput& input, const DisplayProfile& display, const PoppingSettings& settings,
            const PoppingOptions& options)
      : input_(input),
        display_(display),
        settings_(settings),
        width_(input.actual.width),
        height_(input.actual.height),
        isStack_(settings.bands.isStack()),
        luminanceRow_(settings.sensitivity.isDkl() ? glm::dvec3(1, 0, 0) : luminanceRow()),
        isDkl_(settings.sensitivity.isDkl()),
        isFitted_(settings.bands.isFitted()),
        greyGain_(opponentFromLms({1, 1, 1}).x / settings.sensitivity.greyGain()) {
    result_.model = poppingModel(width_, height_, display, settings);
    pyramid_.levels = result_.model.gaussianLevels;
    pyramid_.kernel = settings.bands.kernel();
    pyramid_.upsampler = settings.bands.upsampler();
    sensitivity_.emplace(result_.model, display, settings, options.tables);
    if (const auto* channels = std::get_if<TemporalChannels>(&settings.temporal); channels && input.isSwitch)
      temporal_.emplace(result_.model, display, settings, *channels, *sensitivity_);
    const Masking masking = makeMasking(settings.masking, "popping");
    transducer_ = masking.transducer;
    closedForm_ = options.tables && isCubic(settings.masking);
    if (const auto* extended = std::get_if<ExtendedMasking>(&settings.neighbourhood))
      neighbourhood_ = *extended;
    const std::vector<std::string> known = poppingStages(result_.model);
    for (const std::string& name : options.stages) {
      if (name == "all")
        wanted_.insert(known.begin(), known.end());
      else if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error("no stage '" + name + "'", "popping", suggest(name, known));
      else
        wanted_.insert(name);
    }
  }

  PoppingResult run() {
    const bool still = input_.actualDisplacement.data.empty() && input_.predictedDisplacement.data.empty();
    const Image& actualMove =
        input_.actualDisplacement.data.empty() ? input_.predictedDisplacement : input_.actualDisplacement;
    const Image& predictedMove =
        input_.predictedDisplacement.data.empty() ? input_.actualDisplacement : input_.predictedDisplacement;
    const FrameLevels actual = decompose(input_.actual, still ? nullptr : &actualMove, "actual");
    const FrameLevels predicted = decompose(input_.predicted, still ? nullptr : &predictedMove, "predicted");
    result_.flushedInputs = flushed_;

    std::vector<Planes> differences;
    for (int level = 0; level < result_.model.contrastLevels; ++level) {
      Content before, after;
      Planes response = respond(actual, predicted, level, "actual", after);
      const Planes other = respond(predicted, actual, level, "predicted", before);
      if (temporal_)
        response = switchBetween(predicted, before, actual, after, level);
      else
        for (size_t c = 0; c < 3; ++c)
          for (size_t p = 0; p < response[c].data.size(); ++p) response[c].data[p] -= other[c].data[p];
      keep("difference_" + std::to_string(level), response);
      differences.push_back(std::move(response));
    }
    result_.guardedContrasts = guarded_;
    collapse(differences);
    findRegionsAndSum();
    return std::move(result_);
  }

 private:
  void keep(const std::string& name, const std::vector<const Plane*>& channels) {
    if (wanted_.count(name) == 0) return;
    Image image(channels[0]->width, channels[0]->height, static_cast<int>(channels.size()));
    for (size_t p = 0; p < image.pixels(); ++p)
      for (size_t c = 0; c < channels.size(); ++c)
        image.data[p * channels.size() + c] = static_cast<float>(channels[c]->data[p]);
    result_.stages[name] = std::move(image);
  }
  void keep(const std::string& name, const Planes& planes) {
    keep(name, {&planes[0], &planes[1], &planes[2]});
  }

  size_t index(int x, int y) const { return static_cast<size_t>(y) * width_ + x; }

  // Light, cone responses, Gaussian pyramid.
  FrameLevels decompose(const Image& image, const Image* displacement, const std::string& frame) {
    Planes lms{Plane(width_, height_), Plane(width_, height_), Plane(width_, height_)};
    Plane speed;
    if (displacement) speed = Plane(width_, height_);
    forRowBlocks(height_, static_cast<size_t>(width_) * 64, [&](int first, int end) {
      int64_t flushed = 0;
      for (int y = first; y < end; ++y)
        for (int x = 0; x < width_; ++x) {
          for (int c = 0; c < std::min(image.channels, 3); ++c)
            if (!std::isfinite(image.at(x, y, c))) ++flushed;
          const glm::dvec3 xyz = display_.xyz(pixelLight(input_, image, display_, x, y));
          const glm::dvec3 cones = isDkl_ ? dklFromXyz(xyz) : lmsFromXyz(xyz);
          for (int c = 0; c < 3; ++c) lms[static_cast<size_t>(c)].at(x, y) = cones[c];
          if (!displacement) continue;
          std::array<double, 2> move{};
          for (int c = 0; c < 2; ++c) {
            const double value = displacement->at(x, y, c);
            if (std::isfinite(value))
              move[static_cast<size_t>(c)] = value;
            else
              ++flushed;
          }
          speed.at(x, y) = std::hypot(move[0], move[1]);
        }
      flushed_ += flushed;
    });
    FrameLevels levels;
    const auto levelsOf = [&](const Plane& plane) {
      return isStack_ ? dilatedStack(plane, pyramid_) : gaussianPyramid(plane, pyramid_);
    };
    for (size_t c = 0; c < 3; ++c) levels.lms[c] = levelsOf(lms[c]);
    if (displacement) levels.speedPx = levelsOf(speed);
    for (int i = 0; i < result_.model.gaussianLevels; ++i) {
      const auto at = static_cast<size_t>(i);
      std::vector<const Plane*> channels = {&levels.lms[0][at], &levels.lms[1][at], &levels.lms[2][at]};
      Plane rest;
      if (!displacement) rest = Plane(channels[0]->width, channels[0]->height);
      channels.push_back(displacement ? &levels.speedPx[at] : &rest);
      keep("lms_" + frame + "_" + std::to_string(i), channels);
    }
    return levels;
  }

  // Adaptation luminance, at the size of a level.
  Plane adaptation(const FrameLevels& frame, int level) const {
    const Plane& own = frame.lms[0][static_cast<size_t>(level)];
    if (const auto* fixed = std::get_if<FixedAdaptation>(&settings_.adaptation))
      return Plane(own.width, own.height, fixed->luminanceCdM2);
    const bool mean = std::holds_alternative<MeanAdaptation>(settings_.adaptation);
    const int from = mean ? result_.model.gaussianLevels - 1 : std::max(result_.model.adaptationLevel, level);
    const auto at = static_cast<size_t>(from);
    Plane luminance(frame.lms[0][at].width, frame.lms[0][at].height);
    for (size_t p = 0; p < luminance.data.size(); ++p)
      for (int c = 0; c < 3; ++c)
        luminance.data[p] += luminanceRow_[c] * frame.lms[static_cast<size_t>(c)][at].data[p];
    if (mean) {
      double sum = 0.0;
      for (const double value : luminance.data) sum += value;
      return Plane(own.width, own.height, sum / static_cast<double>(luminance.data.size()));
    }
    if (from == level || isStack_) return luminance;
    return resample(luminance, bilinearTaps(luminance.width, own.width, true, from - level, pyramid_.border),
                    bilinearTaps(luminance.height, own.height, true, from - level, pyramid_.border));
  }

  double transducer(double c) const {
    if (!closedForm_) return transducer_(c);
    // (9.9) with one power instead of three; for |c| > 1 in the form that does not overflow.
    const double x = std::abs(c);
    if (x <= 1.0) return c * std::pow(1.0 + x * x * x, -0.1);
    return std::copysign(std::pow(x, 0.7) * std::pow(1.0 + 1.0 / (x * x * x), -0.1), c);
  }

  /// Responses to contrasts over their thresholds.
  Plane maskedByNeighbours(Plane normalised, int level) const {
    const Plane elevation = neighbourhoodElevation(normalised, *neighbourhood_, isStack_ ? 1 << level : 1);
    for (size_t p = 0; p < normalised.data.size(); ++p)
      normalised.data[p] = transducer(normalised.data[p]) / elevation.data[p];
    return normalised;
  }

  /// A level at its own size, blurred along both axes.
  Plane blur(const Plane& plane, const std::array<double, 5>& taps) const {
    Kernel kernel;
    kernel.taps = taps;
    return resample(plane, dilatedTaps(plane.width, kernel, 1, pyramid_.border),
                    dilatedTaps(plane.height, kernel, 1, pyramid_.border));
  }

  /// Contrasts of the opponent channels from those of the planes.
  glm::dvec3 opponentOf(const glm::dvec3& contrast) const {
    if (isDkl_) return contrast;
    glm::dvec3 opponent = opponentFromLms(contrast);
    opponent.x /= greyGain_;
    return opponent;
  }

  // Contrast, opponent colours, normalisation by sensitivity, masking. In a switch to or from `other`, parts
  // of bands are weighted for both frames' mean speed, as in switchBetween().
  Planes respond(const FrameLevels& frame, const FrameLevels& other, int level, const std::string& name,
                 Content& content) {
    const std::string suffix = name + "_" + std::to_string(level);
    const auto i = static_cast<size_t>(level);
    Planes contrast, coarser, once, twice;
    for (size_t c = 0; c < 3; ++c) {
      contrast[c] = isStack_ ? frame.lms[c][i + 1] : upsampleLevel(frame.lms[c], level + 1, level, pyramid_);
      if (c > 0 && isDkl_)
        coarser[c] = coarser[0];
      else
        coarser[c] = isStack_ ? frame.lms[c][i + 2] : upsampleLevel(frame.lms[c], level + 2, level, pyramid_);
      const Plane& own = frame.lms[c][i];
      if (isFitted_) {
        once[c] = blur(own, {0.0, 0.25, 0.5, 0.25, 0.0});
        twice[c] = blur(own, Kernel::binomial5().taps);
      }
      for (size_t p = 0; p < own.data.size(); ++p) {
        if (!(coarser[c].data[p] >= settings_.bands.denominatorEpsilon)) guarded_ += isDkl_ ? 3 : 1;
        coarser[c].data[p] = std::max(coarser[c].data[p], settings_.bands.denominatorEpsilon);
        contrast[c].data[p] = (own.data[p] - contrast[c].data[p]) / coarser[c].data[p];
      }
    }
    Plane luminance = adaptation(frame, level);
    keep("luminance_" + suffix, {&luminance});
    const int width = contrast[0].width, height = contrast[0].height;
    Plane velocity(width, height);
    Planes response{Plane(width, height), Plane(width, height), Plane(width, height)};
    if (isFitted_ && temporal_) content.contrast.fill(Plane(width, height));
    const double gain = result_.model.gain[i];
    forRowBlocks(height, static_cast<size_t>(width) * 400, [&](int first, int end) {
      for (int y = first; y < end; ++y)
        for (int x = 0; x < width; ++x) {
          const double speedPx = frame.speedPx.empty() ? 0.0 : frame.speedPx[i].at(x, y);
          const double v = retinalVelocityDegS(
              screenVelocityDegS(speedPx, display_.refreshHz, result_.model.pixelsPerDegree), eyeModel_,
              leastVelocityDegS_);
          velocity.at(x, y) = v;
          const glm::dvec3 whole(contrast[0].at(x, y), contrast[1].at(x, y), contrast[2].at(x, y));
          const glm::dvec3 opponent = opponentOf(whole) / gain;
          glm::dvec3 normalised;
          if (isFitted_) {
            const size_t p = static_cast<size_t>(y) * static_cast<size_t>(width) + x;
            const double ofParts =
                temporal_ ? retinalVelocityDegS(0.5 * (screenDegS(frame, i, p) + screenDegS(other, i, p)),
                                                eyeModel_, leastVelocityDegS_)
                          : v;
            Sensitivity::PartWeights weights = sensitivity_->weights(level, ofParts, luminance.at(x, y));
            if (temporal_) weights.peak = sensitivity_->weights(level, v, luminance.at(x, y)).peak;
            glm::dvec3 parts[kBandParts];
            for (int c = 0; c < 3; ++c) {
              const auto at = static_cast<size_t>(c);
              const double own = frame.lms[at][i].at(x, y), scale = 1.0 / coarser[at].at(x, y);
              parts[0][c] = (own - once[at].at(x, y)) * scale;
              parts[1][c] = (once[at].at(x, y) - twice[at].at(x, y)) * scale;
              parts[2][c] = whole[c] - (own - twice[at].at(x, y)) * scale;
            }
            glm::dvec3 atPeak(0.0);
            for (size_t k = 0; k < kBandParts; ++k) {
              const auto& relative = weights.relative[k];
              atPeak += glm::dvec3(relative[0], relative[1], relative[2]) * opponentOf(parts[k]);
            }
            normalised = atPeak * glm::dvec3(weights.peak[0], weights.peak[1], weights.peak[2]);
            if (temporal_)
              for (int c = 0; c < 3; ++c) content.contrast[static_cast<size_t>(c)].at(x, y) = atPeak[c];
          } else {
            const std::array<double, 3> s = sensitivity_->at(level, v, luminance.at(x, y));
            normalised = opponent * glm::dvec3(s[0], s[1], s[2]);
          }
          for (int c = 0; c < 3; ++c) {
            const auto at = static_cast<size_t>(c);
            contrast[at].at(x, y) = opponent[c];
            response[at].at(x, y) = neighbourhood_ ? normalised[c] : transducer(normalised[c]);
          }
        }
    });
    if (neighbourhood_)
      for (Plane& plane : response) plane = maskedByNeighbours(std::move(plane), level);
    keep("contrast_" + suffix, contrast);
    keep("velocity_" + suffix, {&velocity});
    keep("response_" + suffix, response);
    if (!(isFitted_ && temporal_)) content.contrast = std::move(contrast);
    content.luminance = std::move(luminance);
    return response;
  }

  double screenDegS(const FrameLevels& frame, size_t level, size_t pixel) const {
    const double speedPx = frame.speedPx.empty() ? 0.0 : frame.speedPx[level].data[pixel];
    return screenVelocityDegS(speedPx, display_.refreshHz, result_.model.pixelsPerDegree);
  }

  // Differences of a switch from one content to the other, over time. Both move with the mean of their
  // speeds.
  Planes switchBetween(const FrameLevels& from, const Content& before, const FrameLevels& to,
                       const Content& after, int level) const {
    const int width = before.luminance.width, height = before.luminance.height;
    Planes out{Plane(width, height), Plane(width, height), Plane(width, height)};
    std::array<std::array<Plane, 2>, kTemporalMechanisms> extremes;  // after, before; with a neighbourhood
    if (neighbourhood_)
      for (auto& mechanism : extremes) mechanism.fill(Plane(width, height));
    forRowBlocks(height, static_cast<size_t>(width) * 800, [&](int first, int end) {
      for (size_t p = static_cast<size_t>(first) * width; p < static_cast<size_t>(end) * width; ++p) {
        const auto i = static_cast<size_t>(level);
        const double screen = 0.5 * (screenDegS(from, i, p) + screenDegS(to, i, p)),
                     retinal = retinalVelocityDegS(screen, eyeModel_, leastVelocityDegS_);
        const auto contrast = [&](const Content& content) {
          return std::array<double, 3>{content.contrast[0].data[p], content.contrast[1].data[p],
                                       content.contrast[2].data[p]};
        };
        const TemporalGains afterGains = temporal_->at(level, retinal, after.luminance.data[p]),
                            beforeGains = temporal_->at(level, retinal, before.luminance.data[p]);
        const double blur = temporal_->holdBlurAt(level, screen, retinal);
        if (neighbourhood_) {
          const SwitchExtremes here =
              switchExtremes(contrast(after), afterGains, contrast(before), beforeGains, blur);
          for (size_t m = 0; m < kTemporalMechanisms; ++m)
            extremes[m][0].data[p] = here.after[m], extremes[m][1].data[p] = here.before[m];
          continue;
        }
        const std::array<double, 3> difference =
            switchDifference(contrast(after), afterGains, contrast(before), beforeGains, blur,
                             [this](double c) { return transducer(c); });
        for (size_t c = 0; c < 3; ++c) out[c].data[p] = difference[c];
      }
    });
    if (neighbourhood_)
      for (size_t m = 0; m < kTemporalMechanisms; ++m) {
        const Plane afterwards = maskedByNeighbours(std::move(extremes[m][0]), level),
                    beforehand = maskedByNeighbours(std::move(extremes[m][1]), level);
        Plane& sum = out[kChannelOfMechanism[m]];
        for (size_t p = 0; p < sum.data.size(); ++p) sum.data[p] += afterwards.data[p] - beforehand.data[p];
      }
    return out;
  }

  // Minkowski sum over levels and channels; weights.
  void collapse(const std::vector<Planes>& differences) {
    SummedDifferences sums = sumDifferences(differences, input_, settings_);
    keep("jnd", {&sums.jnd});
    keep("signed_jnd", {&sums.signedJnd});
    keep("weight", {&sums.weight});
    result_.jnd = Image(width_, height_, 1);
    std::transform(sums.weightedJnd.data.begin(), sums.weightedJnd.data.end(), result_.jnd.data.begin(),
                   [](double value) { return static_cast<float>(value); });
    if (wanted_.count("weighted_jnd")) result_.stages["weighted_jnd"] = result_.jnd;
    result_.summary.meanJnd = meanOf(sums.weightedJnd);
    result_.summary.signedMeanJnd = meanOf(sums.signedJnd);
    result_.jndExact = std::move(sums.weightedJnd.data);
  }

  void findRegionsAndSum() {
    std::vector<uint8_t> seeds(result_.jndExact.size(), 1);
    if (settings_.regions.seeds == SeedRule::ColourDiffers)
      for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
          seeds[index(x, y)] =
              pixelValues(input_.actual, x, y) != pixelValues(input_.predicted, x, y) ? 1 : 0;
    result_.regions = findRegions(result_.jndExact, seeds, width_, height_, settings_);

    PoppingSummary& summary = result_.summary;
    for (size_t p = 0; p < seeds.size(); ++p) {
      summary.largestJnd = std::max(summary.largestJnd, result_.jndExact[p]);
      if (!(result_.jndExact[p] >= settings_.regions.thresholdJnd)) continue;
      ++summary.aboveThresholdPx;
      if (seeds[p]) ++summary.seedPx;
    }
    summary.largestRating = -std::numeric_limits<double>::infinity();
    for (const PoppingRegion& region : result_.regions.regions) {
      summary.regionPx += region.sizePx;
      summary.largestRating = std::max(summary.largestRating, region.rating);
    }
    summary.coverage = static_cast<double>(summary.regionPx) / static_cast<double>(seeds.size());
    summary.detectionProbability = settings_.detection.probability(summary.largestRating);

    const auto keepByPixel = [&](const std::string& name, const auto& value) {
      if (wanted_.count(name) == 0) return;
      Image image(width_, height_, 1);
      for (size_t p = 0; p < seeds.size(); ++p) image.data[p] = static_cast<float>(value(p));
      result_.stages[name] = std::move(image);
    };
    keepByPixel("seeds", [&](size_t p) { return seeds[p]; });
    keepByPixel("labels", [&](size_t p) { return result_.regions.labels[p]; });
    keepByPixel("rating", [&](size_t p) {
      const uint32_t label = result_.regions.labels[p];
      return label == 0 ? 0.0 : result_.regions.regions[label - 1].rating;
    });
  }

  const PoppingInput& input_;
  const DisplayProfile& display_;
  const PoppingSettings& settings_;
  const EyeMovement eyeModel_ = settings_.eyeModel();
  const double leastVelocityDegS_ = settings_.leastVelocityDegS();
  const int width_, height_;
  const bool isStack_;
  const glm::dvec3 luminanceRow_;
  const bool isDkl_, isFitted_;
  const double greyGain_;  // of cone contrasts
  PyramidSettings pyramid_;
  std::optional<Sensitivity> sensitivity_;
  std::optional<TemporalSensitivity> temporal_;  // of a switch that is seen over time
  std::function<double(double)> transducer_;
  bool closedForm_ = false;
  std::optional<ExtendedMasking> neighbourhood_;  // if contrasts are masked by their neighbours
  std::set<std::string> wanted_;
  std::atomic<int64_t> flushed_{0};
  int64_t guarded_ = 0;
  PoppingResult result_;
};

}  // namespace

PoppingResult predictPopping(const PoppingInput& input, const DisplayProfile& display,
                             const PoppingSettings& settings, const PoppingOptions& options) {
  checkPoppingInput(input);
  return Predictor(input, display, settings, options).run();
}

}  // namespace limen::perception
