// SPDX-License-Identifier: BSD-3-Clause
// Levels by distance only, at the cost of lod/perceptual (SP-38): the scene's switch distances are multiplied
// by one factor, the smallest with which at least as many triangles are drawn as lod/perceptual draws in its
// first frame with the same parameters. So whatever lod/perceptual does better, it does with no more
// triangles in the picture; the extra cost of its tests is in its own counters and times. Source: Schwarz
// 2009, Fig. 9.8, which compares at "roughly the same frame rate".
#include "renderer/techniques/perceptual_lod/distance_matched.h"

#include <algorithm>
#include <optional>

#include "renderer/techniques/perceptual_lod/oracle.h"
#include "renderer/techniques/perceptual_lod/pipeline.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

double factorForTriangles(const scene::Scene& scene, const scene::LodView& view, uint64_t triangles) {
  // The selection changes only where an object's distance equals one of its switch distances times the
  // factor: just above that quotient the object is finer.
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

struct PerceptualBudget {
  static constexpr const char *kKind = "perceptual",
                              *kSummary = "as many as lod/perceptual draws with the same settings";
};

struct TriangleBudget {
  static constexpr const char *kKind = "triangles", *kSummary = "a given number";
  int64_t count = 100000;
  static const SettingsTable<TriangleBudget>& table() {
    static const SettingsTable<TriangleBudget> kTable = {Binding(&TriangleBudget::count, "count",
                                                                 Range{1, 4'000'000'000.0}, "triangles",
                                                                 "Triangles, including the background")
                                                             .formerly({"triangle_budget"})};
    return kTable;
  }
};

struct MatchedSettings {
  std::variant<PerceptualBudget, TriangleBudget> budget;
  PerceptualLodSettings perceptual;
  static const SettingsTable<MatchedSettings>& table() {
    using S = MatchedSettings;
    static const SettingsTable<S> kTable = {{&S::budget, "budget", "Smallest number of triangles to draw"},
                                            included(&S::perceptual)};
    return kTable;
  }
};

class DistanceMatched : public Technique {
 public:
  using Settings = MatchedSettings;
  explicit DistanceMatched(const MatchedSettings& settings)
      : settings_(settings.perceptual), budget_(settings.budget) {}

  void prepare(frame::Frame& frame) override {
    const auto* given = std::get_if<TriangleBudget>(&budget_);
    const uint64_t triangles = given ? static_cast<uint64_t>(given->count) : perceptualTriangles(frame);
    factor_ = factorForTriangles(frame.scene(), viewAt(frame, frame.timeS()), triangles);
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
    std::vector<Counter> out = countLevels(frame.scene(), levels_);
    if (settings_.oracle)
      countOracle(frame, timeS_, settings_.shading, settings_.model.seenOn(), settings_.rule, levels_, out);
    out.push_back({"distance_factor", factor_});
    return out;
  }

 private:
  static scene::LodView viewAt(const frame::Frame& frame, double timeS) {
    return {frame.scene().camera.at(timeS), frame.sizePx().y};
  }
  /// What lod/perceptual draws in its first frame. In a separate frame, whose memory is freed with it.
  uint64_t perceptualTriangles(frame::Frame& frame) const {
    frame::Frame own(frame.context(), frame.scene(), frame.gpuScene(), frame.sizePx(), frame.timeS(),
                     frame.raster());
    PerceptualPipeline pipeline(own, settings_);
    for (int n = settings_.settleFrames; n >= 0; --n)
      pipeline.render(frame.timeS() - n * settings_.frameStepS, true);
    return scene::triangleCount(frame.scene(), pipeline.shown());
  }

  PerceptualLodSettings settings_;
  decltype(MatchedSettings::budget) budget_;
  double factor_ = 1.0, timeS_ = 0.0;
  int64_t rendered_ = 0;
  std::optional<LevelView> view_;
  std::vector<int> levels_;
  const gl::Texture* product_ = nullptr;
};

std::vector<Quantity> matchedQuantities() {
  std::vector<Quantity> out = levelQuantities();
  out.emplace_back("distance_factor", "Factor of the switch distances", "", Direction::Neither);
  return out;
}

const RegisteredTechnique<DistanceMatched> kDistanceMatchedRegistered{
    {.name = "lod/distance_matched",
     .version = 1,
     .summary = "Levels by distance only, scaled to draw no fewer triangles than lod/perceptual",
     .source = "Schwarz 2009, section 9.5, Fig. 9.8 (SP-38)",
     .product = ProductKind::Colour,
     .needs = {"lod_sets"},
     .counters = matchedQuantities()}};

}  // namespace
}  // namespace limen::techniques
