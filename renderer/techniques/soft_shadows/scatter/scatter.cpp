// SPDX-License-Identifier: BSD-3-Clause
// Soft shadow maps by scattering (SS-06): a loop over the texels of a map of casters, each of which adds the
// share of the light that it hides to the receivers within its reach, in a map of the receivers that is then
// projected onto the scene. Casters receive no shadows. Source: Schwarz 2009, section 3.2.1 (after Atty et
// al. 2006).
//
// 'front_and_back' takes the larger of what the nearest front faces and the farthest back faces hide: the
// heuristic that the thesis shows to be wrong (Fig. 4.3 d); 'nearest_and_farthest' does the same for surfaces
// of either orientation, for example two flat blockers (Fig. 4.3 e). Shares are added as integers, so that
// the sum does not depend on the order.
#include <epoxy/gl.h>

#include <array>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/common_counters.h"
#include "renderer/techniques/soft_shadows/scatter/light_layers.h"
#include "renderer/techniques/soft_shadows/scatter/scatter_bindings.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

constexpr const char *kScatterPass = "soft_shadows/scatter", *kScatterRaster = "soft_shadows/scatter_layers",
                     *kScatterLookup = "soft_shadows/scatter_lookup";
/// The whole light in fixed point: 2^22 parts leave room for 1,024 layers that hide all of it, and a texel
/// that hides a thousandth of the light is still known to 1 in 8,000.
constexpr const char* kWhole = "4194304.0";

std::vector<uint32_t> receiverBits(const scene::Scene& scene) {
  std::vector<uint32_t> bits((scene.mesh.triangles.size() + 31) / 32, 0U);
  for (const scene::Part& part : scene.parts)
    if (part.receiverOnly)
      for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i)
        bits[i / 32] |= 1U << (i % 32);
  return bits;
}

/// Which surfaces of the casters scatter.
enum class Layering { Nearest, FrontAndBack, NearestAndFarthest };
constexpr EnumNames<Layering, 3> enumNames(Layering) {
  return {{{{Layering::Nearest, "nearest"},
            {Layering::FrontAndBack, "front_and_back"},
            {Layering::NearestAndFarthest, "nearest_and_farthest"}}}};
}

struct ScatterSettings {
  int resolution = 512, softResolution = 512;
  Layering layers = Layering::Nearest;
  double bias = 1e-4;
  static const SettingsTable<ScatterSettings>& table() {
    using S = ScatterSettings;
    static const OneOf kSides = oneOf({1, 2, 64, 128, 256, 512, 1024, 2048});
    static const SettingsTable<S> kTable = {
        {&S::resolution, "resolution", kSides, "texel", "Side of the map of casters",
         "Schwarz 2009, section 3.2.1"},
        {&S::softResolution, "soft_resolution", kSides, "texel", "Side of the soft shadow map"},
        {&S::layers, "layers",
         "Surfaces that scatter: the nearest; or the larger of what the nearest front and the farthest back "
         "faces hide; or of the nearest and the farthest of either orientation",
         "Schwarz 2009, section 4.2.2 (Fig. 4.3)"},
        {&S::bias,
         "bias",
         {0, 0.1},
         "",
         "Constant depth bias as a share of the receiver's distance from the light's plane",
         "Schwarz 2009, section 4.4.5 (value not given there)"}};
    return kTable;
  }
};

class Scatter : public Technique {
 public:
  using Settings = ScatterSettings;
  explicit Scatter(const ScatterSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    layers_.emplace(frame, settings_.resolution, settings_.softResolution, withSecond());
    scatter_ = &scatterProgram(frame, false);
    lookup_ = &lookupProgram(frame, false);
    for (std::optional<gl::Texture>& each : hidden_)
      each.emplace(gl::Format::R32UI, glm::ivec2(settings_.softResolution));
    costs_.emplace(int64_t{sizeof(ScatterCosts)}, nullptr);
    receiverBits_.emplace(receiverBits(frame.scene()));
    triangleCount_ = static_cast<uint32_t>(frame.scene().mesh.triangles.size());
    visibility_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld(kScatterRaster, layers_->bytes());
    frame.passes().setBytesHeld(kScatterPass, hidden_[0]->bytes() + hidden_[1]->bytes() + costs_->bytes());
    frame.passes().setBytesHeld(kScatterLookup, visibility_->bytes() + receiverBits_->bytes());
  }

