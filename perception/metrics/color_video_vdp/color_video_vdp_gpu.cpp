// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp/color_video_vdp_gpu.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "experiments/base/error.h"
#include "perception/metrics/color_video_vdp/gpu/cvvdp_bindings.h"
#include "perception/metrics/color_video_vdp/pyramid.h"
#include "perception/metrics/color_video_vdp/sensitivity.h"

namespace limen::perception::cvvdp {
namespace {

using gl::Access;
using gl::Format;

constexpr int kResultFrames = 512;  ///< until they must be read
const std::string kFolder = "perception/metrics/color_video_vdp/gpu/";
constexpr glm::ivec2 kLightGroup{kCvvdpLightGroupX, kCvvdpLightGroupY};
constexpr glm::ivec2 kContrastGroup{kCvvdpContrastGroupX, kCvvdpContrastGroupY};
constexpr glm::ivec2 kMaskTile{kCvvdpMaskTileX, kCvvdpMaskTileY};

std::unique_ptr<gl::PassList::Scope> openPass(gl::PassList* passes, const char* name) {
  return std::unique_ptr<gl::PassList::Scope>(passes ? new gl::PassList::Scope(passes->open(name)) : nullptr);
}

glm::vec4 toVec4(const Channels& values) {
  return {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2]),
          static_cast<float>(values[3])};
}

/// `count` groups in two dimensions, of which drivers grant 65,535 each.
glm::ivec2 inTwoDimensions(int count) {
  constexpr int kAcross = 32768;
  return {std::min(count, kAcross), (count + kAcross - 1) / kAcross};
}

glm::ivec2 groupsOver(glm::ivec2 size, glm::ivec2 group) { return (size + group - 1) / group; }

std::vector<glm::vec4> sensitivityTable(const std::vector<double>& frequencies) {
  std::vector<glm::vec4> out;
  for (size_t band = 0; band < frequencies.size(); ++band) {
    std::array<std::vector<double>, kChannels> logs;
    for (int c = 0; c < kChannels; ++c) {
      const double gain =
          band + 1 < frequencies.size() ? parameters().channelGain[static_cast<size_t>(c)] : 1.0;
      const Sensitivity sensitivity(c, frequencies[band]);
      for (const double log : sensitivity.logs())
        logs[static_cast<size_t>(c)].push_back(log * std::log2(10.0) + std::log2(gain));
    }
    for (size_t i = 0; i < kSensitivityLevels; ++i)
      out.push_back(toVec4({logs[0][i], logs[1][i], logs[2][i], logs[3][i]}));
  }
  return out;
}

int maskGroupCount(const Atlas& atlas) {
  int count = 0;
  for (size_t band = 0; band + 1 < atlas.levels.size(); ++band) {
    const glm::ivec2 groups = groupsOver(atlas.levels[band].sizePx, kMaskTile);
    count += groups.x * groups.y;
  }
  return count;
}

gl::ShaderDefines definesOf(const Options& options) {
  if (options.values == Values::Relative) return {{"VALUES_RELATIVE", "1"}};
  switch (options.display.colours.eotf) {
    case Eotf::Srgb:
      return {{"EOTF_SRGB", "1"}};
    case Eotf::Power:
      return {{"EOTF_POWER", "1"}};
    case Eotf::Pq:
      return {{"EOTF_PQ", "1"}};
    case Eotf::Linear:
      return {{"EOTF_LINEAR", "1"}};
    case Eotf::Hlg:
      return {{"EOTF_HLG", "1"}};
  }
  return {};
}

/// Span and floor of the light, limits of curves that clip, exposure and exponent.
void setDisplay(const gl::Program& program, const Options& options) {
  const Display& display = options.display;
  const double reflected = display.reflectedCdM2();
  double least = 0.005, floor = display.blackCdM2 + reflected;
  if (options.values == Values::Coded && display.colours.eotf == Eotf::Linear)
    least = std::max(0.005, display.blackCdM2), floor = reflected;
  program.set("opponentOfLight", glm::mat3(display.colours.dklOfRgb()));
  program.set("levels", glm::vec4(display.peakCdM2 - display.blackCdM2, floor, least, display.peakCdM2));
  program.set("curve",
              glm::vec2(display.exposure,
                        display.colours.eotf == Eotf::Hlg ? display.hlgGamma() : display.colours.exponent));
}

