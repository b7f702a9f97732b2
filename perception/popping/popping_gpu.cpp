// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/popping_gpu.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/popping/band_weights.h"
#include "perception/popping/gpu/open_pass.h"
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/response_tables.h"
#include "perception/vision/colour.h"
#include "perception/vision/masking.h"

namespace limen::perception {
namespace {

using gl::Access;
using gl::Format;

constexpr glm::ivec2 kGroup{kPoppingGroupX, kPoppingGroupY};
const std::string kFolder = "perception/popping/gpu/";

/// Sources of adaptation luminance, as distinguished in response.glsl.
enum class AdaptationSource { Level, Mean, Fixed };
constexpr EnumNames<AdaptationSource, 3> enumNames(AdaptationSource) {
  return {{{{AdaptationSource::Level, "level"},
            {AdaptationSource::Mean, "mean"},
            {AdaptationSource::Fixed, "fixed"}}}};
}

AdaptationSource sourceOf(const PoppingSettings& settings) {
  if (std::holds_alternative<MeanAdaptation>(settings.adaptation)) return AdaptationSource::Mean;
  return std::holds_alternative<FixedAdaptation>(settings.adaptation) ? AdaptationSource::Fixed
                                                                      : AdaptationSource::Level;
}

PoppingModel modelOf(glm::ivec2 sizePx, const DisplayProfile& display, const PoppingSettings& settings) {
  if (settings.bands.isStack())
    throw Error("decomposition 'stack' does not run on the GPU", "popping", "use pyramid, or the CPU");
  return poppingModel(sizePx.x, sizePx.y, display, settings);
}

/// A floating-point literal.
std::string number(double value) {
  const std::string text = shortestNumber(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

gl::ShaderDefines maskingDefines(const ChosenEntry& masking) {
  const std::string& name = masking.name;
  const ParameterValues values = completeValues<MaskingInfo>(masking, "popping");
  if (name == "none") return {{"MASKING_NONE", "1"}};
  if (isCubic(masking)) return {{"MASKING_CUBIC", "1"}};
  if (name == "schwarz" || name == "daly") {
    // (9.9) is (9.7) with k1 = k2 = 1.
    const auto daly = name == "daly" ? DalyMasking::table().read(values) : DalyMasking{};
    const auto schwarz = name == "schwarz" ? SchwarzMasking::table().read(values) : SchwarzMasking{};
    const double s = name == "daly" ? daly.s : schwarz.s, b = name == "daly" ? daly.b : schwarz.b;
    const double k = name == "daly" ? daly.k1 * std::pow(daly.k2, s) : 1.0;
    return {{"MASKING_ELEVATION", "1"},
            {"MASKING_K", number(k)},
            {"MASKING_S", number(s)},
            {"MASKING_B", number(b)}};
  }
  if (name == "lubin") {
    const auto lubin = LubinMasking::table().read(values);
    return {{"MASKING_LUBIN", "1"}, {"MASKING_N", number(lubin.n)}, {"MASKING_W", number(lubin.w)}};
  }
  if (name == "self") return {{"MASKING_ALPHA", number(SelfMasking::table().read(values).alpha)}};
  throw Error("masking model '" + name + "' does not run on the GPU", "popping",
              "use none, daly, lubin, schwarz or self");
}

glm::dvec3 luminanceRow() {
  const glm::dmat3 lmsOfXyz(lmsFromXyz({1, 0, 0}), lmsFromXyz({0, 1, 0}), lmsFromXyz({0, 0, 1}));
  const glm::dmat3 inverse = glm::inverse(lmsOfXyz);
  return {inverse[0].y, inverse[1].y, inverse[2].y};
}

}  // namespace

PoppingPredictorGpu::PoppingPredictorGpu(gl::Context& context, glm::ivec2 sizePx,
                                         const DisplayProfile& display, const PoppingSettings& settings,
                                         bool isSwitch)
    : context_(context),
      sizePx_(sizePx),
      display_(display),
      settings_(settings),
      model_(modelOf(sizePx, display, settings)),
      defines_(maskingDefines(settings.masking)),
      luminanceOfCones_(settings.sensitivity.isDkl() ? glm::dvec3(1, 0, 0) : luminanceRow()),
      grid_(settings, display),
      cones_(Format::RGBA32F, sizePx, model_.gaussianLevels, 2),
      differences_(Format::RGBA32F, levelSize(1), std::max(1, model_.contrastLevels - 1)),
      sensitivities_(Format::RGBA32F, responseTablePx(model_, grid_)),
      jnd_(Format::R32F, sizePx),
      seeds_(Format::R8UI, sizePx),
      counters_(sizeof(PoppingCounters), nullptr),
      mean_(8, nullptr),
      regions_(context, sizePx, settings) {
  defineEnum(defines_, "EYE_MOVEMENT", settings.eyeModel());
  defineEnum(defines_, "ADAPTATION", sourceOf(settings));
  if (settings.collapse == Collapse::Magnitude) defines_["COLLAPSE_MAGNITUDE"] = "1";
  if (grid_.hasKink) defines_["CASTLE_KINK"] = "1";
  const bool isDkl = settings.sensitivity.isDkl();
  if (isDkl) defines_["CONTRAST_DKL"] = "1";
  if (settings.bands.isFitted() && model_.contrastLevels > 0) {
    defines_["FITTED_WEIGHTS"] = "1";
    defines_["LEAST_SENSITIVITY"] = number(BandWeights::kLeastSensitivity);
    partTable_ = partWeightTable(model_, display, settings);
    partWeights_.emplace(Format::RGBA32F, glm::ivec2(partTable_->weights.width, partTable_->weights.height));
    partWeights_->write(partTable_->weights);
  }
  const auto planesOf = [&](const std::array<double, 3>& light) {
    return isDkl ? dklFromXyz(display.xyz(light)) : lmsFromXyz(display.xyz(light));
  };
  const glm::dvec3 black = planesOf({0, 0, 0});
  if (std::holds_alternative<TemporalChannels>(settings.temporal) && isSwitch)
    defines_["TEMPORAL_CHANNELS"] = "1";
  if (const auto* extended = std::get_if<ExtendedMasking>(&settings.neighbourhood);
      extended && model_.contrastLevels > 0) {
    const double zone = extended->deadZone;
    defines_["MASKING_NEIGHBOURHOOD"] = "1";
    defines_["MASKING_RADIUS"] = std::to_string(extended->radiusPx);
    defines_["MASKING_BETA"] = number(extended->exponent);
    defines_["MASKING_STRENGTH"] = number(extended->strength);
    defines_["MASKING_DEAD_ZONE"] = number(zone);
    defines_["MASKING_LEAST"] = number(zone > 0.0 ? std::pow(zone, extended->exponent) : 0.0);
    normalised_.emplace(Format::RGBA32F, sizePx, model_.contrastLevels, 2);
  }
  stageDefines_ = defines_;
  stageDefines_["SHOW_STAGES"] = "1";
  conesOfBlack_ = black;
  conesOfLight_ =
      glm::dmat3(planesOf({1, 0, 0}) - black, planesOf({0, 1, 0}) - black, planesOf({0, 0, 1}) - black);
  sensitivities_.write(*sensitivityTable(model_, display, settings, grid_));
  if (const auto* channels = std::get_if<TemporalChannels>(&settings.temporal); channels && isSwitch)
    temporal_.emplace(model_, display, settings, *channels, grid_);
  if (normalised_) program("normalise");
  for (const char* name : {"light", "reduce", "mean", "difference", "collapse"}) program(name);
}

const gl::Program& PoppingPredictorGpu::program(const char* name) {
  return context_.programs().compute(kFolder + name + ".comp.glsl", defines_);
}

void PoppingPredictorGpu::run(const PoppingGpuInput& input, gl::PassList* passes) {
  {
    const auto pass = openPass(passes, "popping/light");
    counters_.clearUint(0);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                    GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    const gl::Program& light = program("light");
    const bool grey = gl::channelCount(input.actual->format()) < 3;
    assert(input.actual->sizePx() == sizePx_ && input.predicted->sizePx() == sizePx_ &&
           grey == (gl::channelCount(input.predicted->format()) < 3));
    const gl::Texture* actualMove =
        input.actualDisplacement ? input.actualDisplacement : input.predictedDisplacement;
    const gl::Texture* predictedMove =
        input.predictedDisplacement ? input.predictedDisplacement : input.actualDisplacement;
    input.actual->bindTexture(kLightActualUnit);
    input.predicted->bindTexture(kLightPredictedUnit);
    (actualMove ? actualMove : input.actual)->bindTexture(kLightActualDisplacementUnit);
    (predictedMove ? predictedMove : input.predicted)->bindTexture(kLightPredictedDisplacementUnit);
    cones_.bindImage(kLightConesImage, Access::Write);
    seeds_.bindImage(kLightSeedsImage, Access::Write);
    counters_.bindStorage(kPoppingCountersBuffer);
    light.set("frameCount", 2);
    light.set("grey", grey ? 1 : 0);
    light.set("transfer", input.linear ? 2 : static_cast<int>(display_.transfer));
    light.set("displayGamma", static_cast<float>(display_.gamma));
    light.set("hasDisplacement", actualMove ? 1 : 0);
    light.set("everySeed", settings_.regions.seeds == SeedRule::None ? 1 : 0);
    light.set("conesOfLight", conesOfLight_);
    light.set("conesOfBlack", conesOfBlack_);
    light.dispatch(sizePx_, kGroup);
  }
  {
    const auto pass = openPass(passes, "popping/pyramid");
    decompose(input);
  }
  if (normalised_) {
    const auto pass = openPass(passes, "popping/normalise");
    for (int level = 0; level < model_.contrastLevels; ++level) normalise(level, defines_);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
  {
    const auto pass = openPass(passes, "popping/difference");
    for (int level = 1; level < model_.contrastLevels; ++level) {
      const gl::Program& difference = program("difference");
      bindResponse(difference, level);
      differences_.bindImage(kDifferencesImage, Access::Write, level - 1);
      difference.set("exponent", static_cast<float>(settings_.minkowskiExponent));
      difference.dispatch(levelSize(level), kGroup);
    }
  }
  {
    const auto pass = openPass(passes, "popping/collapse");
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    collapse(input, jnd_, 0);
  }
  regions_.run(jnd_, seeds_, passes);
}

void PoppingPredictorGpu::decompose(const PoppingGpuInput&) {
  const std::array<double, 5> taps = settings_.bands.kernel().taps;
  const gl::Program& reduce = program("reduce");
  reduce.set("taps", glm::vec3(taps[0], taps[1], taps[2]));
  cones_.bindTexture(kReduceConesUnit);
  for (int level = 0; level + 1 < model_.gaussianLevels; ++level) {
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    cones_.bindImage(kReduceCoarserImage, Access::Write, level + 1);
    reduce.set("level", level);
    reduce.use();
    const glm::ivec2 groups = (levelSize(level + 1) + kGroup - 1) / kGroup;
    glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y), 2);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  if (!std::holds_alternative<MeanAdaptation>(settings_.adaptation)) return;
  const gl::Program& mean = program("mean");
  mean_.bindStorage(kMeanLuminanceBuffer);
  mean.set("level", model_.gaussianLevels - 1);
  mean.set("luminanceOfCones", luminanceOfCones_);
  mean.dispatch({2, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void PoppingPredictorGpu::bindResponse(const gl::Program& program, int level) {
  cones_.bindTexture(kResponseConesUnit);
  sensitivities_.bindTexture(kResponseSensitivitiesUnit);
  if (normalised_) normalised_->bindTexture(kResponseNormalisedUnit);
  counters_.bindStorage(kPoppingCountersBuffer);
  mean_.bindStorage(kMeanLuminanceBuffer);
  const std::array<double, 5> taps = settings_.bands.kernel().taps;
  const bool expand = settings_.bands.upsampler() == Upsampler::Expand;
  const auto* fixed = std::get_if<FixedAdaptation>(&settings_.adaptation);
  program.set("frameCount", 2);
  program.set("level", level);
  program.set("adaptationLevel", model_.adaptationLevel);
  program.set("adaptationSource", static_cast<int>(sourceOf(settings_)));
  program.set("eyeMovement", static_cast<int>(settings_.eyeModel()));
  program.set("evenTaps", expand ? glm::vec2(2.0 * taps[0], 2.0 * taps[2]) : glm::vec2(0.0F, 1.0F));
  program.set("luminanceOfCones", luminanceOfCones_);
  program.set("epsilon", static_cast<float>(settings_.bands.denominatorEpsilon));
  program.set("gain", static_cast<float>(
                          level < model_.contrastLevels ? model_.gain[static_cast<size_t>(level)] : 1));
  program.set("greyGain",
              static_cast<float>(opponentFromLms({1, 1, 1}).x / settings_.sensitivity.greyGain()));
  program.set("fixedLuminance", fixed ? static_cast<float>(fixed->luminanceCdM2) : 0.0F);
  program.set("leastVelocity", static_cast<float>(settings_.leastVelocityDegS()));
  program.set("degSPerPx",
              static_cast<float>(screenVelocityDegS(1.0, display_.refreshHz, model_.pixelsPerDegree)));
  program.set("table.size", grid_.size);
  program.set("table.low", glm::vec2(grid_.low));
  program.set("table.per", glm::vec2(grid_.per));
  if (grid_.hasKink) {
    program.set("kinkRow", static_cast<float>(grid_.kinkRow));
    program.set("perAboveKink", static_cast<float>(grid_.perAbove));
  }
  if (partTable_) {
    partWeights_->bindTexture(kResponsePartWeightsUnit);
    program.set("partTable.size", partTable_->size);
    program.set("partTable.low", glm::vec2(partTable_->low));
    program.set("partTable.per", glm::vec2(partTable_->per));
  }
  if (temporal_)
    temporal_->bind(program,
                    level < model_.contrastLevels ? model_.peakCpd[static_cast<size_t>(level)] : 0.0);
}

void PoppingPredictorGpu::normalise(int level, const gl::ShaderDefines& defines) {
  const gl::Program& program = context_.programs().compute(kFolder + "normalise.comp.glsl", defines);
  bindResponse(program, level);
  normalised_->bindImage(kNormalisedImage, Access::Write, level);
  program.dispatch(levelSize(level), kGroup);
}

void PoppingPredictorGpu::collapse(const PoppingGpuInput& input, const gl::Texture& target, int shown) {
  const gl::Program& collapse = program("collapse");
  bindResponse(collapse, 0);
  differences_.bindTexture(kCollapseDifferencesUnit);
  const bool disocclusion = input.disocclusion && settings_.usesDisocclusion();
  const bool flicker = input.flicker && settings_.usesFlicker();
  (disocclusion ? input.disocclusion : input.actual)->bindTexture(kCollapseDisocclusionUnit);
  (flicker ? input.flicker : input.actual)->bindTexture(kCollapseFlickerUnit);
  target.bindImage(kCollapseJndImage, Access::Write);
  collapse.set("contrastLevels", model_.contrastLevels);
  collapse.set("exponent", static_cast<float>(settings_.minkowskiExponent));
  collapse.set("hasWeight", glm::ivec2(disocclusion, flicker));
  collapse.set("shown", shown);
  collapse.dispatch(sizePx_, kGroup);
}

PoppingPredictorGpu::Counts PoppingPredictorGpu::readCounts() const {
  const PoppingCounters counts = counters_.read<PoppingCounters>().front();
  return {counts.flushed, counts.guarded};
}

Image PoppingPredictorGpu::debugImage(const std::string& name, const PoppingGpuInput& input) {
  const std::vector<std::string> known = poppingStages(model_);
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Error("no stage '" + name + "'", "popping", suggest(name, known));
  if (name == "weighted_jnd") return jnd_.read();
  const auto wholeNumbers = [&](const gl::Texture& texture) {
    const std::vector<uint32_t> values = texture.readUint();
    Image image(sizePx_.x, sizePx_.y, 1);
    std::transform(values.begin(), values.end(), image.data.begin(),
                   [](uint32_t value) { return static_cast<float>(value); });
    return image;
  };
  if (name == "seeds") return wholeNumbers(seeds_);
  if (name == "labels") return wholeNumbers(regions_.labels());
  if (name == "rating") {
    const RegionMap map = regions_.read();
    Image image(sizePx_.x, sizePx_.y, 1);
    for (size_t p = 0; p < image.data.size(); ++p)
      if (map.labels[p]) image.data[p] = static_cast<float>(map.regions[map.labels[p] - 1].rating);
    return image;
  }
  const PoppingCounters counts{readCounts().flushedInputs, readCounts().guardedContrasts};
  const auto restoreCounts = [&] {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    counters_.write(0, sizeof counts, &counts);
  };
  if (name == "jnd" || name == "weight" || name == "signed_jnd") {
    if (name == "signed_jnd" && settings_.collapse == Collapse::Magnitude)
      throw Error("no stage 'signed_jnd' on the GPU with collapse: magnitude", "popping",
                  "use collapse: signed");
    const gl::Texture target(Format::R32F, sizePx_);
    collapse(input, target, name == "jnd" ? 1 : name == "weight" ? 2 : 3);
    restoreCounts();
    return target.read();
  }
  const size_t underscore = name.rfind('_');
  const int level = std::stoi(name.substr(underscore + 1));
  const std::string stage = name.substr(0, underscore);
  const bool isPredicted = stage.ends_with("_predicted");
  if (stage.starts_with("lms_")) {
    const glm::ivec2 size = levelSize(level);
    Image image(size.x, size.y, 4);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureSubImage(cones_.id(), level, 0, 0, isPredicted ? 1 : 0, size.x, size.y, 1, GL_RGBA, GL_FLOAT,
                         static_cast<GLsizei>(image.data.size() * sizeof(float)), image.data.data());
    return image;
  }
  static const std::vector<std::string> kStages = {"contrast", "luminance", "velocity", "response",
                                                   "difference"};
  const auto index =
      std::find(kStages.begin(), kStages.end(), stage.substr(0, stage.find('_'))) - kStages.begin();
  // Responses are those to each frame alone, also of a switch over time.
  gl::ShaderDefines defines = stageDefines_;
  if (index != 4) defines.erase("TEMPORAL_CHANNELS");
  const bool isOverNeighbours = normalised_ && index == 3;
  if (normalised_ && index < 3) defines.erase("MASKING_NEIGHBOURHOOD");
  const auto normaliseAgain = [&](bool overTime) {
    gl::ShaderDefines own = defines_;
    if (!overTime) own.erase("TEMPORAL_CHANNELS");
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    normalise(level, own);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  };
  if (isOverNeighbours && temporal_) normaliseAgain(false);
  const gl::Texture target(Format::RGBA32F, levelSize(level));
  const gl::Program& difference = context_.programs().compute(kFolder + "difference.comp.glsl", defines);
  bindResponse(difference, level);
  target.bindImage(kDifferencesImage, Access::Write);
  difference.set("shownFrame", isPredicted ? 1 : 0);
  difference.set("shownStage", static_cast<int>(index));
  difference.dispatch(levelSize(level), kGroup);
  const Image all = target.read();
  if (isOverNeighbours && temporal_) {
    normaliseAgain(true);
    restoreCounts();
  }
  Image image(all.width, all.height, index == 1 || index == 2 ? 1 : 3);
  for (size_t p = 0; p < image.pixels(); ++p)
    for (int c = 0; c < image.channels; ++c)
      image.data[p * static_cast<size_t>(image.channels) + static_cast<size_t>(c)] =
          all.data[4 * p + static_cast<size_t>(c)];
  return image;
}

int64_t PoppingPredictorGpu::bytesHeld() const {
  return (normalised_ ? normalised_->bytes() : 0) + (partWeights_ ? partWeights_->bytes() : 0) +
         cones_.bytes() + differences_.bytes() + sensitivities_.bytes() +
         (temporal_ ? temporal_->bytes() : 0) + jnd_.bytes() + seeds_.bytes() + counters_.bytes() +
         mean_.bytes() + regions_.bytesHeld();
}

}  // namespace limen::perception