  void render(frame::Frame& frame) override { run(frame, *scatter_, *lookup_, nullptr); }

  const gl::Texture& product() const override { return *visibility_; }

  static std::vector<Quantity> counters() {
    std::vector<Quantity> all = {
        {"caster_texels", "Texels that scatter", "", Direction::LowerIsBetter},
        {"splats_per_caster_texel", "Splats per scattering texel", "1/texel", Direction::LowerIsBetter},
        {"splats_per_receiver", "Splats per receiver", "1/px", Direction::LowerIsBetter}};
    for (Quantity& share : pixelShares()) all.push_back(std::move(share));
    all.push_back({"without_answer_share", "Share of pixels not covered by the soft shadow map", "",
                   Direction::Neither});
    return all;
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    const gl::Texture classes(gl::Format::R32UI, frame.sizePx());
    frame.begin();
    run(frame, scatterProgram(frame, true), lookupProgram(frame, true), &classes);
    frame.end();
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    const ScatterCosts costs = costs_->read<ScatterCosts>().front();
    std::array<double, ClassCount> pixels{};
    const std::vector<uint32_t> classOf = classes.readUint();
    for (const uint32_t each : classOf) pixels.at(each) += 1.0;
    if (costs.cutShort > 0)
      throw Error(std::to_string(costs.cutShort) +
                      " caster texels need more loop iterations than this software renderer allows",
                  "soft_shadows/scatter", "lower 'soft_resolution', or run on a GPU");
    const auto all = static_cast<double>(classOf.size());
    const double receivers = all - pixels[NotReceiver], casterTexels = costs.casterTexels,
                 splats = costs.splats;
    return {{"caster_texels", casterTexels},
            {"splats_per_caster_texel", casterTexels > 0.0 ? splats / casterTexels : 0.0},
            {"splats_per_receiver", receivers > 0.0 ? splats / receivers : 0.0},
            {"receivers_share", receivers / all},
            {"lit_share", pixels[Lit] / all},
            {"umbra_share", pixels[Umbra] / all},
            {"processed_share", pixels[Processed] / all},
            {"without_answer_share", pixels[Outside] / all}};
  }

 private:
  bool withSecond() const { return settings_.layers != Layering::Nearest; }

  const gl::Program& scatterProgram(frame::Frame& frame, bool counting) const {
    gl::ShaderDefines defines = {{"WHOLE", kWhole}};
    if (counting) defines["COUNT"] = "1";
    return frame.context().programs().compute("renderer/techniques/soft_shadows/scatter/scatter.comp.glsl",
                                              defines);
  }

  const gl::Program& lookupProgram(frame::Frame& frame, bool counting) const {
    gl::ShaderDefines defines = {{"WHOLE", kWhole}};
    if (counting) defines["COUNT"] = "1";
    if (withSecond()) defines["SECOND"] = "1";
    return frame.context().programs().compute(
        "renderer/techniques/soft_shadows/scatter/scatter_lookup.comp.glsl", defines);
  }

  void splat(const gl::Program& program, const gl::Texture& casters, float nothing,
             const gl::Texture& hidden) const {
    program.set("nothing", nothing);
    casters.bindTexture(kScatterCastersUnit);
    layers_->receivers().bindTexture(kScatterReceiversUnit);
    hidden.bindImage(kScatterHiddenImage, gl::Access::ReadWrite);
    program.dispatch(glm::ivec2(settings_.resolution));
  }

