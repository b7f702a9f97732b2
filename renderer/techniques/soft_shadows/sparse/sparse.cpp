// SPDX-License-Identifier: BSD-3-Clause
// Visibility for some of the pixels, interpolated for the others (SS-39; Schwarz 2009, section 5.1.3):
// uniformly at lower resolution (after DeCoro and Rusinkiewicz), or the sparser the wider the penumbra on
// screen, with a pull-push reconstruction (after Guennebaud et al. 2007). Any visibility technique can be
// used.
//
// Departures and choices: the thesis gives no formulas for either. Here samples are weighted by their
// distance from the pixel's tangent plane instead of by depth, so that tilted planes lose nothing;
// `min_samples` is Guennebaud's s_min, counted in samples across a penumbra's footprint; a pixel whose square
// extends over an edge of its surface is not skipped.
#include <array>
#include <optional>
#include <variant>

#include "renderer/techniques/soft_shadows/common_counters.h"
#include "renderer/techniques/soft_shadows/inner_technique.h"
#include "renderer/techniques/soft_shadows/sparse/sampling.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kSparsePass = "sparse/visibility";
struct SparseSettings {
  ChosenEntry inner{"soft_shadows/backprojection", {}};
  std::variant<UniformSamplingSettings, AdaptiveSamplingSettings> mode;
  double depthTolerance = 0.02;
  static const SettingsTable<SparseSettings>& table() {
    using S = SparseSettings;
    static const SettingsTable<S> kTable = {
        innerBinding(&S::inner, InnerKind::Backprojecting),
        {&S::mode, "mode", "Which pixels are samples", "Schwarz 2009, section 5.1.3"},
        {&S::depthTolerance,
         "depth_tolerance",
         {1e-4, 1},
         "",
         "Distance from a point's tangent plane, as a share of its distance from the camera, at which a "
         "sample no longer counts for it",
         "Schwarz 2009, section 5.1.3 (value not given there)"}};
    return kTable;
  }
};

class Sparse : public Technique {
 public:
  using Settings = SparseSettings;
  explicit Sparse(const SparseSettings& settings) : settings_(settings), inner_(makeInner(settings.inner)) {}

  void prepare(frame::Frame& frame) override {
    visibility_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld(kSparsePass, visibility_->bytes());
    sampling_ = std::visit(
        [&](const auto& mode) {
          return makeSampling(frame, mode, settings_.depthTolerance, settings_.inner);
        },
        settings_.mode);
    inner_->prepare(sampling_->points());
  }

  void render(frame::Frame& frame) override { run(frame, nullptr); }
  const gl::Texture& product() const override { return *visibility_; }
  std::vector<std::string> remarks() const override { return inner_->remarks(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const gl::Texture classes(gl::Format::R32UI, frame.sizePx());
    frame.begin();
    run(frame, &classes);
    const std::vector<Counter> work = inner_->count(sampling_->points());
    frame.end();
    std::array<double, SampleClassCount> pixels{};
    for (const uint32_t kind : classes.readUint()) pixels.at(kind) += 1.0;
    const double all = double(frame.sizePx().x) * frame.sizePx().y, receivers = all - pixels[NoReceiver];
    const auto share = [&](double part) { return receivers > 0.0 ? part / receivers : 0.0; };
    const auto of = [&](const char* name) {
      for (const Counter& counter : work)
        if (counter.name == name) return counter.value;
      return 0.0;
    };
    const glm::dvec2 points(sampling_->points().sizePx());
    const double samples = of("receivers_share") * points.x * points.y;
    const double processed = of("processed_share") * points.x * points.y;
    return {{"evaluated_share", share(samples)},
            {"micro_occluders_per_px", of("micro_occluders_per_px")},
            {"micro_occluders_per_receiver", share(processed * of("micro_occluders_per_px"))},
            {"fallback_share", share(pixels[NearestInDepth] + pixels[NoSample])},
            {"unreached_share", share(pixels[NoSample])}};
  }

  static std::vector<Quantity> counters() {
    return {
        {"evaluated_share", "Share of receivers that are evaluated", "", Direction::LowerIsBetter},
        counterOf(innerCounters(), "micro_occluders_per_px"),
        {"micro_occluders_per_receiver", "Micro-occluders per receiver", "1/px", Direction::LowerIsBetter},
        {"fallback_share", "Share of receivers without a sample on their surface", "", Direction::Neither},
        {"unreached_share", "Share of receivers without a sample within reach", "", Direction::Neither}};
  }

 private:
  void run(frame::Frame& frame, const gl::Texture* classes) {
    frame::Frame& points = sampling_->points();
    points.setTime(frame.timeS());
    points.begin();
    sampling_->choose(frame);
    inner_->render(points);
    sampling_->reconstruct(frame, inner_->product(), *visibility_, classes);
    points.end();
  }

  SparseSettings settings_;
  std::unique_ptr<Technique> inner_;
  std::unique_ptr<SparseSampling> sampling_;
  std::optional<gl::Texture> visibility_;
};

const RegisteredTechnique<Sparse> kSparseRegistered{
    {.name = "soft_shadows/sparse",
     .version = 1,
     .summary = "Another technique's visibility for some of the pixels, interpolated for the others",
     .source = "Schwarz 2009, section 5.1.3 (SS-39)",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light"},
     .counters = Sparse::counters()}};

}  // namespace
}  // namespace limen::techniques
