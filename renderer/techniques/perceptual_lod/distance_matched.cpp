// SPDX-License-Identifier: BSD-3-Clause
// Levels by distance only, at the cost of lod/perceptual (SP-38): the scene's switch distances are multiplied
// by one factor. The cost is either triangles: the smallest factor with which at least as many are drawn as
// lod/perceptual draws in its first frame with the same parameters, so that whatever lod/perceptual does
// better, it does with no more triangles in the picture. Or it is the frame's time, tests included: the
// largest factor whose frames take no longer than those of lod/perceptual. Source: Schwarz 2009, Fig. 9.8,
// which compares at "roughly the same frame rate". Both searches are part of the preparation.
#include "renderer/techniques/perceptual_lod/distance_matched.h"

#include <algorithm>
#include <optional>

#include "renderer/techniques/perceptual_lod/frame_timing.h"
#include "renderer/techniques/perceptual_lod/oracle.h"
#include "renderer/techniques/perceptual_lod/pipeline.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

std::vector<double> matchingFactors(const scene::Scene& scene, const scene::LodView& view) {
  // The selection changes only where an object's distance equals one of its switch distances times the
  // factor: just above that quotient the object is finer.
  std::vector<double> factors = {0.0};
  for (const scene::LodObject& object : scene.lodObjects)
    for (const double from : object.switchDistances)
      if (from > 0.0) factors.push_back(scene::viewDistance(object, view.camera) / from * (1.0 + 1e-9));
  std::sort(factors.begin(), factors.end());
  factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
  return factors;
}

double factorForTriangles(const scene::Scene& scene, const scene::LodView& view, uint64_t triangles) {
  const std::vector<double> factors = matchingFactors(scene, view);
  const auto enough = [&](double factor) {
    return scene::triangleCount(scene, scene::levelsByDistance(scene, view, factor)) >= triangles;
  };
  const auto found =
      std::partition_point(factors.begin(), factors.end(), [&](double factor) { return !enough(factor); });
  return found == factors.end() ? factors.back() : *found;
}

TimedFactor factorForTime(const std::vector<double>& factors, double limitMs,
                          const std::function<double(double factor)>& frameMs) {
  // The finest first: often it is cheap enough.
  TimedFactor best{factors.back(), frameMs(factors.back())};
  if (best.frameMs <= limitMs || factors.size() == 1) return best;
  best = {factors.front(), frameMs(factors.front())};
  size_t low = 0, high = factors.size() - 1;  // within the limit (or the first), and beyond it
  while (high - low > 1) {
    const size_t middle = (low + high) / 2;
    const double ms = frameMs(factors[middle]);
    if (ms <= limitMs) {
      low = middle;
      best = {factors[middle], ms};
    } else {
      high = middle;
    }
  }
  return best;
}

namespace {

struct MatchTriangles {
  static constexpr const char *kKind = "triangles",
                              *kSummary = "no fewer triangles than lod/perceptual with the same settings";
};

struct MatchFrameTime {
  static constexpr const char *kKind = "frame_time",
                              *kSummary =
                                  "frames no longer than those of lod/perceptual with the same settings";
  int frames = 32;
  static const SettingsTable<MatchFrameTime>& table() {
    static const SettingsTable<MatchFrameTime> kTable = {
        {&MatchFrameTime::frames,
         "frames",
         {2, 1024},
         "frames",
         "Frames that are timed for lod/perceptual and for each factor tried"}};
    return kTable;
  }
};

struct MatchCount {
  static constexpr const char *kKind = "count", *kSummary = "no fewer triangles than given";
  int64_t count = 100000;
  static const SettingsTable<MatchCount>& table() {
    static const SettingsTable<MatchCount> kTable = {Binding(&MatchCount::count, "count",
                                                             Range{1, 4'000'000'000.0}, "triangles",
                                                             "Triangles, including the background")
                                                         .formerly({"triangle_budget"})};
    return kTable;
  }
};

struct MatchedSettings {
  std::variant<MatchTriangles, MatchFrameTime, MatchCount> match;
  PerceptualLodSettings perceptual;
  static const SettingsTable<MatchedSettings>& table() {
    using S = MatchedSettings;
    static const SettingsTable<S> kTable = {Binding(&S::match, "match", "What the levels' cost is matched to",
                                                    "Schwarz 2009, Fig. 9.8 (frame rate)")
                                                .formerly({"budget"}),
                                            included(&S::perceptual)};
    return kTable;
  }
};

class DistanceMatched : public Technique {
 public:
  using Settings = MatchedSettings;
  explicit DistanceMatched(const MatchedSettings& settings)
      : settings_(settings.perceptual), match_(settings.match) {}

