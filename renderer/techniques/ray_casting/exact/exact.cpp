// SPDX-License-Identifier: BSD-3-Clause
// Curved surfaces by casting a ray through each pixel's centre on the CPU, in double precision (SC-33):
// Bézier clipping (Nishita et al. 1990), subdivision by convex hulls, or interval arithmetic, which is proven
// to miss no root (SC-28). Schwarz 2009, sections 6.4.1 and 6.5.1, names the families. Weights of rational
// patches must be positive.
#include "renderer/techniques/ray_casting/hit_counters.h"
#include "renderer/techniques/ray_casting/seen_picture.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/surface_view.h"
#include "renderer/techniques/tessellation/trim_settings.h"

namespace limen::techniques {
namespace {

struct ExactRaysSettings {
  surfaces::RootFinder roots = surfaces::RootFinder::Clipping;
  double tolerancePx = 1e-4;
  std::variant<TrimByCurves, TrimByTexture> trims;
  bool check = false;
  frame::ShadedSetting shading;
  static const SettingsTable<ExactRaysSettings>& table() {
    using S = ExactRaysSettings;
    static const SettingsTable<S> kTable = {
        {&S::roots, "roots", "How intersections are found"},
        {&S::tolerancePx,
         "tolerance_px",
         {1e-9, 1},
         "px",
         "Distance from the ray that counts as a hit, where the surface is nearest"},
        {&S::trims, "trims", "Where trimmed surfaces are looked up", "Schwarz 2009, section 6.1.4"},
        {&S::check, "check", "Compare all pixels with interval arithmetic when counting"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class ExactRays : public Technique {
 public:
  using Settings = ExactRaysSettings;
  explicit ExactRays(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    for (const glm::dvec4& p : frame.scene().surfaces.points)
      if (!(p.w > 0.0))
        throw Error("the scene has a control point whose weight is not positive", "scene",
                    "exact ray casting relies on the hulls of control points");
    set_ = surfaces::movedTo(frame.scene().surfaces, frame.timeS());
    makeTracer();
    picture_.emplace(frame, settings_.shading, "ray_casting");
  }

  void render(frame::Frame& frame) override {
    const scene::Scene& scene = frame.scene();
    if (scene.surfaces.motion.moves()) {
      set_ = surfaces::movedTo(scene.surfaces, frame.timeS());
      makeTracer();
    }
    exact_ = exactView(set_, *tracer_, viewOf(frame), frame.sizePx(), settings_.tolerancePx);
    picture_->write(scene, exact_);
    picture_->render(frame);
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    double hits = 0.0;
    for (const ExactPixel& pixel : exact_.pixels) hits += pixel.hit;
    std::vector<Counter> out = {
        {"root_steps_per_px", double(exact_.counts.steps) / double(exact_.pixels.size())},
        {"root_splits_per_px", double(exact_.counts.splits) / double(exact_.pixels.size())},
        {"duplicate_roots", double(exact_.counts.duplicates)},
        {"false_roots", double(exact_.counts.falseReports)},
        {"unproven_roots", double(exact_.counts.unproven)}};
    if (settings_.check) {
      std::ranges::copy(hitCounters(frame, picture_->normals().read()), std::back_inserter(out));
    } else {
      out.push_back({"surface_px", hits});
    }
    return out;
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    return withHitQuantities(
        {{"root_steps_per_px", "Clips, or parts looked at", "steps/px", lower},
         {"root_splits_per_px", "Halvings where clipping did not get on", "splits/px", lower},
         {"duplicate_roots", "Roots found more than once, and dropped", "roots", lower},
         {"false_roots", "Reports that are no root, and dropped", "roots", lower},
         {"unproven_roots", "Roots of interval arithmetic that may only touch", "roots", lower}});
  }

 private:
  void makeTracer() {
    const auto* texture = std::get_if<TrimByTexture>(&settings_.trims);
    tracer_.emplace(set_, settings_.roots,
                    texture ? surfaces::TrimTest(set_, texture->mask()) : surfaces::TrimTest(set_));
  }

  Settings settings_;
  surfaces::PatchSet set_;  // at the frame's time
  std::optional<surfaces::PatchTracer> tracer_;
  std::optional<SeenPicture> picture_;
  ExactView exact_;
};

const RegisteredTechnique<ExactRays> kExactRaysRegistered{
    {.name = "ray_casting/exact",
     .version = 3,
     .summary = "Curved surfaces by casting rays on the CPU in double precision, by Bézier clipping, hulls "
                "or intervals",
     .source = "Nishita, Sederberg and Kakimoto 1990; Schwarz 2009, section 6.5.1 (SC-28, SC-33)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .reference = true,
     .onCpu = true,
     .counters = ExactRays::quantities()}};

}  // namespace
}  // namespace limen::techniques