const Options& checked(glm::ivec2 sizePx, const Options& options, bool video) {
  check({sizePx.x, sizePx.y, video ? 2 : 1, {}, {}}, options);
  return options;
}

}  // namespace

/// As the uniform block lays it out.
struct ColorVideoVdpGpu::Constants {
  glm::ivec4 place[kCvvdpMostBands], groups[kCvvdpMostBands];
  glm::vec4 crossMasking[4], maskerExponent, blurTaps[2], mapWeight[2], sensitivityGrid, limits, masking,
      maskerOffset;
  glm::ivec4 counts;
};

ColorVideoVdpGpu::ColorVideoVdpGpu(gl::Context& context, glm::ivec2 sizePx, const Options& options,
                                   bool video)
    : context_(context),
      sizePx_(sizePx),
      options_(checked(sizePx, options, video)),
      frequencies_(bandFrequenciesCpd(sizePx.x, sizePx.y, options.display.pixelsPerDegree)),
      atlas_(sizePx, frequencies_.size()),
      taps_(video ? temporalTaps(options.framesPerSecond) : 0),
      displayDefines_(definesOf(options)),
      pyramid_(Format::RGBA32F, atlas_.sizePx, 1, 2),
      mutual_(Format::RGBA32F, atlas_.sizePx),
      change_(Format::RGBA32F, atlas_.sizePx),
      map_(Format::R32F, options.map ? atlas_.sizePx : glm::ivec2(1)),
      ringFirst_(Format::RGBA32F, video ? sizePx : glm::ivec2(1), 1, std::max(taps_, 1)),
      ringSecond_(Format::RG32F, video ? sizePx : glm::ivec2(1), 1, std::max(taps_, 1)),
      constants_(sizeof(Constants), nullptr),
      sensitivities_(sensitivityTable(frequencies_)),
      sums_(int64_t{maskGroupCount(atlas_)} * int64_t{sizeof(glm::vec4)}, nullptr),
      results_(int64_t{kResultFrames} * static_cast<int64_t>(frequencies_.size() * sizeof(glm::vec4)),
               nullptr),
      weights_(int64_t{2} * taps_ * taps_ * int64_t{sizeof(glm::vec4)}, nullptr) {
  assert(frequencies_.size() <= kCvvdpMostBands);
  if (options.map) mapDefines_["WITH_MAP"] = "1";
  Constants constants{};
  int contrast = 0, mask = 0;
  const auto bands = static_cast<int>(frequencies_.size());
  for (int band = 0; band < bands; ++band) {
    const Atlas::Level& level = atlas_.levels[static_cast<size_t>(band)];
    constants.place[band] = {level.origin, level.sizePx};
    if (band + 1 == bands) break;
    const glm::ivec2 forContrast =
        groupsOver(atlas_.levels[static_cast<size_t>(band) + 1].sizePx, kContrastGroup);
    const glm::ivec2 forMask = groupsOver(level.sizePx, kMaskTile);
    constants.groups[band] = {contrast, forContrast.x, mask, forMask.x};
    contrast += forContrast.x * forContrast.y;
    mask += forMask.x * forMask.y;
  }
  contrastGroups_ = inTwoDimensions(contrast);
  maskGroups_ = inTwoDimensions(mask);
  const Parameters& p = parameters();
  Channels offsets{}, masked{}, base{};
  for (size_t c = 0; c < kChannels; ++c) {
    constants.crossMasking[c] = toVec4(p.crossMasking[c]);
    offsets[c] = std::pow(p.powerOffset, p.maskerExponent[c]);
    masked[c] = p.channelWeight[c] * (video ? 1.0 : p.imageFactor);
    base[c] = masked[c] * p.baseBandWeight[c];
  }
  constants.maskerExponent = toVec4(p.maskerExponent);
  double taps[kCvvdpBlurRadius + 1], sum = 0.0;
  assert(p.blurRadius == kCvvdpBlurRadius);
  for (int i = 0; i <= kCvvdpBlurRadius; ++i) {
    taps[i] = std::exp(-i * i / (2.0 * p.blurSigma * p.blurSigma));
    sum += i == 0 ? taps[i] : 2.0 * taps[i];
  }
  for (int i = 0; i <= kCvvdpBlurRadius; ++i)
    constants.blurTaps[i / 4][i % 4] = static_cast<float>(taps[i] / sum);
  constants.mapWeight[0] = toVec4(masked);
  constants.mapWeight[1] = toVec4(base);
  const double first = Sensitivity::firstLogBackground(), last = Sensitivity::lastLogBackground();
  constants.sensitivityGrid = toVec4(
      {first * std::log2(10.0), (kSensitivityLevels - 1) / ((last - first) * std::log2(10.0)), 0.0, 0.0});
  constants.limits =
      toVec4({p.leastBackground, p.largestContrast, p.powerOffset, std::pow(p.powerOffset, p.maskExponent)});
  constants.masking = toVec4({p.maskExponent, p.maskScale, p.largestDifference, 0.0});
  constants.maskerOffset = toVec4(offsets);
  constants.counts = {bands, contrast, mask, 0};
  constants_.write(0, sizeof(Constants), &constants);
  begin(video ? 2 : 1);
}