  void prepare(frame::Frame& frame) override {
    const scene::LodView view = viewAt(frame, frame.timeS());
    if (const auto* time = std::get_if<MatchFrameTime>(&match_)) {
      matchTime(frame, view, {4, time->frames});
    } else {
      const auto* given = std::get_if<MatchCount>(&match_);
      const uint64_t triangles = given ? static_cast<uint64_t>(given->count) : perceptualTriangles(frame);
      factor_ = factorForTriangles(frame.scene(), view, triangles);
    }
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
    if (perceptualMs_ > 0.0) out.push_back({"perceptual_frame_ms", perceptualMs_});
    return out;
  }

 private:
  static scene::LodView viewAt(const frame::Frame& frame, double timeS) {
    return {frame.scene().camera.at(timeS), frame.sizePx().y};
  }
  /// Runs lod/perceptual up to its first frame, in a separate frame, whose memory is freed with it.
  struct Perceptual {
    Perceptual(frame::Frame& like, const PerceptualLodSettings& settings)
        : frame(like.context(), like.scene(), like.gpuScene(), like.sizePx(), like.timeS(), like.raster()),
          pipeline(frame, settings) {
      pipeline.prime(like.timeS());
      for (int n = settings.settleFrames; n >= 0; --n)
        pipeline.render(like.timeS() - n * settings.frameStepS, true);
    }
    frame::Frame frame;
    PerceptualPipeline pipeline;
  };

  uint64_t perceptualTriangles(frame::Frame& frame) const {
    return scene::triangleCount(frame.scene(), Perceptual(frame, settings_).pipeline.shown());
  }

  void matchTime(frame::Frame& frame, const scene::LodView& view, const TimedFrames& timed) {
    {
      Perceptual perceptual(frame, settings_);
      int64_t frames = 0;
      const auto render = [&] {
        perceptual.pipeline.render(frame.timeS() + static_cast<double>(frames++) * settings_.frameStepS,
                                   settings_.tests.wait);
      };
      wakeUp(perceptual.frame, render);
      frames = 0;
      perceptualMs_ = medianFrameMs(perceptual.frame, render, timed);
    }
    frame::Frame own(frame.context(), frame.scene(), frame.gpuScene(), frame.sizePx(), frame.timeS(),
                     frame.raster());
    LevelView tried(own, "distance");
    const auto frameMs = [&](double factor) {
      int64_t frames = 0;
      const auto render = [&] {
        const double timeS = frame.timeS() + static_cast<double>(frames++) * settings_.frameStepS;
        const scene::LodSelection chosen =
            scene::levelsByDistance(frame.scene(), viewAt(frame, timeS), factor);
        tried.show(timeS, chosen).get<frame::Shaded>(settings_.shading);
      };
      return medianFrameMs(own, render, timed);
    };
    factor_ = factorForTime(matchingFactors(frame.scene(), view), perceptualMs_, frameMs).factor;
  }

  PerceptualLodSettings settings_;
  decltype(MatchedSettings::match) match_;
  double factor_ = 1.0, timeS_ = 0.0;
  double perceptualMs_ = 0.0;  ///< 0: not matched
  int64_t rendered_ = 0;
  std::optional<LevelView> view_;
  std::vector<int> levels_;
  const gl::Texture* product_ = nullptr;
};

std::vector<Quantity> matchedQuantities() {
  std::vector<Quantity> out = levelQuantities();
  out.emplace_back("distance_factor", "Factor of the switch distances", "", Direction::Neither);
  out.emplace_back("perceptual_frame_ms", "Frame of lod/perceptual that was matched", "ms",
                   Direction::Neither);
  return out;
}

const RegisteredTechnique<DistanceMatched> kDistanceMatchedRegistered{
    {.name = "lod/distance_matched",
     .version = 3,
     .summary = "Levels by distance only, scaled to the triangles or the frame time of lod/perceptual",
     .source = "Schwarz 2009, section 9.5, Fig. 9.8 (SP-38)",
     .product = ProductKind::Colour,
     .needs = {"lod_sets"},
     .counters = matchedQuantities()}};

}  // namespace
}  // namespace limen::techniques
