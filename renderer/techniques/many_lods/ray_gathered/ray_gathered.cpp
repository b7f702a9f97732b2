// SPDX-License-Identifier: BSD-3-Clause
// Reference of many-view techniques: what rays from the point that each pixel sees gather, by the cosine and,
// on glossy surfaces, by the lobe (one-sample multiple importance sampling), from surfaces that the lamp
// lights or from an environment. It knows neither points nor virtual lights and bounds no light. The lamp is
// the scene's first light, a point that sends light with the cosine of its direction, as virtual lights have
// it. Source: Kajiya 1986; Veach and Guibas 1995.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "renderer/frame/g_buffer.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"
#include "renderer/techniques/many_lods/receiver_surface.h"
#include "renderer/techniques/many_lods/sky.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char *kRayGatherPass = "many_lods/gather_rays",
                     *kGatheredMeanPass = "many_lods/gathered_mean";
constexpr int kRaysOfPass = 32;  // a software renderer ends loops after 65,535 rounds

struct LampBounce {
  static constexpr const char *kKind = "lamp",
                              *kSummary = "light of the scene's first light that surfaces reflect";
  double gain = 10.0;
  double clamp = 0.0;
  static const SettingsTable<LampBounce>& table() {
    static const SettingsTable<LampBounce> kTable = {
        {&LampBounce::clamp,
         "clamp",
         {0.0, 1.0},
         "",
         "Distance below which light that surfaces send grows no more, as many_lods/traced_radiosity bounds "
         "it; 0: "
         "no bound"},
        {&LampBounce::gain,
         "gain",
         {0.0, 1000.0},
         "",
         "Factor on the light, as many_lods/traced_radiosity has it"}};
    return kTable;
  }
};

struct RayGatherSettings {
  int rays = 256;
  int64_t seed = 1;
  std::variant<LampBounce, SkySettings> light;
  ReceiverSurface receivers;
  static const SettingsTable<RayGatherSettings>& table() {
    using S = RayGatherSettings;
    static const SettingsTable<S> kTable = {
        {&S::rays, "rays", {2, 65536}, "rays/px", "Rays from each pixel's point"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the directions"},
        {&S::light, "light", "Where light comes from"},
        {&S::receivers, "receivers", kReceiverText}};
    return kTable;
  }
};

class RayGathered : public Technique {
 public:
  using Settings = RayGatherSettings;
  explicit RayGathered(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    gl::ShaderDefines defines;
    if (std::holds_alternative<SkySettings>(settings_.light)) defines["SKY"] = "1";
    const std::string folder = "renderer/techniques/many_lods/ray_gathered/";
    gather_ = &frame.context().programs().compute(folder + "ray_gathered.comp.glsl", defines);
    mean_ = &frame.context().programs().compute(folder + "gathered_mean.comp.glsl");
    sums_.emplace(gl::Format::RGBA32F, frame.sizePx());
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kRayGatherPass,
                                sums_->bytes() + frame.gpuScene().rays(frame.context()).bytes());
    frame.passes().setBytesHeld(kGatheredMeanPass, picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    const auto channel = [&](frame::Channel of) -> const gl::Texture& {
      return frame.get<frame::GBufferChannel>(frame::ChannelSetting{of}).texture();
    };
    const gl::Texture& positions = channel(frame::Channel::Position);
    const gl::Texture& normals = channel(frame::Channel::Normal);
    const gl::Texture& albedos = channel(frame::Channel::Albedo);
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    {
      const auto scope = frame.passes().open(kRayGatherPass);
      sums_->clear(glm::vec4(0.0F));
      frame.bindSurfaces();
      frame.geometry().bindStorage();
      frame.gpuScene().rays(frame.context()).bind(*gather_);
      positions.bindTexture(kRayGatherPositionsUnit);
      normals.bindTexture(kRayGatherNormalsUnit);
      albedos.bindTexture(kRayGatherAlbedosUnit);
      ids.bindTexture(kRayGatherIdsUnit);
      sums_->bindImage(kRayGatherSumsImage, gl::Access::ReadWrite);
      configure(frame);
      for (int first = 0; first < settings_.rays; first += kRaysOfPass) {
        gather_->set("firstRay", first);
        gather_->set("endRay", std::min(first + kRaysOfPass, settings_.rays));
        gather_->dispatch(frame.sizePx());
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
      }
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    const auto scope = frame.passes().open(kGatheredMeanPass);
    mean_->set("sizePx", frame.sizePx());
    mean_->set("weight", static_cast<float>(1.0 / settings_.rays));
    sums_->bindTexture(kRayGatherSumsUnit);
    picture_->bindImage(kRayGatherImage, gl::Access::Write);
    mean_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame&) override {
    const Image sums = sums_->read();
    const double n = settings_.rays;
    double variance = 0.0;
    for (size_t pixel = 0; pixel < sums.pixels(); ++pixel) {
      const float* at = &sums.data[4 * pixel];
      const double mean = (double(at[0]) + at[1] + at[2]) / (3.0 * n);
      variance += std::max(at[3] / n - mean * mean, 0.0) / (n - 1.0);
    }
    return {{"rays_per_px", n}, {"standard_error", std::sqrt(variance / double(sums.pixels()))}};
  }

 private:
  void configure(frame::Frame& frame) const {
    gather_->set("sizePx", frame.sizePx());
    gather_->set("seed", static_cast<uint32_t>(settings_.seed));
    gather_->set("nearestHit", static_cast<float>(1e-6 * frame.gpuScene().diagonal()));
    configureReceivers(*gather_, frame, settings_.receivers);
    if (const auto* sky = std::get_if<SkySettings>(&settings_.light)) {
      configureSky(*gather_, *sky);
      return;
    }
    glm::vec3 centre(0.0F), direction(0.0F, -1.0F, 0.0F), intensity(0.0F);
    if (!frame.scene().lights.empty()) {
      const scene::AreaLight& light = frame.scene().lights[0];
      centre = glm::vec3(light.centre - frame.gpuScene().anchor());
      direction = glm::vec3(light.direction());
      intensity = light.parts[0].radiance *
                  static_cast<float>(std::get<LampBounce>(settings_.light).gain * light.area());
    }
    gather_->set("leastDistance", static_cast<float>(std::get<LampBounce>(settings_.light).clamp *
                                                     frame.gpuScene().diagonal()));
    gather_->set("lampCentre", centre);
    gather_->set("lampZ", direction);
    gather_->set("intensity", intensity);
  }

  Settings settings_;
  const gl::Program *gather_ = nullptr, *mean_ = nullptr;
  std::optional<gl::Texture> sums_, picture_;
};

const RegisteredTechnique<RayGathered> kRayGatheredRegistered{
    {.name = "many_lods/ray_gathered",
     .version = 1,
     .summary =
         "Light that rays gather from lit surfaces or from an environment, on diffuse and glossy surfaces",
     .source = "Kajiya 1986; Veach and Guibas 1995 (HOL-27, HOL-28)",
     .product = ProductKind::Colour,
     .reference = true,
     .counters =
         {{"rays_per_px", "Rays from each pixel's point", "", Direction::LowerIsBetter},
          {"standard_error",
           "Standard error of pixels' channel means as of independent rays, root mean square over the "
           "picture; the pattern's is smaller",
           "", Direction::LowerIsBetter}},
     .effort = "rays"}};

}  // namespace
}  // namespace limen::techniques
