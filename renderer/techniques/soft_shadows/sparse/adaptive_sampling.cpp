// SPDX-License-Identifier: BSD-3-Clause
#include <epoxy/gl.h>

#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/gl/buffer.h"
#include "renderer/techniques/soft_shadows/inner_technique.h"
#include "renderer/techniques/soft_shadows/sparse/sampling.h"
#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char *kChoose = "sparse/choose", *kPull = "sparse/pull", *kPush = "sparse/push";
constexpr const char* kSparseFolder = "renderer/techniques/soft_shadows/sparse/";
constexpr int kTile = 8;  // pixels per side of a work group

const gl::Program& shader(gl::Context& context, const std::string& name,
                          const gl::ShaderDefines& defines = {}) {
  return context.programs().compute(kSparseFolder + name, defines);
}

glm::ivec2 wholeTiles(glm::ivec2 sizePx) { return (sizePx + kTile - 1) / kTile * kTile; }

/// Finest level of the pyramid: half the picture, rounded up so that every level is half the previous one.
glm::ivec2 pyramidBase(glm::ivec2 sizePx, int levels) {
  const int block = 1 << levels;
  return (sizePx + block - 1) / block * (block / 2);
}

class AdaptiveSampling : public SparseSampling {
 public:
  AdaptiveSampling(frame::Frame& frame, const AdaptiveSamplingSettings& settings, double depthTolerance,
                   const ChosenEntry& inner)
      : reconstruction_(depthTolerance),
        minSamples_(settings.minSamples),
        bias_(innerBias(inner)),
        coarsest_(settings.coarsestLevel),
        // One level more than is skipped: squares without a sample find one in those around them.
        levels_(coarsest_ + 1),
        map_(innerMap(inner)),
        points_(frame, "sparse/inner", wholeTiles(frame.sizePx())),
        choose_(shader(frame.context(), "choose.comp.glsl")),
        pullFirst_(shader(frame.context(), "pull.comp.glsl", {{"FIRST", "1"}})),
        pull_(shader(frame.context(), "pull.comp.glsl")),
        push_(shader(frame.context(), "push.comp.glsl")),
        ids_(gl::Format::R32UI, points_.sizePx()),
        places_(gl::Format::RG32F, points_.sizePx()),
        slots_(gl::Format::R32UI, frame.sizePx()),
        pulledPoints_(gl::Format::RGBA32F, pyramidBase(frame.sizePx(), levels_), levels_),
        pulledWeights_(gl::Format::R32F, pulledPoints_.sizePx(), levels_),
        listed_(int64_t{4}, nullptr) {
    frame.passes().setBytesHeld(kChoose, ids_.bytes() + places_.bytes() + slots_.bytes() + listed_.bytes());
    frame.passes().setBytesHeld(kPull, pulledPoints_.bytes() + pulledWeights_.bytes());
    points_.setSeen({&ids_, &places_, frame.sizePx()});
  }

  frame::Frame& points() override { return points_; }