const gl::Program& ColorVideoVdpGpu::program(const char* name, const gl::ShaderDefines& extra) const {
  return context_.programs().compute(kFolder + name + ".comp.glsl", extra);
}

void ColorVideoVdpGpu::begin(int frames) {
  frames_ = frames;
  pushed_ = evaluated_ = unread_ = 0;
  differences_.clear();
  if (isVideo()) makeWeights();
}

/// Weights of the stored frames: a row for each of the first frames, then one for each position in the ring.
void ColorVideoVdpGpu::makeWeights() {
  std::vector<std::vector<double>> filters;
  for (int c = 0; c < kChannels; ++c) filters.push_back(temporalFilter(c, options_.framesPerSecond));
  std::vector<glm::vec4> rows(static_cast<size_t>(2 * taps_ * taps_), glm::vec4(0.0F));
  for (int row = 0; row < 2 * taps_; ++row)
    for (int tap = 0; tap < taps_; ++tap) {
      const bool starting = row < taps_ && row - tap < 0;
      const int frame = starting ? paddedFrame(row - tap, frames_, options_.padding) : row - tap;
      glm::vec4& weight = rows[static_cast<size_t>(row * taps_ + frame % taps_)];
      for (int c = 0; c < kChannels; ++c)
        weight[c] += static_cast<float>(filters[static_cast<size_t>(c)][static_cast<size_t>(tap)]);
    }
  weights_.write(0, weights_.bytes(), rows.data());
}

void ColorVideoVdpGpu::read(const gl::Texture* test, const gl::Texture* reference, int frame, int stored) {
  gl::ShaderDefines defines = displayDefines_;
  if (isVideo()) defines["VIDEO"] = "1";
  if (test) defines["PUSH"] = "1";
  if (frame >= 0) defines["FILTER"] = "1";
  const gl::Program& light = program("light", defines);
  if (test) {
    assert(test->sizePx() == sizePx_ && reference->sizePx() == sizePx_);
    test->bindTexture(kCvvdpLightTestUnit);
    reference->bindTexture(kCvvdpLightReferenceUnit);
    light.set("grey", gl::channelCount(test->format()) < 3 ? 1 : 0);
    setDisplay(light, options_);
  }
  pyramid_.bindImage(kCvvdpLightPyramidImage, Access::Write);
  if (isVideo()) {
    ringFirst_.bindImage(kCvvdpLightRingFirstImage, Access::Write);
    ringSecond_.bindImage(kCvvdpLightRingSecondImage, Access::Write);
    ringFirst_.bindTexture(kCvvdpLightRingFirstUnit);
    ringSecond_.bindTexture(kCvvdpLightRingSecondUnit);
    weights_.bindStorage(kCvvdpWeightsBuffer);
    light.set("slot", test ? pushed_ % taps_ : -1);
    light.set("slots", std::min(stored, taps_));
    light.set("weightRow", taps_ * (frame < taps_ ? std::max(frame, 0) : taps_ + frame % taps_));
  }
  light.set("sizePx", sizePx_);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  light.dispatch(sizePx_, kLightGroup);
}

