// SPDX-License-Identifier: BSD-3-Clause
// Levels by distance alone at the cost of lod/perceptual (SP-38): the scene's switch distances are multiplied
// by one factor, the smallest with which at least as many triangles are drawn as lod/perceptual draws in its
// first frame with the same parameters. So whatever lod/perceptual does better, it does with no more
// triangles in the picture; what its tests cost on top is in its own counters and times. Source: Schwarz
// 2009, Fig. 9.8, which compares at "roughly the same frame rate".
#include "renderer/techniques/perceptual_lod/distance_matched.h"

#include <algorithm>
#include <optional>

#include "renderer/techniques/perceptual_lod/oracle.h"
#include "renderer/techniques/perceptual_lod/pipeline.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

double factorForTriangles(const scene::Scene& scene, const scene::LodView& view, uint64_t triangles) {
  // The choice changes only where an object's distance equals one of its switch distances times the factor:
  // just above that quotient the object is finer.
  std::vector<double> factors = {0.0};
  for (const scene::LodObject& object : scene.lodObjects)
    for (const double from : object.switchDistances)
      if (from > 0.0) factors.push_back(scene::viewDistance(object, view.camera) / from * (1.0 + 1e-9));
  std::sort(factors.begin(), factors.end());
  const auto enough = [&](double factor) {
    return scene::triangleCount(scene, scene::levelsByDistance(scene, view, factor)) >= triangles;
  };
  const auto found =
      std::partition_point(factors.begin(), factors.end(), [&](double factor) { return !enough(factor); });
  return found == factors.end() ? factors.back() : *found;
}

namespace {

class DistanceMatched : public Technique {
 public:
  explicit DistanceMatched(const ParameterValues& values)
      : settings_(PerceptualLodSettings::from(values)),
        budget_(static_cast<uint64_t>(values.integer("triangle_budget"))) {}

  void prepare(frame::Frame& frame) override {
    if (budget_ == 0) budget_ = perceptualTriangles(frame);
    factor_ = factorForTriangles(frame.scene(), viewAt(frame, frame.timeS()), budget_);
    view_.emplace(frame, "distance");
  }

  void render(frame::Frame& frame) override {
    timeS_ = frame.timeS() + static_cast<double>(rendered_++) * settings_.frameStepS;
    const scene::LodSelection chosen = scene::levelsByDistance(frame.scene(), viewAt(frame, timeS_), factor_);
    levels_ = chosen.levels;
    product_ = &view_->show(timeS_, chosen).get<frame::Shaded>(settings_.shading).texture();
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> out = countLevels(frame, timeS_, settings_, levels_);
    out.push_back({"distance_factor", factor_, "", false});
    return out;
  }

 private:
  static scene::LodView viewAt(const frame::Frame& frame, double timeS) {
    return {frame.scene().camera.at(timeS), frame.sizePx().y};
  }
  /// What lod/perceptual draws in its first frame. In a frame of its own, whose memory goes with it.
  uint64_t perceptualTriangles(frame::Frame& frame) const {
    frame::Frame own(frame.context(), frame.scene(), frame.gpuScene(), frame.sizePx(), frame.timeS(),
                     frame.raster());
    PerceptualPipeline pipeline(own, settings_);
    for (int n = settings_.settleFrames; n >= 0; --n)
      pipeline.render(frame.timeS() - n * settings_.frameStepS, true);
    return scene::triangleCount(frame.scene(), pipeline.shown());
  }

  PerceptualLodSettings settings_;
  uint64_t budget_;
  double factor_ = 1.0, timeS_ = 0.0;
  int64_t rendered_ = 0;
  std::optional<LevelView> view_;
  std::vector<int> levels_;
  const gl::Texture* product_ = nullptr;
};

std::vector<Parameter> matchedParameters() {
  std::vector<Parameter> out = {integerParameter("triangle_budget", 0, 0, 4'000'000'000, "triangles",
                                                 "Triangles to draw at least, background included; 0: as "
                                                 "many as lod/perceptual draws with the same parameters")};
  appendTo(out, PerceptualLodSettings::parameters());
  return out;
}

std::vector<Quantity> matchedCounterNames() {
  std::vector<Quantity> out = levelCounterNames();
  out.emplace_back("distance_factor");
  return out;
}

const Registered<TechniqueInfo> kDistanceMatchedRegistered{
    {.name = "lod/distance_matched",
     .version = 1,
     .summary = "Levels by distance alone, scaled to draw no fewer triangles than lod/perceptual",
     .source = "Schwarz 2009, section 9.5, Fig. 9.8 (SP-38)",
     .product = ProductKind::Colour,
     .parameters = matchedParameters(),
     .needs = {"lod_sets"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<DistanceMatched>(values); },
     .errorBound = {},
     .counters = matchedCounterNames()}};

}  // namespace
}  // namespace limen::techniques
