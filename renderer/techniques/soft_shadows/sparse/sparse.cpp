// SPDX-License-Identifier: BSD-3-Clause
// Visibility for some of the pixels, interpolated for the others (SS-39; Schwarz 2009, section 5.1.3):
// uniformly at lower resolution (after DeCoro and Rusinkiewicz), or the sparser the wider the penumbra is on
// the screen, with a pull-push reconstruction (after Guennebaud et al. 2007). Any technique of visibility may
// do the work.
//
// Departures and choices: the thesis gives no formulas for either. Here samples are weighed by their distance
// from the pixel's tangent plane instead of by depth, so that tilted planes lose nothing; `min_samples`
// stands for Guennebaud's s_min, counted in samples across a penumbra's footprint; where a pixel's square
// reaches over an edge of its surface, the pixel is not skipped.
#include <array>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/inner_technique.h"
#include "renderer/techniques/soft_shadows/sparse/sampling.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kSparsePass = "sparse/visibility";
constexpr const char* kSparseSection = "Schwarz 2009, section 5.1.3";

bool adaptive(const ParameterValues& values) { return values.text("mode") == "adaptive"; }

std::vector<Parameter> sparseParameters() {
  std::vector<Parameter> out = {
      choiceParameter("mode", "uniform", {"uniform", "adaptive"},
                      "Samples on a grid, or the fewer the wider the penumbra is on the screen",
                      kSparseSection),
      choiceParameter("factor", "2", {"1", "2", "4", "8"},
                      "Uniform mode: pixels from sample to sample, along rows and along columns",
                      "Schwarz 2009, section 5.1.3 (value not given there)"),
      choiceParameter(
          "points", "subset", {"subset", "rendered"},
          "Uniform mode: samples are pixels of the picture, or of one rendered at lower resolution",
          kSparseSection),
      realParameter(
          "min_samples", 8.0, 1.0, 256.0, "samples",
          "Adaptive mode: samples that a penumbra's width on the screen must hold before pixels are skipped "
          "(s_min)",
          "Schwarz 2009, section 5.1.3 (value not given there)"),
      integerParameter("coarsest_level", 3, 0, 5, "",
                       "Adaptive mode: samples are at most 2 to this power pixels apart",
                       "Schwarz 2009, section 5.1.3 (value not given there)")};
  for (Parameter& parameter : Reconstruction::parameters()) out.push_back(std::move(parameter));
  for (Parameter& parameter : innerParameters(InnerKind::Backprojecting)) out.push_back(std::move(parameter));
  return out;
}

void checkSparse(const ParameterValues& values) {
  static const std::map<std::string, bool> kOnlyAdaptive = {{"factor", false},
                                                            {"points", false},
                                                            {"normal_power", false},
                                                            {"min_samples", true},
                                                            {"coarsest_level", true}};
  for (const Parameter& parameter : sparseParameters()) {
    const auto mode = kOnlyAdaptive.find(parameter.name);
    if (mode == kOnlyAdaptive.end() || mode->second == adaptive(values) ||
        values.all().at(parameter.name) == parameter.defaultValue)
      continue;
    throw Error("'" + parameter.name + "' is about the other mode than '" + values.text("mode") + "'",
                parameter.name,
                "leave it out, or give mode: " + std::string(mode->second ? "adaptive" : "uniform"));
  }
  checkInner(values);
}

class Sparse : public Technique {
 public:
  explicit Sparse(const ParameterValues& values) : values_(values), inner_(makeInner(values)) {
    checkSparse(values);
  }

  void prepare(frame::Frame& frame) override {
    visibility_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld(kSparsePass, visibility_->bytes());
    sampling_ =
        adaptive(values_) ? makeAdaptiveSampling(frame, values_) : makeUniformSampling(frame, values_);
    inner_->prepare(sampling_->points());
  }

  void render(frame::Frame& frame) override { run(frame, nullptr); }
  const gl::Texture& product() const override { return *visibility_; }

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
    return {{"evaluated_share", share(samples), "", true},
            {"micro_occluders_per_px", of("micro_occluders_per_px"), "", true},
            {"micro_occluders_per_receiver", share(processed * of("micro_occluders_per_px")), "", true},
            {"fallback_share", share(pixels[NearestInDepth] + pixels[NoSample]), "", false},
            {"unreached_share", share(pixels[NoSample]), "", false}};
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

  ParameterValues values_;
  std::unique_ptr<Technique> inner_;
  std::unique_ptr<SparseSampling> sampling_;
  std::optional<gl::Texture> visibility_;
};

const Registered<TechniqueInfo> kSparseRegistered{
    {.name = "soft_shadows/sparse",
     .version = 1,
     .summary = "Another technique's visibility for some of the pixels, interpolated for the others",
     .source = "Schwarz 2009, section 5.1.3 (SS-39)",
     .product = ProductKind::Visibility,
     .parameters = sparseParameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Sparse>(values); },
     .errorBound = {},
     .counters = {"evaluated_share", "micro_occluders_per_px", "micro_occluders_per_receiver",
                  "fallback_share", "unreached_share"},
     .check = checkSparse}};

}  // namespace
}  // namespace limen::techniques
