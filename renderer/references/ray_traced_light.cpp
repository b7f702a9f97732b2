// SPDX-License-Identifier: BSD-3-Clause
// Shadow rays from every surface point to points on the light: visibility on the true geometry, known up to
// sampling.
#include <optional>

#include "experiments/base/error.h"
#include "renderer/references/counter_random.h"
#include "renderer/references/sampling_noise.h"
#include "renderer/references/shadow_tracer.h"
#include "renderer/references/square_number.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

using techniques::Counter;

enum class RayPattern {
  Stratified,  ///< one point in each cell of a square grid over the light
  Random       ///< anywhere
};
constexpr EnumNames<RayPattern, 2> enumNames(RayPattern) {
  return {{{{RayPattern::Stratified, "stratified"}, {RayPattern::Random, "random"}}}};
}

struct RayTracedSettings {
  int64_t samples = 1024;
  RayPattern pattern = RayPattern::Stratified;
  int64_t seed = 1;
  Tracer tracer = Tracer::Auto;
  static const SettingsTable<RayTracedSettings>& table() {
    using S = RayTracedSettings;
    static const SettingsTable<S> kTable = {
        {&S::samples,
         "samples",
         {16, 65536},
         "rays",
         "Shadow rays per receiver; a square number if stratified"},
        {&S::pattern, "pattern", "Place points in the cells of a square grid over the light, or anywhere"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the points on the light"},
        {&S::tracer, "tracer", kTracerSummary}};
    return kTable;
  }
  void check() const {
    if (pattern == RayPattern::Stratified) checkSquareNumber(samples, ", or pattern: random");
  }
};

class RayTracedLight : public techniques::Technique {
 public:
  using Settings = RayTracedSettings;
  explicit RayTracedLight(const RayTracedSettings& settings)
      : samples_(settings.samples),
        seed_(static_cast<uint64_t>(settings.seed)),
        strata_(settings.pattern == RayPattern::Stratified ? gridSide(settings.samples) : 0),
        with_(settings.tracer) {}

  void prepare(frame::Frame& frame) override {
    triangles_.emplace(frame.scene(), frame.gpuScene().anchor());
    tracer_ = makeShadowTracer(with_, frame, *triangles_);
    product_.emplace(gl::Format::R32F, frame.sizePx());
    visibility_ = Image(frame.sizePx().x, frame.sizePx().y, 1);
    frame.passes().setBytesHeld("ray_traced_light/trace", tracer_->bytes());
    frame.passes().setBytesHeld("ray_traced_light/upload", product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const std::vector<ReceiverPoint> points = readReceiverPoints(frame, *triangles_);
    {
      const auto scope = frame.passes().open("ray_traced_light/trace");
      trace(frame, points);
    }
    const auto scope = frame.passes().open("ray_traced_light/upload");
    product_->write(visibility_);
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"rays_per_receiver", double(samples_)}, {"rays", double(rays_)}};
  }

  std::vector<std::string> remarks() const override { return {tracer_->remark()}; }

 private:
  void trace(const frame::Frame& frame, const std::vector<ReceiverPoint>& points) {
    const scene::AreaLight& light = frame.scene().lights.at(0);
    const LightShapeMap map(light);
    const std::vector<ShadowCounts> counts =
        tracer_->trace(points, {light, map, samples_, strata_, seed_}, frame.gpuScene().anchor());
    std::fill(visibility_.data.begin(), visibility_.data.end(), 1.0F);
    rays_ = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      visibility_.data[points[i].pixel] = static_cast<float>(seenShare(counts[i], samples_));
      rays_ += counts[i].rays;
    }
  }

  int64_t samples_, rays_ = 0;
  uint64_t seed_;
  int strata_;  // 0: random
  Tracer with_;
  std::optional<Triangles> triangles_;
  std::unique_ptr<ShadowTracer> tracer_;
  std::optional<gl::Texture> product_;
  Image visibility_;
};

const Registered<SamplingNoise> kVisibilityNoise{
    {"soft_shadows/ray_traced", [](const ParameterValues& values) {
       return largestDeviation(RayTracedSettings::table().read(values).samples);
     }}};

double halfWidth(const RayTracedSettings& settings) { return hoeffdingHalfWidth(settings.samples); }

const techniques::RegisteredTechnique<RayTracedLight> kRayTracedLightRegistered{
    {.name = "soft_shadows/ray_traced",
     .version = 2,
     .summary = "Shadow rays to points on the light against the true triangles",
     .source = "Schwarz 2009, section 3.3",
     .needs = {"area_light"},
     .reference = true,
     .onCpu = true,
     .counters = {{"rays_per_receiver", "Shadow rays per receiver", "", Direction::LowerIsBetter},
                  {"rays", "Shadow rays", "", Direction::LowerIsBetter}},
     .effort = "samples"},
    halfWidth};

}  // namespace
}  // namespace limen::references
