// SPDX-License-Identifier: BSD-3-Clause
#include "perception/band_thresholds/band_threshold_gpu.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "experiments/base/error.h"
#include "perception/band_thresholds/band_threshold_bindings.h"
#include "perception/band_thresholds/model.h"

namespace limen::perception {
namespace {

using gl::Access;
using gl::Format;

constexpr const char* kFolder = "perception/band_thresholds/";
constexpr glm::ivec2 kReduceGroup{kBandReduceX, kBandReduceY}, kTile{kBandTileX, kBandTileY};
constexpr float kLargestCdM2 = 1e8F;

const char* yes(bool value) { return value ? "1" : "0"; }

/// For linear interpolation inside cells: (value at the start, rise).
std::vector<glm::vec2> sensitivityTable(const BandThresholdModel& model) {
  std::vector<glm::vec2> out(static_cast<size_t>(model.bands()) * kBandCells);
  forRowBlocks(model.bands() * kBandCells, 2000, [&](int first, int end) {
    for (int i = first; i < end; ++i) {
      const auto at = [&](int cell) {
        return model.sensitivity(
            i / kBandCells, std::pow(10.0, kBandLgLow + static_cast<double>(cell) / kBandCellsPerDecade));
      };
      const double start = at(i % kBandCells);
      out[static_cast<size_t>(i)] = {start, at(i % kBandCells + 1) - start};
    }
  });
  return out;
}

std::vector<glm::vec2> stepTable(const BandThresholdModel& model) {
  std::vector<glm::vec2> out(static_cast<size_t>(kBandSegments) * kBandOctaves);
  forRowBlocks(static_cast<int>(out.size()), 20000, [&](int first, int end) {
    for (int i = first; i < end; ++i) {
      const auto at = [&](int place) {
        return model.step(
            std::ldexp(1.0 + static_cast<double>(place) / kBandSegments, kBandLowOctave + i / kBandSegments));
      };
      const double start = at(i % kBandSegments);
      out[static_cast<size_t>(i)] = {start, at(i % kBandSegments + 1) - start};
    }
  });
  return out;
}

void checkSettings(const BandThresholdSettings& settings) {
  const PoppingSettings& predictor = settings.predictor;
  if (predictor.bands.upsampler() != Upsampler::Expand)
    throw Error("levels are upsampled with the kernel on the GPU", "predictor.bands.decomposition.upsampler",
                "use expand, or the technique perception/threshold_map_reference");
  if (std::holds_alternative<MeanAdaptation>(predictor.adaptation))
    throw Error("adaptation to the mean is not computed on the GPU", "predictor.adaptation",
                "use local or fixed, or the technique perception/threshold_map_reference");
}

}  // namespace

BandThresholdGpu::BandThresholdGpu(gl::Context& context, glm::ivec2 sizePx, const DisplayProfile& display,
                                   const BandThresholdSettings& settings, bool colourInput)
    : context_(context), sizePx_(sizePx), settings_(settings), map_(Format::R32F, sizePx) {
  checkSettings(settings);
  const BandThresholdModel model(settings, display, sizePx.x, sizePx.y);
  settings.checkBand(model.bands());
  bands_ = model.bands();
  adaptationLevel_ = model.predictor().adaptationLevel;
  for (int band = 0; band < bands_; ++band) {
    gains_.push_back(static_cast<float>(model.predictor().gain[static_cast<size_t>(band)]));
    spreads_.push_back(static_cast<float>(model.spread(band)));
  }
  if (const auto* band = std::get_if<BandOutput>(&settings.output); band && bands_ > 0)
    shownBand_ = band->band;
  const auto* fixed = std::get_if<FixedAdaptation>(&settings.predictor.adaptation);
  if (fixed) fixedLuminance_ = static_cast<float>(fixed->luminanceCdM2);
  light_ = {display.blackLevelCdM2(), display.whiteLevelCdM2() - display.blackLevelCdM2(), kLargestCdM2};
  const Kernel kernel = settings.predictor.bands.kernel();
  taps_ = {kernel.taps[0], kernel.taps[1], kernel.taps[2]};
  const double evenSum = 2.0 * kernel.taps[0] + kernel.taps[2];
  evenTaps_ = {kernel.taps[0] / evenSum, kernel.taps[2] / evenSum};
  uniformShare_ = static_cast<float>(model.uniformCdM2(1.0));

  gl::ProgramCache& programs = context.programs();
  const auto make = [&](const char* file, const gl::ShaderDefines& defines) {
    return &programs.compute(std::string(kFolder) + file, defines);
  };
  if (bands_ == 0) {
    uniform_ = make("uniform.comp.glsl",
                    {{"COLOUR", yes(colourInput)}, {"FIXED_ADAPTATION", yes(fixed != nullptr)}});
    return;
  }
  levels_.emplace(Format::R32F, sizePx, bands_ + 2);
  if (bands_ > 1)
    coarser_.emplace(Format::R32F, glm::ivec2(std::max(sizePx.x / 2, 1), std::max(sizePx.y / 2, 1)),
                     bands_ - 1);
  sensitivities_.emplace(sensitivityTable(model));
  steps_.emplace(stepTable(model));
  first_ = make("reduce.comp.glsl", {{"COLOUR", yes(colourInput)}, {"FIRST", "1"}});
  next_ = make("reduce.comp.glsl", {{"COLOUR", "0"}, {"FIRST", "0"}});
  coarsest_ = &thresholdProgram(false);
  other_ = &thresholdProgram(true);
  if (shownBand_) {
    own_.emplace(Format::R32F, sizePx, bands_);
    enlarge_ = make("enlarge.comp.glsl", {});
  }
}

const gl::Program& BandThresholdGpu::thresholdProgram(bool coarser) const {
  const bool fixed = std::holds_alternative<FixedAdaptation>(settings_.predictor.adaptation);
  return context_.programs().compute(std::string(kFolder) + "thresholds.comp.glsl",
                                     {{"REACH", std::to_string(shownBand_ ? 0 : settings_.reach)},
                                      {"COARSER", yes(coarser)},
                                      {"COMBINED", yes(!shownBand_)},
                                      {"OWN", yes(keepsBands_ || shownBand_)},
                                      {"FIXED_ADAPTATION", yes(fixed)}});
}

void BandThresholdGpu::keepBands() {
  if (bands_ == 0) return;
  keepsBands_ = true;
  if (!own_) own_.emplace(Format::R32F, sizePx_, bands_);
  coarsest_ = &thresholdProgram(false);
  other_ = &thresholdProgram(true);
}

const gl::Texture& BandThresholdGpu::run(const gl::Texture& input, gl::PassList* passes,
                                         const std::optional<MapArea>& only) {
  assert(input.sizePx() == sizePx_);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  const auto timed = [&](const char* name, const auto& work) {
    if (!passes) return work();
    const gl::PassList::Scope scope = passes->open(name);
    work();
  };
  if (bands_ == 0) {
    timed(kThresholdEvaluationPass, [&] {
      input.bindTexture(kBandReduceSourceUnit);
      map_.bindImage(kBandCombinedImage, Access::Write);
      uniform_->set("light", light_);
      uniform_->set("taps", taps_);
      uniform_->set("adaptationLevel", adaptationLevel_);
      uniform_->set("epsilon", static_cast<float>(settings_.predictor.bands.denominatorEpsilon));
      uniform_->set("share", uniformShare_);
      uniform_->set("fixedLuminance", fixedLuminance_);
      uniform_->dispatch(sizePx_, kReduceGroup);
    });
  } else {
    timed(kThresholdLevelsPass, [&] { reduce(input); });
    timed(kThresholdEvaluationPass, [&] { evaluate(only.value_or(MapArea{glm::ivec2(0), sizePx_})); });
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT);
  return map_;
}

void BandThresholdGpu::reduce(const gl::Texture& input) {
  glm::ivec2 size = sizePx_;
  for (int level = 0; level <= bands_; ++level) {
    const gl::Program& program = level == 0 ? *first_ : *next_;
    (level == 0 ? input : *levels_).bindTexture(kBandReduceSourceUnit);
    if (level == 0) {
      levels_->bindImage(kBandReduceFineImage, Access::Write, 0);
      program.set("light", light_);
    }
    levels_->bindImage(kBandReduceCoarserImage, Access::Write, level + 1);
    program.set("sourceLevel", level);
    program.set("taps", taps_);
    size = {std::max(size.x / 2, 1), std::max(size.y / 2, 1)};
    program.dispatch(size, kReduceGroup);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
}

void BandThresholdGpu::evaluate(const MapArea& area) {
  // Each band reads samples of the next coarser one up to the one after its own, which reads on: the last is
  // at most two beyond the area's.
  const auto needed = [&](int band) {
    const glm::ivec2 size = glm::max(sizePx_ >> band, glm::ivec2(1));
    return MapArea{glm::min(area.low >> band, size - 1),
                   glm::min(((area.high - 1) >> band) + (band > 0 ? 3 : 1), size)};
  };
  levels_->bindTexture(kBandLevelsUnit);
  if (coarser_) coarser_->bindTexture(kBandCoarserUnit);
  sensitivities_->bindStorage(kBandSensitivitiesBuffer);
  steps_->bindStorage(kBandStepsBuffer);
  for (int band = bands_ - 1; band >= 0; --band) {
    if (shownBand_ && !keepsBands_ && band != *shownBand_) continue;
    const gl::Program& program = band == bands_ - 1 ? *coarsest_ : *other_;
    if (band == 0)
      map_.bindImage(kBandCombinedImage, Access::Write);
    else
      coarser_->bindImage(kBandCombinedImage, Access::Write, band - 1);
    if (own_) own_->bindImage(kBandOwnImage, Access::Write, band);
    program.set("level", band);
    program.set("adaptationLevel", adaptationLevel_);
    program.set("coarserLevel", band);
    program.set("evenTaps", evenTaps_);
    program.set("epsilon", static_cast<float>(settings_.predictor.bands.denominatorEpsilon));
    program.set("gain", gains_[static_cast<size_t>(band)]);
    program.set("spread", spreads_[static_cast<size_t>(band)]);
    program.set("fixedLuminance", fixedLuminance_);
    const MapArea samples = needed(band);
    program.set("origin", samples.low);
    program.dispatch(samples.high - samples.low, kTile);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
  if (!shownBand_) return;
  own_->bindTexture(kBandEnlargeSourceUnit);
  map_.bindImage(kBandEnlargeImage, Access::Write);
  enlarge_->set("level", *shownBand_);
  enlarge_->set("origin", area.low);
  enlarge_->dispatch(glm::min(area.high, sizePx_) - area.low, kReduceGroup);
}

std::map<std::string, const gl::Texture*> BandThresholdGpu::debugViews() const {
  std::map<std::string, const gl::Texture*> out;
  if (levels_) out["gaussian"] = &*levels_;
  if (coarser_ && !shownBand_) out["combined"] = &*coarser_;
  if (own_) out["bands"] = &*own_;
  return out;
}

int64_t BandThresholdGpu::bytesHeld() const {
  int64_t bytes = map_.bytes();
  for (const auto* texture : {&levels_, &coarser_, &own_})
    if (*texture) bytes += (*texture)->bytes();
  return bytes + (steps_ ? steps_->bytes() + sensitivities_->bytes() : 0);
}

int64_t BandThresholdGpu::bytesMoved(const gl::Texture& input) const {
  // The input and the map once; levels are written, and read by the next one and by two bands; combined
  // thresholds are written and read.
  int64_t bytes = input.bytes() + map_.bytes();
  if (levels_) bytes += 3 * levels_->bytes();
  if (coarser_) bytes += 2 * coarser_->bytes();
  if (own_) bytes += 2 * own_->bytes();
  return bytes;
}

}  // namespace limen::perception
