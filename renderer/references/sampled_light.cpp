// SPDX-License-Identifier: BSD-3-Clause
// Mean of hard shadows from many points of the light, a shadow map each: the thesis's own reference. It has
// the aliasing and the biases of its maps.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/references/reference_bindings.h"
#include "renderer/references/square_number.h"
#include "renderer/scene/shapes.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

using techniques::Counter;

constexpr const char* kSampledName = "soft_shadows/sampled_light";

struct GridPoints {
  static constexpr const char *kKind = "grid", *kSummary = "centres of the cells of a square grid";
};
struct JitteredPoints {
  static constexpr const char *kKind = "jittered", *kSummary = "a point anywhere in each cell of the grid";
  int64_t seed = 1;
  static const SettingsTable<JitteredPoints>& table() {
    static const SettingsTable<JitteredPoints> kTable = {
        Binding(&JitteredPoints::seed, "seed", Range{0, 1000000}, "", "Seed of the jitter")
            .formerly({"seed"})};
    return kTable;
  }
};

constexpr Range kConstants{0.0, 0.1}, kTexels{0.0, 8.0};
constexpr const char* kConstantText = "Depth bias as a share of the depth";

/// Each texel against the receiver's plane at the texel's centre, in its map's own projection.
struct MapPlaneBias {
  static constexpr const char *kKind = "receiver_plane",
                              *kSummary = "against the receiver's own plane at the texel's centre";
  double constant = 1e-4, slope = 0.3;
  static const SettingsTable<MapPlaneBias>& table() {
    static const SettingsTable<MapPlaneBias> kTable = {
        {&MapPlaneBias::constant, "constant", kConstants, "", kConstantText},
        {&MapPlaneBias::slope, "slope", kTexels, "texels",
         "Further bias by the plane's change over this many texels, for surfaces that bend towards the "
         "light"}};
    return kTable;
  }
};
struct MapSlopeBias {
  static constexpr const char *kKind = "receiver_slope",
                              *kSummary = "by the change of the receiver's plane over some texels";
  double constant = 1e-4, slope = 0.6;
  static const SettingsTable<MapSlopeBias>& table() {
    static const SettingsTable<MapSlopeBias> kTable = {
        {&MapSlopeBias::constant, "constant", kConstants, "", kConstantText},
        Binding(
            &MapSlopeBias::slope, "slope", kTexels, "texels",
            "Depth bias as the plane's change over this many texels; a plane needs half a texel, the rest "
            "allows for the curvature of depth over a texel")
            .formerly({"slope_bias"})};
    return kTable;
  }
};

struct SampledLightSettings {
  int64_t samples = 1024;
  int resolution = 1024;
  std::variant<GridPoints, JitteredPoints> pattern;
  std::variant<MapPlaneBias, MapSlopeBias> bias;
  static const SettingsTable<SampledLightSettings>& table() {
    using S = SampledLightSettings;
    static const SettingsTable<S> kTable = {
        {&S::samples,
         "samples",
         {1, 4096},
         "maps",
         "Shadow maps; a square number",
         "Schwarz 2009, section 3.3"},
        {&S::resolution, "resolution", {64, 4096}, "texels", "Side of each shadow map"},
        {&S::pattern, "pattern", "Points on the light"},
        Binding(&S::bias, "bias", "Bias that keeps a surface from shadowing itself").shorthand("constant")};
    return kTable;
  }
  void check() const { checkSquareNumber(samples); }
};

class SampledLight : public techniques::Technique {
 public:
  using Settings = SampledLightSettings;
  explicit SampledLight(const SampledLightSettings& settings)
      : settings_(settings), side_(gridSide(settings.samples)), resolution_(settings.resolution) {}

