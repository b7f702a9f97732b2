// SPDX-License-Identifier: BSD-3-Clause
// Adaptive points in a single view: the cut for the camera, drawn as discs with the mean light of what is
// below each node. Source: Holländer 2013, section 3.6 (table 3.2); projection, depth and light are the
// bench's own.
#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "renderer/many_lods/node_predicate.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"
#include "renderer/techniques/many_lods/scene_tree.h"

namespace limen::techniques {
namespace {

constexpr const char* kResolvePass = "many_lods/resolve";

/// Forms that hold a colour.
enum class PointPixels { Wide, TwoPasses, TwoWords };
constexpr EnumNames<PointPixels, 3> enumNames(PointPixels) {
  return {{{{PointPixels::Wide, "wide"},
            {PointPixels::TwoPasses, "two_passes"},
            {PointPixels::TwoWords, "two_words"}}}};
}

struct PointsSettings {
  // As the thesis draws them: of discs in one plane, two words could not tell the nearest.
  TreeSettings tree{.discs = many_lods::Discs::Spheres};
  bool balanced = true;
  many_lods::CutMode cuts;
  CutLimits limits{1.0, 1048576};
  PointPixels pixels = PointPixels::Wide;
  frame::ShadedSetting shading;
  static const SettingsTable<PointsSettings>& table() {
    using S = PointsSettings;
    static const SettingsTable<S> kTable = {
        included(&S::tree),
        {&S::balanced, "balanced",
         "A complete tree; else one that is split where volumes are least, with links between its nodes",
         "Holländer 2013, section 3.8"},
        {&S::cuts, "cuts", kCutsText, kCutsSource},
        included(&S::limits),
        {&S::pixels, "pixels",
         "What a pixel keeps of the nearest node: both depth and node in 64 bits (two passes where the "
         "driver "
         "has no atomic operations on these), one after the other in two passes, or depth and colour in two "
         "words",
         "Holländer 2013, section 3.7.2 (two_words)"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

many_lods::AtlasForm formOf(PointPixels pixels) {
  switch (pixels) {
    case PointPixels::Wide:
      return many_lods::AtlasForm::Wide;
    case PointPixels::TwoPasses:
      return many_lods::AtlasForm::TwoPasses;
    case PointPixels::TwoWords:
      break;
  }
  return many_lods::AtlasForm::TwoWords;
}

class AdaptivePoints : public Technique {
 public:
  using Settings = PointsSettings;
  explicit AdaptivePoints(const PointsSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    tree_.emplace(frame, settings_.tree, settings_.balanced);
    light_.emplace(frame, tree_->tree(), settings_.shading);
    cut_.emplace(tree_->cutsFor(frame, 1U, settings_.limits, settings_.cuts));
    atlas_.emplace(frame.context(), 1U, frame.sizePx(), formOf(settings_.pixels), settings_.tree.discs);
    views_.emplace(int64_t{sizeof(many_lods::CutView)}, nullptr);
    resolve_ =
        &frame.context().programs().compute("renderer/techniques/many_lods/points/resolve.comp.glsl",
                                            {{"FORM", std::to_string(static_cast<int>(atlas_->form()))}});
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kCutsPass, cut_->bytes());
    frame.passes().setBytesHeld(kSplatPass, atlas_->bytes());
    frame.passes().setBytesHeld(kResolvePass, picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    tree_->update(frame);
    light_->make(frame, tree_->tree());
    findCut(frame, false);
    {
      const auto scope = frame.passes().open(kSplatPass);
      atlas_->draw(*cut_, tree_->tree().nodes(), *views_, tree_->discs(0.0), &light_->values());
    }
    const auto scope = frame.passes().open(kResolvePass);
    atlas_->depths().bindStorage(kPointsDepthsBuffer);
    if (atlas_->form() != many_lods::AtlasForm::Wide) atlas_->winners().bindStorage(kPointsWinnersBuffer);
    light_->values().bindStorage(kPointsColoursBuffer);
    picture_->bindImage(kPointsImage, gl::Access::Write);
    resolve_->set("sizePx", frame.sizePx());
    resolve_->set("background", glm::vec3(static_cast<float>(settings_.shading.background)));
    resolve_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    findCut(frame, true);
    return cutCounters(cut_->control(), 1, *tree_);
  }

  std::vector<std::string> remarks() const override {
    if (atlas_->form() == formOf(settings_.pixels)) return {};
    return {"Nodes were drawn in two passes, as the driver has no atomic operations on 64 bits."};
  }

 private:
  void findCut(frame::Frame& frame, bool counting) {
    const auto scope = frame.passes().open(kCutsPass);
    const scene::Camera& camera = frame.camera();
    const glm::dvec3 anchor = frame.gpuScene().anchor();
    // As far as anything is.
    const double range = glm::length(camera.eye - anchor) + frame.gpuScene().diagonal();
    const many_lods::CutView view =
        many_lods::perspectiveView(camera.eye - anchor, camera.target - camera.eye, -camera.up,
                                   {frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()},
                                   frame.sizePx().y, settings_.limits.epsilonPx, range);
    views_->write(0, sizeof view, &view);
    cut_->update(tree_->tree().nodes(), *views_, counting);
  }

  PointsSettings settings_;
  std::optional<SceneTree> tree_;
  std::optional<TreeLight> light_;
  std::optional<many_lods::MultiCut> cut_;
  std::optional<many_lods::ViewAtlas> atlas_;
  std::optional<gl::Buffer> views_;
  const gl::Program* resolve_ = nullptr;
  std::optional<gl::Texture> picture_;
};

const RegisteredTechnique<AdaptivePoints> kPointsRegistered{
    {.name = "many_lods/points",
     .version = 2,
     .summary = "The scene as points whose density follows their size on the screen, from a tree of spheres",
     .source = "Holländer 2013, sections 3.5 and 3.6 (HOL-33)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = cutQuantities(),
     .effort = "levels"}};

}  // namespace
}  // namespace limen::techniques
