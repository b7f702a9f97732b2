// SPDX-License-Identifier: BSD-3-Clause
// Patches by scan lines on the CPU, in double precision, halved until they are flat quads (SC-36): the one of
// the scan-line family that is robust. Blinn's and Whitted's (in the same paper) find each line's edges and
// silhouettes by Newton steps and miss some. See scan_lines.h.
#include "renderer/techniques/isocurves/scan_lines.h"
#include "renderer/techniques/ray_casting/hit_counters.h"
#include "renderer/techniques/ray_casting/seen_picture.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/patch_buffers.h"
#include "renderer/techniques/tessellation/surface_view.h"

namespace limen::techniques {
namespace {

struct LaneCarpenterSettings {
  double tolerancePx = 0.25;
  bool check = true;
  frame::ShadedSetting shading;
  static const SettingsTable<LaneCarpenterSettings>& table() {
    using S = LaneCarpenterSettings;
    static const SettingsTable<S> kTable = {
        {&S::tolerancePx,
         "tolerance_px",
         {0.01, 16.0},
         "px",
         "Largest distance of a flat part's projected control points from where a quad has them",
         "Schwarz 2009, section 6.5.3"},
        {&S::check, "check", "Compare all pixels with interval arithmetic when counting"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class LaneCarpenter : public Technique {
 public:
  using Settings = LaneCarpenterSettings;
  explicit LaneCarpenter(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    requireDrawn(frame.scene());
    for (const glm::dvec4& p : frame.scene().surfaces.points)
      if (!(p.w > 0.0))
        throw Error("the scene has a control point whose weight is not positive", "scene",
                    "scan lines rely on the hulls of control points");
    picture_.emplace(frame, settings_.shading, "isocurves");
  }

  void render(frame::Frame& frame) override {
    const scene::Scene& scene = frame.scene();
    counts_ = {};
    const ExactView seen =
        scanLineView(scene.surfaces, viewOf(frame), frame.sizePx(), settings_.tolerancePx, counts_);
    picture_->write(scene, seen);
    picture_->render(frame);
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> out = {{"part_splits", double(counts_.splits)},
                                {"flat_parts", double(counts_.polygons)},
                                {"active_most", double(counts_.mostActive)}};
    if (settings_.check)
      std::ranges::copy(hitCounters(frame, picture_->normals().read()), std::back_inserter(out));
    return out;
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    return withHitQuantities({{"part_splits", "Halvings of parts", "", lower},
                              {"flat_parts", "Flat parts", "", lower},
                              {"active_most", "Triangles that a line had at once, most", "", lower}});
  }

 private:
  Settings settings_;
  std::optional<SeenPicture> picture_;
  ScanLineCounts counts_;
};

const RegisteredTechnique<LaneCarpenter> kLaneCarpenterRegistered{
    {.name = "isocurves/lane_carpenter",
     .version = 2,
     .summary = "Patches by scan lines on the CPU, halved until they are flat",
     .source = "Lane, Carpenter, Whitted and Blinn 1980; Schwarz 2009, section 6.5.3 (SC-36)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .onCpu = true,
     .counters = LaneCarpenter::quantities()}};

}  // namespace
}  // namespace limen::techniques
