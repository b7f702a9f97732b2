// SPDX-License-Identifier: BSD-3-Clause
// Several views of one camera, fed to the same cuts (experimental): a stereo pair, samples of a lens, samples
// of the time that a shutter is open. The scene stands still meanwhile. Views are drawn from cuts of a tree
// of points, or for comparison by rays. Source: Holländer 2013, section 6.2 (views of these kinds, in words);
// everything else is the bench's own.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "renderer/frame/mirror_trace.h"
#include "renderer/many_lods/node_predicate.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"
#include "renderer/techniques/many_lods/scene_tree.h"

namespace limen::techniques {
namespace {

constexpr const char *kViewsMeanPass = "many_lods/views_mean", *kTracedViewsPass = "many_lods/traced_views",
                     *kViewsSource = "Holländer 2013, section 6.2";

struct StereoPair {
  static constexpr const char *kKind = "stereo", *kSummary = "two eyes' pictures beside each other";
  double separation = 0.05;
  static const SettingsTable<StereoPair>& table() {
    using S = StereoPair;
    static const SettingsTable<S> kTable = {
        {&S::separation,
         "separation",
         {0.0, 1.0},
         "",
         "Distance between the eyes, whose axes are parallel, share of the distance to what is looked at"}};
    return kTable;
  }
};
struct LensSamples {
  static constexpr const char *kKind = "lens", *kSummary = "mean over places on a lens: depth of field";
  double radius = 0.02, focus = 1.0;
  int samples = 16;
  static const SettingsTable<LensSamples>& table() {
    using S = LensSamples;
    static const SettingsTable<S> kTable = {
        {&S::radius,
         "radius",
         {0.0, 0.5},
         "",
         "Radius of the lens, share of the distance to what is looked at"},
        {&S::focus,
         "focus",
         {0.1, 10.0},
         "",
         "Distance of the plane that is sharp, share of the distance to what is looked at"},
        {&S::samples, "samples", {1, 64}, "", "Places on the lens"}};
    return kTable;
  }
};
struct ShutterSamples {
  static constexpr const char *kKind = "shutter",
                              *kSummary = "mean over times: blur by the camera's motion around its target";
  double turnDeg = 2.0;
  int samples = 16;
  static const SettingsTable<ShutterSamples>& table() {
    using S = ShutterSamples;
    static const SettingsTable<S> kTable = {
        {&S::turnDeg,
         "turn",
         {0.0, 90.0},
         "deg",
         "Angle by which the camera goes around what it looks at while the shutter is open"},
        {&S::samples, "samples", {1, 64}, "", "Times"}};
    return kTable;
  }
};
struct SeenPoints {
  static constexpr const char *kKind = "cuts", *kSummary = "from cuts of a tree of points";
  TreeSettings tree;
  many_lods::CutMode cuts;
  CutLimits limits{1.0, 65536};
  static const SettingsTable<SeenPoints>& table() {
    using S = SeenPoints;
    static const SettingsTable<S> kTable = {
        included(&S::tree), {&S::cuts, "cuts", kCutsText, kCutsSource}, included(&S::limits)};
    return kTable;
  }
};
struct SeenTriangles {
  static constexpr const char *kKind = "rays", *kSummary = "by a ray through each pixel's middle";
  static const SettingsTable<SeenTriangles>& table() {
    static const SettingsTable<SeenTriangles> kTable = {};
    return kTable;
  }
};

struct CameraViewsSettings {
  std::variant<StereoPair, LensSamples, ShutterSamples> views;
  std::variant<SeenPoints, SeenTriangles> seen;
  frame::ShadedSetting shading;
  static const SettingsTable<CameraViewsSettings>& table() {
    using S = CameraViewsSettings;
    static const SettingsTable<S> kTable = {{&S::views, "views", "What the views are of", kViewsSource},
                                            {&S::seen, "seen", "How views are drawn"},
                                            frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

/// A pinhole; `shift`: where a point of the picture is in this view, tangents.
struct CameraView {
  glm::dvec3 eye, forwards, up;
  glm::dvec2 shift{0.0};
};

/// Evenly over a disc: Vogel's spiral.
glm::dvec2 onDisc(int i, int count) {
  const double golden = std::acos(-1.0) * (3.0 - std::sqrt(5.0));
  return std::sqrt((i + 0.5) / count) * glm::dvec2(std::cos(golden * i), std::sin(golden * i));
}

std::vector<CameraView> viewsOf(const scene::Camera& camera, const StereoPair& pair) {
  const glm::dvec3 forwards = camera.target - camera.eye;
  const glm::dvec3 right = glm::normalize(glm::cross(forwards, camera.up));
  const glm::dvec3 half = 0.5 * pair.separation * glm::length(forwards) * right;
  return {{camera.eye - half, forwards, camera.up}, {camera.eye + half, forwards, camera.up}};
}
std::vector<CameraView> viewsOf(const scene::Camera& camera, const LensSamples& lens) {
  const glm::dvec3 forwards = camera.target - camera.eye;
  const glm::dvec3 right = glm::normalize(glm::cross(forwards, camera.up));
  const glm::dvec3 up = glm::normalize(glm::cross(right, forwards));
  const double distance = glm::length(forwards);
  std::vector<CameraView> out;
  for (int i = 0; i < lens.samples; ++i) {
    const glm::dvec2 at = lens.radius * distance * onDisc(i, lens.samples);
    // What is in focus stays where it is in the picture.
    out.push_back({camera.eye + at.x * right + at.y * up, forwards, camera.up,
                   -glm::dvec2(at.x, -at.y) / (lens.focus * distance)});
  }
  return out;
}
std::vector<CameraView> viewsOf(const scene::Camera& camera, const ShutterSamples& shutter) {
  std::vector<CameraView> out;
  for (int i = 0; i < shutter.samples; ++i) {
    const double angle = glm::radians(shutter.turnDeg) * ((i + 0.5) / shutter.samples - 0.5);
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(camera.up)));
    const glm::dvec3 forwards = turn * (camera.target - camera.eye);
    out.push_back({camera.target - forwards, forwards, camera.up});
  }
  return out;
}

class CameraViews : public Technique {
 public:
  using Settings = CameraViewsSettings;
  explicit CameraViews(const CameraViewsSettings& settings)
      : settings_(settings), points_(std::get_if<SeenPoints>(&settings_.seen)) {}