  void prepare(frame::Frame& frame) override {
    const frame::LightCasters casters(frame.scene());
    const scene::AreaLight& light = frame.scene().lights.at(0);
    for (const glm::dvec2 unit : lightPoints(light))
      frusta_.push_back(casters.fit((unit - 0.5) * light.size, resolution_));
    raster_.emplace(frame.context(), resolution_, frame.raster());
    gl::ShaderDefines defines;
    if (std::holds_alternative<MapPlaneBias>(settings_.bias)) defines["BIAS_PLANE"] = "1";
    accumulate_ = &frame.context().programs().compute("renderer/references/sampled_light.comp.glsl", defines);
    resolve_ = &frame.context().programs().compute("renderer/references/sampled_light_resolve.comp.glsl");
    counts_.emplace(gl::Format::R32UI, frame.sizePx());
    product_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld("sampled_light/maps", raster_->bytes() + counts_->bytes());
    frame.passes().setBytesHeld("sampled_light/resolve", product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
    const gl::Texture& normals =
        frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Normal}).texture();
    {
      const auto scope = frame.passes().open("sampled_light/maps");
      counts_->clearUint(glm::uvec4(0));
      accumulate_->set("sizePx", frame.sizePx());
      accumulate_->set("anchorToLight", glm::mat3(frame.scene().lights.at(0).toLightSpace()));
      accumulate_->set("resolution", resolution_);
      std::visit(
          [&](const auto& bias) {
            accumulate_->set("bias", static_cast<float>(bias.constant));
            accumulate_->set("slopeBias", static_cast<float>(bias.slope));
          },
          settings_.bias);
      for (const frame::LightFrustum& frustum : frusta_) {
        raster_->draw(frame, frame.geometry(), frustum);
        receivers.bindTexture(kSampledLightReceiversUnit);
        normals.bindTexture(kSampledLightNormalsUnit);
        raster_->depth().bindTexture(kSampledLightDepthMapUnit);
        counts_->bindImage(kSampledLightLitCountsImage, gl::Access::ReadWrite);
        accumulate_->set("offset", glm::vec2(frustum.offset));
        accumulate_->set("low", glm::vec2(frustum.low));
        accumulate_->set("extent", glm::vec2(frustum.high - frustum.low));
        accumulate_->set("near", static_cast<float>(frustum.near));
        accumulate_->dispatch(frame.sizePx());
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
      }
    }
    const auto scope = frame.passes().open("sampled_light/resolve");
    resolve_->set("sizePx", frame.sizePx());
    resolve_->set("samples", static_cast<int>(frusta_.size()));
    receivers.bindTexture(kSampledLightResolveReceiversUnit);
    counts_->bindImage(kSampledLightResolveLitCountsImage, gl::Access::Read);
    product_->bindImage(kSampledLightResolveVisibilityImage, gl::Access::Write);
    resolve_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *product_; }

  /// A map that misses casters shows light where there may be none: read the product together with the share
  /// of such maps.
  std::vector<Counter> count(frame::Frame& frame) override {
    const auto maps = double(frusta_.size());
    const auto cut = std::count_if(frusta_.begin(), frusta_.end(),
                                   [](const frame::LightFrustum& frustum) { return frustum.castersCut; });
    return {{"shadow_maps", maps},
            {"triangles_drawn", maps * frame.gpuScene().triangleCount()},
            {"maps_cutting_casters_share", double(cut) / maps}};
  }

 private:
  /// Centres of the cells of a square grid over the light's bounding rectangle, or one seeded point in each.
  /// A light that does not fill the rectangle keeps the points that lie on it: the cells have equal areas, so
  /// the mean over the points kept is the mean over the light.
  std::vector<glm::dvec2> lightPoints(const scene::AreaLight& light) const {
    std::vector<glm::dvec2> points;
    const auto* jitter = std::get_if<JitteredPoints>(&settings_.pattern);
    scene::Random random(jitter ? jitter->seed : 0);
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) {
        glm::dvec2 inCell(0.5);
        if (jitter) inCell.x = random.uniform(0.0, 1.0), inCell.y = random.uniform(0.0, 1.0);
        const glm::dvec2 unit = (glm::dvec2(x, y) + inCell) / double(side_);
        if (light.contains(unit)) points.push_back(unit);
      }
    if (points.empty())
      throw Error("none of the samples lies on the light", kSampledName, "give more samples");
    return points;
  }

  SampledLightSettings settings_;
  int side_, resolution_;
  std::vector<frame::LightFrustum> frusta_;
  std::optional<frame::ShadowRaster> raster_;
  const gl::Program *accumulate_ = nullptr, *resolve_ = nullptr;
  std::optional<gl::Texture> counts_, product_;
};

/// A straight edge crosses at most 2 S - 1 of the S x S cells of a rectangular light, and only there can a
/// cell's single point be wrong about the cell's share, by at most a whole cell: (2 S - 1) / S^2 < 2 / S. It
/// holds for a convex occluder with one edge across the light; each further edge adds as much, and the maps'
/// resolution and biases are not included.
double edgeBound(const SampledLightSettings& settings) {
  return std::min(1.0, 2.0 / std::sqrt(double(settings.samples)));
}

const techniques::RegisteredTechnique<SampledLight> kSampledLightRegistered{
    {.name = kSampledName,
     .version = 2,
     .summary = "Mean of hard shadow maps from a grid of points on the light",
     .source = "Schwarz 2009, section 3.3",
     .needs = {"area_light"},
     .reference = true,
     .counters = {{"shadow_maps", "Shadow maps", "", Direction::LowerIsBetter},
                  {"triangles_drawn", "Triangles drawn", "", Direction::LowerIsBetter},
                  {"maps_cutting_casters_share", "Share of maps that cut casters", "", Direction::Neither}},
     .effort = "samples"},
    edgeBound};

}  // namespace
}  // namespace limen::references