void ColorVideoVdpGpu::add(const gl::Texture& test, const gl::Texture& reference, gl::PassList* passes) {
  assert((gl::channelCount(test.format()) < 3) == (gl::channelCount(reference.format()) < 3));
  // In a mirror the first frames come from later ones.
  const bool ahead = isVideo() && options_.padding == TemporalPadding::Symmetric;
  const int needed = ahead ? std::min(frames_, taps_) : 1;
  const bool waits = pushed_ + 1 < needed;
  const bool filters = !waits && evaluated_ == pushed_;
  {
    const auto pass = openPass(passes, "color_video_vdp/light");
    read(&test, &reference, filters ? evaluated_ : -1, pushed_ + 1);
  }
  ++pushed_;
  if (waits) return;
  if (filters) evaluateFrame(passes);
  while (evaluated_ < pushed_) {
    read(nullptr, nullptr, evaluated_, pushed_);
    evaluateFrame(passes);
  }
}

void ColorVideoVdpGpu::evaluateFrame(gl::PassList* passes) {
  const auto bands = static_cast<int>(frequencies_.size());
  constants_.bindUniform(kCvvdpLevelsBlock);
  sensitivities_.bindStorage(kCvvdpSensitivityBuffer);
  sums_.bindStorage(kCvvdpSumsBuffer);
  results_.bindStorage(kCvvdpResultsBuffer);
  {
    const auto pass = openPass(passes, "color_video_vdp/pyramid");
    const gl::Program& reduce = program("reduce");
    reduce.set("referenceBorders", options_.referenceBorders ? 1 : 0);
    reduce.use();
    pyramid_.bindTexture(kCvvdpReducePyramidUnit);
    pyramid_.bindImage(kCvvdpReducePyramidImage, Access::Write);
    for (int level = 1; level < bands; ++level) {
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
      reduce.set("level", level);
      const glm::ivec2 groups =
          groupsOver(atlas_.levels[static_cast<size_t>(level)].sizePx, glm::ivec2(kCvvdpReduceGroup));
      glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y), 2);
    }
  }
  {
    const auto pass = openPass(passes, "color_video_vdp/contrast");
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    pyramid_.bindTexture(kCvvdpContrastPyramidUnit);
    mutual_.bindImage(kCvvdpContrastMutualImage, Access::Write);
    change_.bindImage(kCvvdpContrastChangeImage, Access::Write);
    program("contrast").dispatch(contrastGroups_, {1, 1});
  }
  {
    const auto pass = openPass(passes, "color_video_vdp/mask");
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    mutual_.bindTexture(kCvvdpMaskMutualUnit);
    change_.bindTexture(kCvvdpMaskChangeUnit);
    map_.bindImage(kCvvdpMaskMapImage, Access::Write);
    program("mask", mapDefines_).dispatch(maskGroups_, {1, 1});
  }
  {
    const auto pass = openPass(passes, "color_video_vdp/finish");
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    pyramid_.bindTexture(kCvvdpFinishPyramidUnit);
    map_.bindImage(kCvvdpFinishMapImage, Access::Write);
    const gl::Program& finishing = program("finish", mapDefines_);
    finishing.set("resultRow", unread_ * bands);
    finishing.dispatch({bands, 1}, {1, 1});
  }
  if (options_.map) {
    const auto pass = openPass(passes, "color_video_vdp/map");
    const Parameters& p = parameters();
    const gl::Program& collapse = program("collapse");
    collapse.set("jod", toVec4({p.jodFactor, p.jodExponent, p.linearBelow,
                                p.jodFactor * std::pow(p.linearBelow, p.jodExponent - 1.0)}));
    map_.bindTexture(kCvvdpCollapseMapUnit);
    map_.bindImage(kCvvdpCollapseMapImage, Access::Write);
    for (int level = bands - 2; level >= 0; --level) {
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
      collapse.set("level", level);
      collapse.dispatch(atlas_.levels[static_cast<size_t>(level)].sizePx);
    }
  }
  ++unread_;
  const int frame = evaluated_++;
  if (unread_ == kResultFrames) flush();
  if (onFrame) onFrame(frame);
}

