// SPDX-License-Identifier: BSD-3-Clause
// Irradiance volume (experimental): one bounce of light from a lattice of probes, each of which looks all
// around by two views that are drawn from cuts for all of them. Light between probes is interpolated whatever
// lies between: it leaks through walls thinner than the lattice, and a probe within an object is dark.
// Source: Holländer 2013, section 6.2 (named); Greger and others 1998; harmonics: Ramamoorthi and Hanrahan
// 2001.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/many_lods/node_predicate.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/many_lods/lit_points.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"
#include "renderer/techniques/many_lods/scene_tree.h"

namespace limen::techniques {
namespace {

constexpr const char *kProbePass = "many_lods/probe_light", *kProbeShadePass = "many_lods/probe_shade";

struct VolumeSettings {
  double gain = 10.0;
  int probes = 8;
  int tilePx = 16;
  double nearest = 1.0;
  TreeSettings tree;
  many_lods::CutMode cuts;
  CutLimits limits{2.0, 4096};
  static const SettingsTable<VolumeSettings>& table() {
    using S = VolumeSettings;
    static const SettingsTable<S> kTable = {
        {&S::gain, "gain", {0.0, 1000.0}, "", "Factor on the light, for pictures of a useful brightness"},
        {&S::probes,
         "probes",
         {2, 64},
         "",
         "Probes along the scene's longest side; as far apart along the others",
         "Holländer 2013, section 6.2 (n^3; no value)"},
        {&S::tilePx, "tile", {4, 64}, "px", "Side of each of a probe's two views"},
        {&S::nearest, "nearest", {0.0, 64.0}, "", "Nodes nearer than this are not seen, radii of leaves"},
        included(&S::tree),
        {&S::cuts, "cuts", kCutsText, kCutsSource},
        included(&S::limits)};
    return kTable;
  }
};

class IrradianceVolume : public Technique {
 public:
  using Settings = VolumeSettings;
  explicit IrradianceVolume(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    tree_.emplace(frame, settings_.tree);
    light_.emplace(frame, tree_->tree());
    placeProbes(frame);
    const auto count = static_cast<uint32_t>(2 * probeCount());
    cut_.emplace(tree_->cutsFor(frame, count, settings_.limits, settings_.cuts));
    atlas_.emplace(frame.context(), count, glm::ivec2(settings_.tilePx), many_lods::AtlasForm::Wide,
                   settings_.tree.discs);
    probes_.emplace(int64_t{16} * kProbeTerms * probeCount(), nullptr);
    const std::string folder = "renderer/techniques/many_lods/irradiance_volume/";
    gather_ = &frame.context().programs().compute(
        folder + "probe_light.comp.glsl", {{"FORM", std::to_string(static_cast<int>(atlas_->form()))}});
    shade_ = &frame.context().programs().compute(folder + "probe_shade.comp.glsl");
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kCutsPass, cut_->bytes());
    frame.passes().setBytesHeld(kSplatPass, atlas_->bytes());
    frame.passes().setBytesHeld(kProbePass, probes_->bytes());
    frame.passes().setBytesHeld(kProbeShadePass, picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    tree_->update(frame);
    light_->make(frame, tree_->tree(), settings_.gain);
    findCuts(frame, false);
    {
      const auto scope = frame.passes().open(kSplatPass);
      atlas_->draw(*cut_, tree_->tree().nodes(), *views_, tree_->discs(settings_.nearest));
    }
    {
      const auto scope = frame.passes().open(kProbePass);
      light_->bind(tree_->tree(), *atlas_);
      views_->bindStorage(kGatherViewsBuffer);
      probes_->bindStorage(kProbesBuffer);
      gather_->set("side", settings_.tilePx);
      gather_->set("probeCount", static_cast<uint32_t>(probeCount()));
      gather_->use();
      glDispatchCompute(static_cast<uint32_t>(std::min(probeCount(), 65535)), 1, 1);
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    const auto channel = [&](frame::Channel of) -> const gl::Texture& {
      return frame.get<frame::GBufferChannel>(frame::ChannelSetting{of}).texture();
    };
    const gl::Texture& positions = channel(frame::Channel::Position);
    const gl::Texture& normals = channel(frame::Channel::Normal);
    const gl::Texture& albedos = channel(frame::Channel::Albedo);
    const auto scope = frame.passes().open(kProbeShadePass);
    positions.bindTexture(kGatherPositionsUnit);
    normals.bindTexture(kGatherNormalsUnit);
    albedos.bindTexture(kGatherAlbedosUnit);
    probes_->bindStorage(kProbesBuffer);
    picture_->bindImage(kProbeImage, gl::Access::Write);
    shade_->set("sizePx", frame.sizePx());
    shade_->set("gridLow", low_);
    shade_->set("gridStep", step_);
    shade_->set("gridCount", glm::vec3(grid_));
    shade_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }
  std::vector<Counter> count(frame::Frame& frame) override {
    findCuts(frame, true);
    return cutCounters(cut_->control(), cut_->viewCount(), *tree_);
  }

 private:
  int probeCount() const { return grid_.x * grid_.y * grid_.z; }

  /// In the middles of cells, so that none lies in a wall of the scene's box.
  void placeProbes(frame::Frame& frame) {
    const scene::Bounds bounds = frame.scene().bounds();
    const glm::dvec3 extent = bounds.high - bounds.low, anchor = frame.gpuScene().anchor();
    const double longest = std::max(extent.x, std::max(extent.y, extent.z));
    for (int axis = 0; axis < 3; ++axis) {
      grid_[axis] =
          longest > 0.0
              ? std::max(static_cast<int>(std::ceil(settings_.probes * extent[axis] / longest - 1e-9)), 1)
              : 1;
      step_[axis] = static_cast<float>(std::max(extent[axis], 1e-6 * std::max(longest, 1e-30)) / grid_[axis]);
    }
    low_ = glm::vec3(bounds.low - anchor) + 0.5F * step_;
    const double range = 1.01 * std::max(frame.gpuScene().diagonal(), 1e-30);
    std::vector<many_lods::CutView> views;
    for (int z = 0; z < grid_.z; ++z)
      for (int y = 0; y < grid_.y; ++y)
        for (int x = 0; x < grid_.x; ++x)
          for (const double up : {1.0, -1.0})
            views.push_back(many_lods::hemisphereView(glm::dvec3(low_ + step_ * glm::vec3(x, y, z)),
                                                      {0.0, up, 0.0}, settings_.tilePx,
                                                      settings_.limits.epsilonPx, range));
    views_.emplace(views);
  }

  void findCuts(frame::Frame& frame, bool counting) {
    const auto scope = frame.passes().open(kCutsPass);
    cut_->update(tree_->tree().nodes(), *views_, counting);
  }

  VolumeSettings settings_;
  glm::ivec3 grid_{1};
  glm::vec3 low_{0.0F}, step_{1.0F};
  std::optional<SceneTree> tree_;
  std::optional<LitPoints> light_;
  std::optional<many_lods::MultiCut> cut_;
  std::optional<many_lods::ViewAtlas> atlas_;
  std::optional<gl::Buffer> views_, probes_;
  const gl::Program *gather_ = nullptr, *shade_ = nullptr;
  std::optional<gl::Texture> picture_;
};

const RegisteredTechnique<IrradianceVolume> kVolumeRegistered{
    {.name = "many_lods/irradiance_volume",
     .version = 1,
     .summary = "Experimental: one bounce of light from a lattice of probes, their views drawn from cuts",
     .source = "Holländer 2013, section 6.2 (HOL-60); Greger and others 1998",
     .product = ProductKind::Colour,
     .needs = {"area_light"},
     .counters = cutQuantities(),
     .effort = "probes"}};

}  // namespace
}  // namespace limen::techniques
