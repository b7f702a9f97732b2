// SPDX-License-Identifier: BSD-3-Clause
// Shadow rays from every surface point to points on each part of a coloured light: what share of the light's
// radiance the true geometry lets through, channel by channel, known up to sampling.
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

constexpr const char* kColours = "soft_shadows/ray_traced_colours";

struct ColoursSettings {
  int64_t samples = 256, seed = 1;
  Tracer tracer = Tracer::Auto;
  static const SettingsTable<ColoursSettings>& table() {
    using S = ColoursSettings;
    static const SettingsTable<S> kTable = {
        {&S::samples,
         "samples",
         {4, 65536},
         "rays",
         "Shadow rays to each part of the light; a square number"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the points on the light"},
        {&S::tracer, "tracer", kTracerSummary}};
    return kTable;
  }
  void check() const { checkSquareNumber(samples); }
};

/// A part of the light, sampled separately: its visibility has the same bound as that of a light of one
/// colour, and so has the mean weighted by what the parts emit.
struct EmittingPart {
  LightShapeMap map;
  glm::dvec3 share;  ///< of everything the light emits
};

std::vector<EmittingPart> partsOf(const scene::AreaLight& light) {
  std::vector<EmittingPart> parts;
  glm::dvec3 sum(0.0);
  for (const scene::LightPart& part : light.parts) {
    scene::AreaLight alone = light;
    double area = light.area();
    if (!part.outline.empty()) {
      if (light.shape != scene::LightShape::Rectangle)
        throw Error("the intersections of a non-rectangular light with its parts are not known", kColours,
                    "give light_shape: rectangle");
      alone.shape = scene::LightShape::Polygon;
      alone.outline = part.outline;
      area = alone.area();
    }
    parts.push_back({LightShapeMap(alone), glm::dvec3(part.radiance) * area});
    sum += parts.back().share;
  }
  for (EmittingPart& part : parts)
    for (int channel = 0; channel < 3; ++channel)
      part.share[channel] = sum[channel] > 0.0 ? part.share[channel] / sum[channel] : 0.0;
  return parts;
}

class RayTracedColours : public techniques::Technique {
 public:
  using Settings = ColoursSettings;
  explicit RayTracedColours(const ColoursSettings& settings)
      : side_(gridSide(settings.samples)),
        seed_(static_cast<uint64_t>(settings.seed)),
        with_(settings.tracer) {}

  void prepare(frame::Frame& frame) override {
    parts_ = partsOf(frame.scene().lights.at(0));
    triangles_.emplace(frame.scene(), frame.gpuScene().anchor());
    tracer_ = makeShadowTracer(with_, frame, *triangles_);
    product_.emplace(gl::Format::RGBA32F, frame.sizePx());
    colour_ = Image(frame.sizePx().x, frame.sizePx().y, 4);
    frame.passes().setBytesHeld("ray_traced_colours/trace", tracer_->bytes());
    frame.passes().setBytesHeld("ray_traced_colours/upload", product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const std::vector<ReceiverPoint> points = readReceiverPoints(frame, *triangles_);
    {
      const auto scope = frame.passes().open("ray_traced_colours/trace");
      trace(frame, points);
    }
    const auto scope = frame.passes().open("ray_traced_colours/upload");
    product_->write(colour_);
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"rays_per_receiver", double(side_) * side_ * double(parts_.size())}, {"rays", double(rays_)}};
  }

  std::vector<std::string> remarks() const override { return {tracer_->remark()}; }

 private:
  void trace(const frame::Frame& frame, const std::vector<ReceiverPoint>& points) {
    const scene::AreaLight& light = frame.scene().lights.at(0);
    glm::dvec3 absent(1.0);
    for (const EmittingPart& part : parts_) absent -= part.share;
    // A channel in which the light emits nothing is fully visible.
    std::vector<glm::dvec3> colours(points.size(), glm::dvec3(glm::greaterThan(absent, glm::dvec3(0.5))));
    const int64_t samples = int64_t{side_} * side_;
    rays_ = 0;
    for (size_t part = 0; part < parts_.size(); ++part) {
      const std::vector<ShadowCounts> counts = tracer_->trace(
          points, {light, parts_[part].map, samples, side_, seed_, part}, frame.gpuScene().anchor());
      for (size_t i = 0; i < points.size(); ++i) {
        colours[i] += parts_[part].share * seenShare(counts[i], samples);
        rays_ += counts[i].rays;
      }
    }
    std::fill(colour_.data.begin(), colour_.data.end(), 1.0F);
    for (size_t i = 0; i < points.size(); ++i)
      for (size_t channel = 0; channel < 3; ++channel)
        colour_.data[4 * points[i].pixel + channel] = static_cast<float>(colours[i][int(channel)]);
  }

  int side_;
  uint64_t seed_;
  Tracer with_;
  int64_t rays_ = 0;
  std::vector<EmittingPart> parts_;
  std::optional<Triangles> triangles_;
  std::unique_ptr<ShadowTracer> tracer_;
  std::optional<gl::Texture> product_;
  Image colour_;
};

const Registered<SamplingNoise> kColourNoise{{kColours, [](const ParameterValues& values) {
                                                return largestDeviation(
                                                    ColoursSettings::table().read(values).samples);
                                              }}};

double colourHalfWidth(const ColoursSettings& settings) { return hoeffdingHalfWidth(settings.samples); }

const techniques::RegisteredTechnique<RayTracedColours> kRegisteredColours{
    {.name = kColours,
     .version = 2,
     .summary = "Share of a coloured light's radiance by shadow rays to each of its parts",
     .source = "Schwarz 2009, section 3.3",
     .product = techniques::ProductKind::LightColour,
     .needs = {"area_light"},
     .reference = true,
     .onCpu = true,
     .counters = {{"rays_per_receiver", "Shadow rays per receiver", "", Direction::LowerIsBetter},
                  {"rays", "Shadow rays", "", Direction::LowerIsBetter}},
     .effort = "samples"},
    colourHalfWidth};

}  // namespace
}  // namespace limen::references