void ColorVideoVdpGpu::flush() {
  if (unread_ == 0) return;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const size_t bands = frequencies_.size();
  const std::vector<glm::vec4> means =
      results_.read<glm::vec4>(0, static_cast<int64_t>(unread_) * static_cast<int64_t>(bands));
  for (size_t frame = 0; frame < static_cast<size_t>(unread_); ++frame) {
    FrameDifferences& out = differences_.emplace_back();
    for (size_t band = 0; band < bands; ++band) {
      Channels& pooled = out.emplace_back();
      for (int c = 0; c < kChannels; ++c)
        pooled[static_cast<size_t>(c)] =
            offsetPower(means[frame * bands + band][c], 1.0 / parameters().pixelExponent);
    }
  }
  unread_ = 0;
}

const std::vector<FrameDifferences>& ColorVideoVdpGpu::frames() {
  flush();
  return differences_;
}

Score ColorVideoVdpGpu::finish() {
  flush();
  return pool(std::move(differences_), frequencies_, isVideo());
}

Image ColorVideoVdpGpu::readMap() const {
  assert(options_.map);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  const Image atlas = map_.read();
  Image out(sizePx_.x, sizePx_.y, 1);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) out.at(x, y) = atlas.at(x, y);
  return out;
}

int64_t ColorVideoVdpGpu::bytesHeld() const {
  int64_t bytes = 0;
  for (const gl::Texture* texture : {&pyramid_, &mutual_, &change_, &map_, &ringFirst_, &ringSecond_})
    bytes += texture->bytes();
  for (const gl::Buffer* buffer : {&constants_, &sensitivities_, &sums_, &results_, &weights_})
    bytes += buffer->bytes();
  return bytes;
}

gl::Texture uploadFrame(const Image& image) {
  const bool grey = image.channels < 3;
  gl::Texture texture(grey ? Format::R32F : Format::RGBA32F, {image.width, image.height});
  if (image.channels != 3) {
    texture.write(image);
    return texture;
  }
  Image padded(image.width, image.height, 4, 1.0F);
  for (size_t pixel = 0; pixel < image.pixels(); ++pixel)
    std::copy_n(image.data.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3,
                padded.data.begin() + static_cast<std::ptrdiff_t>(4 * pixel));
  texture.write(padded);
  return texture;
}

Score evaluateOnGpu(gl::Context& context, const Pair& pair, const Options& options,
                    const std::function<void(int, const Image&)>& visitMap) {
  check(pair, options);
  ColorVideoVdpGpu metric(context, {pair.width, pair.height}, options, pair.frames > 1);
  metric.begin(pair.frames);
  if (visitMap && options.map) metric.onFrame = [&](int frame) { visitMap(frame, metric.readMap()); };
  for (int frame = 0; frame < pair.frames; ++frame) {
    const Image test = pair.test(frame), reference = pair.reference(frame);
    for (const Image* image : {&test, &reference})
      if (image->width != pair.width || image->height != pair.height || image->channels != test.channels)
        throw Error("the frames of a pair of videos differ in size or channels", {},
                    "all frames of both must have one size and 1, 3 or 4 channels");
    metric.add(uploadFrame(test), uploadFrame(reference));
  }
  return metric.finish();
}

}  // namespace limen::perception::cvvdp
