// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/visibility_technique.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/receivers_from.h"

namespace limen::techniques {
namespace {

/// `counts` and `search` as store() in shadow_lookup.glsl writes them.
std::vector<Counter> summarise(const std::vector<uint32_t>& counts, const std::vector<uint32_t>& search) {
  std::array<double, ClassCount> pixels{};
  double occluders = 0.0, occludersSquared = 0.0, fetches = 0.0, allFetches = 0.0, levels = 0.0;
  double areaTexels = 0.0, examined = 0.0, used = 0.0;
  for (size_t i = 0; i < counts.size(); i += 4) {
    pixels.at(counts[i]) += 1.0;
    allFetches += counts[i + 2];
    if (counts[i] != Processed) continue;
    occluders += counts[i + 1];
    occludersSquared += double(counts[i + 1]) * counts[i + 1];
    fetches += counts[i + 2];
    levels += std::bit_cast<float>(search[i + 3]);
    areaTexels += search[i];
    examined += search[i + 1];
    used += search[i + 2];
  }
  const double all = static_cast<double>(counts.size()) / 4.0;
  if (pixels[CutShort] > 0.0)
    throw Error(shortestNumber(pixels[CutShort]) +
                    " pixels need more loop iterations than this software renderer grants",
                {}, "set 'budget', lower 'resolution', or run on a GPU");
  const double processed = pixels[Processed], receivers = all - pixels[NotReceiver];
  const auto share = [&](double part) { return all > 0.0 ? part / all : 0.0; };
  const auto perProcessed = [&](double sum) { return processed > 0.0 ? sum / processed : 0.0; };
  const double mean = perProcessed(occluders);
  const double variance = perProcessed(occludersSquared) - mean * mean;
  return {{"fetches_per_receiver", receivers > 0.0 ? allFetches / receivers : 0.0},
          {"fetches_per_px", perProcessed(fetches)},
          {"micro_occluders_per_px", mean},
          {"micro_occluders_sd", std::sqrt(std::max(variance, 0.0))},
          {"search_area_texels", perProcessed(areaTexels)},
          {"wasted_share", examined > 0.0 ? 1.0 - used / examined : 0.0},
          {"level_mean", perProcessed(levels)},
          {"receivers_share", share(receivers)},
          {"lit_share", share(pixels[Lit])},
          {"umbra_share", share(pixels[Umbra])},
          {"processed_share", share(processed)},
          {"outside_map_share", share(pixels[Outside])}};
}

const gl::Texture& receiversOf(frame::Frame& frame, glm::dvec2 eye) {
  return eye == glm::dvec2(0.5) ? frame.get<frame::Receivers>().texture()
                                : frame.get<frame::ReceiversFrom>(frame::EyeSetting{eye}).texture();
}

}  // namespace

VisibilityTechnique::VisibilityTechnique(const MapSettings& map, const SlopeBias& bias, std::string shader,
                                         std::string pass, gl::ShaderDefines defines)
    : maps_{{map.resolution, map.raster}},
      bias_(bias.constant),
      slopeBias_(bias.slope),
      maxSlope_(bias.maxSlope),
      shader_(std::move(shader)),
      pass_(std::move(pass)),
      defines_(std::move(defines)) {}

void VisibilityTechnique::prepare(frame::Frame& frame) {
  visibility_.emplace(gl::Format::R32F, frame.sizePx());
  preparePasses(frame);
}

void VisibilityTechnique::preparePasses(frame::Frame& frame) {
  program_ = &program(frame, false);
  frame.passes().setBytesHeld(pass_, visibility_->bytes());
}

const gl::Program& VisibilityTechnique::program(frame::Frame& frame, bool counting,
                                                const gl::ShaderDefines& more) const {
  gl::ShaderDefines defines = defines_;
  defines.insert(more.begin(), more.end());
  if (counting) defines["COUNT"] = "1";
  return frame.context().programs().compute(shader_, defines);
}

const frame::LightFrustum& VisibilityTechnique::bindMap(frame::Frame& frame) {
  const auto& map = frame.get<frame::ShadowMap>(mapSettings());
  map.texture().bindTexture(1);
  return map.frustum();
}

const frame::LightFrustum& VisibilityTechnique::bindPyramid(frame::Frame& frame) {
  const auto& pyramid = frame.get<frame::MinMaxPyramid>(mapSettings());
  pyramid.minimum().bindTexture(1);
  pyramid.maximum().bindTexture(2);
  pyramidLevels_ = pyramid.levels();
  return pyramid.frustum();
}

int VisibilityTechnique::maxIterations(frame::Frame& frame) {
  return frame.context().device().software ? 60000 : 0x7fffffff;
}

void VisibilityTechnique::bindPass(frame::Frame& frame, const gl::Program& program,
                                   const CountImages* counts) {
  const frame::LightFrustum& frustum = bindMap(frame);
  const glm::dvec2 lightSize = frame.scene().lights[0].size, eye = mapSettings().eye;
  program.set("sizePx", frame.sizePx());
  program.set("tangentLow", glm::vec2(frustum.low));
  program.set("tangentSize", glm::vec2(frustum.high - frustum.low));
  program.set("near", static_cast<float>(frustum.near));
  program.set("lightSize", glm::vec2(lightSize));
  program.set("eyeOnLight", glm::vec2(eye));
  program.set("resolution", mapSettings().resolution);
  program.set("bias", static_cast<float>(bias_));
  program.set("slopeBias", static_cast<float>(slopeBias_));
  program.set("maxSlope", static_cast<float>(maxSlope_));
  configure(program);
  receiversOf(frame, eye).bindTexture(0);
  visibility_->bindImage(0, gl::Access::Write);
  if (!counts) return;
  counts->work.bindImage(1, gl::Access::ReadWrite);
  counts->search.bindImage(2, gl::Access::Write);
}

void VisibilityTechnique::runPasses(frame::Frame& frame, const CountImages* counts) {
  const auto scope = frame.passes().open(pass_);
  const gl::Program& chosen = counts ? program(frame, true) : *program_;
  for (current_ = 0; current_ < maps_.size(); ++current_) {
    if (!readsMap(frame, current_)) continue;
    bindPass(frame, chosen, counts);
    chosen.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    if (counts) addCounts(*counts);
  }
  current_ = 0;
}

void VisibilityTechnique::run(frame::Frame& frame, const CountImages* counts) {
  makeInputs(frame);
  for (current_ = 0; current_ < maps_.size(); ++current_)
    if (readsMap(frame, current_)) {
      bindMap(frame);
      receiversOf(frame, mapSettings().eye);
    }
  current_ = 0;
  runPasses(frame, counts);
  finish(frame);
}

std::vector<Quantity> VisibilityTechnique::quantities() {
  constexpr Direction kLower = Direction::LowerIsBetter, kNeither = Direction::Neither;
  return {{"fetches_per_receiver", "Texels read per receiver", "1/px", kLower},
          {"fetches_per_px", "Texels read per processed pixel", "1/px", kLower},
          {"micro_occluders_per_px", "Micro-occluders per pixel", "1/px", kLower},
          {"micro_occluders_sd", "Standard deviation of micro-occluders", "1/px", kNeither},
          {"search_area_texels", "Search area", "texel", kLower},
          {"wasted_share", "Share of micro-occluders that cover nothing", "", kNeither},
          {"level_mean", "Mean level", "", kNeither},
          {"receivers_share", "Share of receivers", "", kNeither},
          {"lit_share", "Share of lit pixels", "", kNeither},
          {"umbra_share", "Share of pixels in umbra", "", kNeither},
          {"processed_share", "Share of processed pixels", "", kNeither},
          {"outside_map_share", "Share of pixels outside the map", "", kNeither}};
}

void VisibilityTechnique::render(frame::Frame& frame) { run(frame, nullptr); }

void VisibilityTechnique::addCounts(const CountImages& counts) {
  std::vector<uint32_t> work = counts.work.readUint(), search = counts.search.readUint();
  if (counted_.work.empty()) {
    counted_.work = std::move(work);
    counted_.search = std::move(search);
    return;
  }
  // A pixel is what the map that had the most to do made of it; later maps need not see everything.
  const auto rank = [](uint32_t kind) {
    constexpr std::array<int, ClassCount> kRank = {0, 1, 3, 4, 2, 5};
    return kRank.at(kind);
  };
  for (size_t i = 0; i < work.size(); i += 4) {
    const uint32_t kind = work[i] == Outside ? uint32_t{Lit} : work[i];
    if (rank(kind) > rank(counted_.work[i])) counted_.work[i] = kind;
    for (size_t channel = 1; channel < 3; ++channel) counted_.work[i + channel] += work[i + channel];
    counted_.work[i + 3] = std::max(counted_.work[i + 3], work[i + 3]);
    for (size_t channel = 0; channel < 3; ++channel) counted_.search[i + channel] += search[i + channel];
  }
}

std::vector<Counter> VisibilityTechnique::count(frame::Frame& frame) {
  const CountImages counts{gl::Texture(gl::Format::RGBA32UI, frame.sizePx()),
                           gl::Texture(gl::Format::RGBA32UI, frame.sizePx())};
  counted_ = {frame.sizePx(), {}, {}};
  frame.begin();
  run(frame, &counts);
  frame.end();
  return summarise(counted_.work, counted_.search);
}

}  // namespace limen::techniques