  void choose(frame::Frame& frame) override {
    const auto& pyramid = points_.get<frame::MinMaxPyramid>(map_);
    const frame::LightFrustum& frustum = pyramid.frustum();
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    const SurfaceChannels picture = SurfaceChannels::of(frame);
    const auto scope = frame.passes().open(kChoose);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    ids_.clearUint(glm::uvec4(frame::TriangleIds::kNone));
    listed_.clearUint(0);
    reconstruction_.configure(frame, choose_);
    choose_.set("tilesPerRow", points_.sizePx().x / kTile);
    choose_.set("pixelsPerUnit", static_cast<float>(frame.sizePx().y / (2.0 * frame.tanHalfFov())));
    choose_.set("tangentLow", glm::vec2(frustum.low));
    choose_.set("tangentSize", glm::vec2(frustum.high - frustum.low));
    choose_.set("lightSize", glm::vec2(frame.scene().lights[0].size));
    choose_.set("near", static_cast<float>(frustum.near));
    choose_.set("bias", static_cast<float>(bias_.constant));
    choose_.set("slopeBias", static_cast<float>(bias_.slope));
    choose_.set("maxSlope", static_cast<float>(bias_.maxSlope));
    choose_.set("resolution", map_.resolution);
    choose_.set("mapLevels", pyramid.levels());
    choose_.set("minSamples", static_cast<float>(minSamples_));
    choose_.set("coarsest", coarsest_);
    picture.bind(kSparseReceiversUnit);
    ids.bindTexture(kSparseChooseIdsUnit);
    pyramid.minimum().bindTexture(kSparseChooseMinimumMapUnit);
    ids_.bindImage(kSparseChooseIdsImage, gl::Access::Write);
    places_.bindImage(kSparseChoosePlacesImage, gl::Access::Write);
    slots_.bindImage(kSparseChooseSlotsImage, gl::Access::Write);
    listed_.bindStorage(kSparseChooseCountsBuffer);
    choose_.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  void reconstruct(frame::Frame& frame, const gl::Texture& sampled, const gl::Texture& visibility,
                   const gl::Texture* classes) override {
    pull(frame, sampled);
    const gl::Program& program =
        classes ? shader(frame.context(), "push.comp.glsl", {{"COUNT", "1"}}) : push_;
    const SurfaceChannels picture = SurfaceChannels::of(frame);
    const auto scope = frame.passes().open(kPush);
    reconstruction_.configure(frame, program);
    program.set("pulledLevels", levels_);
    picture.bind(kSparseReceiversUnit);
    slots_.bindTexture(kSparsePushSlotsUnit);
    sampled.bindTexture(kSparsePushSampledVisibilityUnit);
    pulledPoints_.bindTexture(kSparsePushPulledPointsUnit);
    pulledWeights_.bindTexture(kSparsePushPulledWeightsUnit);
    visibility.bindImage(kSparseReconstructVisibilityImage, gl::Access::Write);
    if (classes) classes->bindImage(kSparseReconstructClassImage, gl::Access::Write);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

 private:
  void pull(frame::Frame& frame, const gl::Texture& sampled) {
    const SurfaceChannels picture = SurfaceChannels::of(frame);
    const auto scope = frame.passes().open(kPull);
    for (int level = 0; level < levels_; ++level) {
      const gl::Program& program = level == 0 ? pullFirst_ : pull_;
      reconstruction_.configure(frame, program);
      const glm::ivec2 sizePx(pulledPoints_.sizePx().x >> level, pulledPoints_.sizePx().y >> level);
      program.set("pictureSizePx", frame.sizePx());
      program.set("sizePx", sizePx);
      program.set("finerSizePx", level == 0 ? frame.sizePx() : 2 * sizePx);
      if (level == 0) {
        slots_.bindTexture(kSparsePullSlotsUnit);
        picture.depths->bindTexture(kSparsePullDepthsUnit);
        sampled.bindTexture(kSparsePullSampledVisibilityUnit);
      } else {
        pulledPoints_.bindTexture(kSparsePullFinerPointsUnit);
        pulledWeights_.bindTexture(kSparsePullFinerWeightsUnit);
        program.set("finerLevel", level - 1);
      }
      picture.normals->bindTexture(kSparsePullNormalsUnit);
      pulledPoints_.bindImage(kSparsePullPointsImage, gl::Access::Write, level);
      pulledWeights_.bindImage(kSparsePullWeightsImage, gl::Access::Write, level);
      program.dispatch(sizePx);
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
  }

  Reconstruction reconstruction_;
  double minSamples_;
  SlopeBias bias_;
  int coarsest_, levels_;
  frame::ShadowMapSettings map_;
  frame::Frame points_;
  const gl::Program &choose_, &pullFirst_, &pull_, &push_;
  gl::Texture ids_, places_, slots_, pulledPoints_, pulledWeights_;
  gl::Buffer listed_;
};

}  // namespace

const SettingsTable<AdaptiveSamplingSettings>& AdaptiveSamplingSettings::table() {
  using S = AdaptiveSamplingSettings;
  static const std::string kSource = "Schwarz 2009, section 5.1.3 (value not given there)";
  static const SettingsTable<S> kTable = {
      Binding(&S::minSamples, "min_samples", Range{1, 256}, "samples",
              "Samples that a penumbra's screen width must hold before pixels are skipped (s_min)", kSource)
          .formerly({"min_samples"}),
      Binding(&S::coarsestLevel, "coarsest_level", Range{0, 5}, "",
              "Samples are at most 2 to this power pixels apart", kSource)
          .formerly({"coarsest_level"})};
  return kTable;
}

std::unique_ptr<SparseSampling> makeSampling(frame::Frame& frame, const AdaptiveSamplingSettings& settings,
                                             double depthTolerance, const ChosenEntry& inner) {
  return std::make_unique<AdaptiveSampling>(frame, settings, depthTolerance, inner);
}

}  // namespace limen::techniques