  void prepare(frame::Frame& frame) override {
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    gl::ShaderDefines defines;
    if (sideBySide()) defines["SIDE_BY_SIDE"] = "1";
    viewRows_.emplace(gl::Format::RGBA32F, glm::ivec2(4, viewCount()));
    if (points_) {
      tree_.emplace(frame, points_->tree);
      light_.emplace(frame, tree_->tree(), settings_.shading);
      const auto count = static_cast<uint32_t>(viewCount());
      cut_.emplace(tree_->cutsFor(frame, count, points_->limits, points_->cuts));
      atlas_.emplace(frame.context(), count, tilePx(frame), many_lods::AtlasForm::Wide, points_->tree.discs);
      views_.emplace(count * int64_t{sizeof(many_lods::CutView)}, nullptr);
      defines["FORM"] = std::to_string(static_cast<int>(atlas_->form()));
      program_ = &frame.context().programs().compute(
          "renderer/techniques/many_lods/camera_views/views_mean.comp.glsl", defines);
      frame.passes().setBytesHeld(kCutsPass, cut_->bytes());
      frame.passes().setBytesHeld(kSplatPass, atlas_->bytes());
    } else {
      defines.merge(frame::mirrorTraceDefines(settings_.shading, frame));
      program_ = &frame.context().programs().compute(
          "renderer/techniques/many_lods/camera_views/traced_views.comp.glsl", defines);
    }
    frame.passes().setBytesHeld(points_ ? kViewsMeanPass : kTracedViewsPass, picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    placeViews(frame);
    if (points_) {
      tree_->update(frame);
      light_->make(frame, tree_->tree());
      findCuts(frame, false);
      const auto scope = frame.passes().open(kSplatPass);
      atlas_->draw(*cut_, tree_->tree().nodes(), *views_, tree_->discs(0.0));
    }
    const auto scope = frame.passes().open(points_ ? kViewsMeanPass : kTracedViewsPass);
    if (points_) {
      atlas_->depths().bindStorage(kPointsDepthsBuffer);
      if (atlas_->form() != many_lods::AtlasForm::Wide) atlas_->winners().bindStorage(kPointsWinnersBuffer);
      light_->values().bindStorage(kPointsColoursBuffer);
    } else {
      frame::configureMirrorTrace(*program_, frame, settings_.shading);
    }
    viewRows_->bindTexture(kCameraViewsUnit);
    picture_->bindImage(kPointsImage, gl::Access::Write);
    program_->set("sizePx", frame.sizePx());
    program_->set("tilePx", tilePx(frame));
    program_->set("viewCount", viewCount());
    program_->set("tangents", glm::vec2(tangents(frame)));
    program_->set("backdrop", glm::vec3(static_cast<float>(settings_.shading.background)));
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    if (!points_) return {};
    findCuts(frame, true);
    return cutCounters(cut_->control(), cut_->viewCount(), *tree_);
  }

 private:
  bool sideBySide() const { return std::holds_alternative<StereoPair>(settings_.views); }
  int viewCount() const {
    if (const auto* lens = std::get_if<LensSamples>(&settings_.views)) return lens->samples;
    if (const auto* shutter = std::get_if<ShutterSamples>(&settings_.views)) return shutter->samples;
    return 2;
  }
  /// With a margin for what a lens's views shift.
  glm::ivec2 tilePx(const frame::Frame& frame) const {
    glm::ivec2 out = frame.sizePx();
    if (sideBySide()) out.x = std::max(out.x / 2, 1);
    if (const auto* lens = std::get_if<LensSamples>(&settings_.views)) {
      const double mostPx = lens->radius / lens->focus / frame.tanHalfFov() * 0.5 * frame.sizePx().y;
      out += 2 * static_cast<int>(std::ceil(mostPx) + 1.0);
    }
    return out;
  }
  /// Of half a tile's field of view.
  glm::dvec2 tangents(const frame::Frame& frame) const {
    return frame.tanHalfFov() * glm::dvec2(tilePx(frame)) / double(frame.sizePx().y);
  }

  void placeViews(frame::Frame& frame) {
    const std::vector<CameraView> views =
        std::visit([&](const auto& kind) { return viewsOf(frame.camera(), kind); }, settings_.views);
    const glm::dvec3 anchor = frame.gpuScene().anchor();
    for (size_t i = 0; i < views.size(); ++i) {
      const CameraView& view = views[i];
      const double range = glm::length(view.eye - anchor) + frame.gpuScene().diagonal();
      const many_lods::CutView placed =
          many_lods::perspectiveView(view.eye - anchor, view.forwards, -view.up, tangents(frame),
                                     tilePx(frame).y, points_ ? points_->limits.epsilonPx : 1.0, range);
      if (points_) views_->write(static_cast<int64_t>(i * sizeof placed), sizeof placed, &placed);
      for (int c = 0; c < 3; ++c) {
        const auto row = static_cast<int>(i);
        rows_.at(0, row, c) = placed.eye[c];
        rows_.at(1, row, c) = placed.axisX[c];
        rows_.at(2, row, c) = placed.axisY[c];
        rows_.at(3, row, c) = placed.axisZ[c];
      }
      rows_.at(0, static_cast<int>(i), 3) = static_cast<float>(view.shift.x);
      rows_.at(1, static_cast<int>(i), 3) = static_cast<float>(view.shift.y);
    }
    viewRows_->write(rows_);
  }

  void findCuts(frame::Frame& frame, bool counting) {
    const auto scope = frame.passes().open(kCutsPass);
    cut_->update(tree_->tree().nodes(), *views_, counting);
  }

  CameraViewsSettings settings_;
  const SeenPoints* points_;
  Image rows_{4, viewCount(), 4};
  std::optional<SceneTree> tree_;
  std::optional<TreeLight> light_;
  std::optional<many_lods::MultiCut> cut_;
  std::optional<many_lods::ViewAtlas> atlas_;
  std::optional<gl::Buffer> views_;
  std::optional<gl::Texture> picture_, viewRows_;
  const gl::Program* program_ = nullptr;
};

const RegisteredTechnique<CameraViews> kCameraViewsRegistered{
    {.name = "many_lods/camera_views",
     .version = 1,
     .summary = "Experimental: a stereo pair, depth of field or motion blur from cuts for several views of a "
                "camera",
     .source = "Holländer 2013, section 6.2 (HOL-60)",
     .product = ProductKind::Colour,
     .counters = cutQuantities()}};

}  // namespace
}  // namespace limen::techniques
