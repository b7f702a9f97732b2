// SPDX-License-Identifier: BSD-3-Clause
// Distribution ray tracing (Cook, Porter and Carpenter 1984) of mirrors and glossy mirrors: places in each
// pixel, one in each cell of a square grid, and directions from the mirror seen there within the cone of its
// gloss. Directions that lead beneath the surface are left out of the mean. Primary rays are traced as well.
// What approximations of glossy and antialiased reflection converge to (Roger 2008, section 5.4).
#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "renderer/frame/mirror_path.h"
#include "renderer/frame/mirror_trace.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/references/counter_random.h"
#include "renderer/references/reference_bindings.h"
#include "renderer/references/sampling_noise.h"
#include "renderer/references/square_number.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

constexpr const char* kDistributionName = "reflections/distribution_traced";

struct UniformLobe {
  static constexpr const char *kKind = "uniform", *kSummary = "the same from all directions of the cone";
  static const SettingsTable<UniformLobe>& table() {
    static const SettingsTable<UniformLobe> kTable = {};
    return kTable;
  }
};
struct PhongLobe {
  static constexpr const char *kKind = "phong",
                              *kSummary =
                                  "a power of the cosine with the mirrored direction, cut at the cone";
  double rim = 0.05;
  static const SettingsTable<PhongLobe>& table() {
    static const SettingsTable<PhongLobe> kTable = {{&PhongLobe::rim,
                                                     "rim",
                                                     {1e-4, 0.999},
                                                     "",
                                                     "Weight at the cone's border, relative to its axis",
                                                     "Roger 2008, section 5.3 (value not given there)"}};
    return kTable;
  }
};

struct DistributionSettings {
  int64_t places = 16;
  int lobes = 16;
  std::variant<UniformLobe, PhongLobe> lobe;
  int64_t seed = 1;
  frame::MirrorPathSettings path;
  frame::ShadedSetting shading;
  static const SettingsTable<DistributionSettings>& table() {
    using S = DistributionSettings;
    static const SettingsTable<S> kTable = {
        {&S::places, "places", {1, 4096}, "", "Places in a pixel; a square number"},
        {&S::lobes, "directions", {1, 1024}, "", "Directions from each place on a glossy mirror"},
        {&S::lobe, "lobe", "Weight of the directions within the cone of a mirror's gloss"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of places and directions"},
        included(&S::path),
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
  void check() const { checkSquareNumber(places); }
};

class DistributionTraced : public techniques::Technique {
 public:
  using Settings = DistributionSettings;
  explicit DistributionTraced(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    gl::ShaderDefines defines = frame::mirrorTraceDefines(settings_.shading, frame);
    if (std::holds_alternative<PhongLobe>(settings_.lobe)) defines["PHONG"] = "1";
    program_ =
        &frame.context().programs().compute("renderer/references/distribution_traced.comp.glsl", defines);
    product_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kDistributionName,
                                product_->bytes() + frame.gpuScene().rays(frame.context()).bytes());
  }

  void render(frame::Frame& frame) override {
    const auto scope = frame.passes().open(kDistributionName);
    product_->clear(glm::vec4(0.0F, 0.0F, 0.0F, 1.0F));
    frame::configureMirrorTrace(*program_, frame, settings_.shading);
    program_->set("bounces", settings_.path.bounces);
    program_->set("shadows", settings_.path.shadows);
    program_->set("leastShare", static_cast<float>(settings_.path.leastShare));
    program_->set("lobes", settings_.lobes);
    program_->set("seenShadow", settings_.shading.shadow ? 1 : 0);
    program_->set("placesAside", gridSide(settings_.places));
    program_->set("placeWeight", static_cast<float>(1.0 / double(settings_.places)));
    program_->set("seed", static_cast<uint32_t>(settings_.seed));
    if (const auto* phong = std::get_if<PhongLobe>(&settings_.lobe))
      program_->set("logOfRim", static_cast<float>(std::log(phong->rim)));
    product_->bindImage(kDistributionSumImage, gl::Access::ReadWrite);
    for (int place = 0; place < settings_.places; ++place) {
      program_->set("place", place);
      program_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<techniques::Counter> count(frame::Frame&) override {
    return {{"paths_per_px", double(settings_.places * settings_.lobes)}};
  }

 private:
  DistributionSettings settings_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> product_;
};

/// Of a pixel, if no material reflects more than it receives (albedo and mirror sum to 1 at most): then light
/// adds up to no more than one surface's, and the highlights of all.
double largestColour(const DistributionSettings& settings) {
  const frame::ShadedSetting& shading = settings.shading;
  return std::max(shading.ambient + shading.diffuse, shading.background) +
         (settings.path.bounces + 1) * shading.specular;
}

/// Directions from one place share their light, so that places alone count as independent.
double distributionBound(const DistributionSettings& settings) {
  return largestColour(settings) * hoeffdingHalfWidth(settings.places);
}

const Registered<SamplingNoise> kDistributionNoise{
    {kDistributionName, [](const ParameterValues& values) {
       const DistributionSettings settings = DistributionSettings::table().read(values);
       return largestColour(settings) * largestDeviation(settings.places);
     }}};

const techniques::RegisteredTechnique<DistributionTraced> kDistributionRegistered{
    {.name = kDistributionName,
     .version = 1,
     .summary = "Distribution ray tracing of glossy mirrors: places in pixels, directions in lobes",
     .source = "Cook, Porter and Carpenter 1984; Roger 2008, section 5.4 (R-52, R-59)",
     .product = techniques::ProductKind::Colour,
     .needs = {"mirrors"},
     .reference = true,
     .counters = {{"paths_per_px", "Paths from mirrors a pixel, at most", "", Direction::LowerIsBetter}}},
    distributionBound};

}  // namespace
}  // namespace limen::references