  void run(frame::Frame& frame, const gl::Program& scatter, const gl::Program& lookup,
           const gl::Texture* classes) {
    const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    {
      const auto scope = frame.passes().open(kScatterRaster);
      const bool anyFace = settings_.layers != Layering::FrontAndBack;
      layers_->draw(frame, anyFace ? LightLayers::Faces::All : LightLayers::Faces::Towards,
                    anyFace ? LightLayers::Faces::All : LightLayers::Faces::Away);
    }
    const frame::LightFrustum &from = layers_->casterFrustum(), &onto = layers_->receiverFrustum();
    {
      const auto scope = frame.passes().open(kScatterPass);
      for (const std::optional<gl::Texture>& each : hidden_) each->clearUint(glm::uvec4(0));
      costs_->clearUint(0);
      glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
      scatter.set("resolution", settings_.resolution);
      scatter.set("softResolution", settings_.softResolution);
      scatter.set("maxIterations", frame.context().device().software ? 60000 : 0x7fffffff);
      scatter.set("tangentLow", glm::vec2(from.low));
      scatter.set("tangentSize", glm::vec2(from.high - from.low));
      scatter.set("softLow", glm::vec2(onto.low));
      scatter.set("softSize", glm::vec2(onto.high - onto.low));
      scatter.set("lightSize", glm::vec2(frame.scene().lights[0].size));
      scatter.set("casterNear", static_cast<float>(from.near));
      scatter.set("receiverNear", static_cast<float>(onto.near));
      scatter.set("farthestReceiver", static_cast<float>(layers_->farthestReceiver()));
      scatter.set("bias", static_cast<float>(settings_.bias));
      costs_->bindStorage(kScatterCostsBuffer);
      splat(scatter, layers_->nearest(), 0.0F, *hidden_[0]);
      if (withSecond()) splat(scatter, layers_->farthest(), 1.0F, *hidden_[1]);
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    }
    const auto scope = frame.passes().open(kScatterLookup);
    lookup.set("sizePx", frame.sizePx());
    lookup.set("softResolution", settings_.softResolution);
    lookup.set("softLow", glm::vec2(onto.low));
    lookup.set("softSize", glm::vec2(onto.high - onto.low));
    lookup.set("triangleCount", triangleCount_);
    receivers.bindTexture(kScatterLookupSeenPointsUnit);
    layers_->receivers().bindTexture(kScatterLookupReceiversUnit);
    ids.bindTexture(kScatterLookupIdsUnit);
    hidden_[0]->bindTexture(kScatterLookupHiddenUnit);
    hidden_[1]->bindTexture(kScatterLookupHiddenBySecondUnit);
    costs_->bindStorage(kScatterCostsBuffer);
    receiverBits_->bindStorage(kScatterLookupReceiverBitsBuffer);
    visibility_->bindImage(kScatterLookupVisibilityImage, gl::Access::Write);
    if (classes) classes->bindImage(kScatterLookupClassesImage, gl::Access::Write);
    lookup.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  ScatterSettings settings_;
  std::optional<LightLayers> layers_;
  const gl::Program *scatter_ = nullptr, *lookup_ = nullptr;
  std::array<std::optional<gl::Texture>, 2> hidden_;  ///< by the nearest and by the farthest layer
  std::optional<gl::Buffer> costs_, receiverBits_;
  uint32_t triangleCount_ = 0;
  std::optional<gl::Texture> visibility_;
};

const RegisteredTechnique<Scatter> kScatterRegistered{
    {.name = "soft_shadows/scatter",
     .version = 1,
     .summary = "Texels of a map of casters scatter what they hide into a soft shadow map of the receivers",
     .source = "Schwarz 2009, sections 3.2.1 and 4.2.2 (SS-06)",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light", "casters", "receiver_only_parts"},
     .counters = Scatter::counters()}};

}  // namespace
}  // namespace limen::techniques
