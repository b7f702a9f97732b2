// SPDX-License-Identifier: BSD-3-Clause
// Receivers that look around: a small view from what every so many pixels see, its cut drawn from the tree of
// points, and the mean of what it holds by the cosine. With light at the points that is one bounce of light
// (point-based global illumination); with nothing but their presence it is ambient occlusion. Receivers
// between are filled in by a bilateral filter. Source: Holländer 2013, section 3.6.1; projection, lift and
// the filter's weights are the bench's own.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/many_lods/lit_points.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"
#include "renderer/techniques/many_lods/receiver_surface.h"
#include "renderer/techniques/many_lods/scene_tree.h"

namespace limen::techniques {
namespace {

constexpr const char *kReceiversPass = "many_lods/receivers", *kGatherPass = "many_lods/gather",
                     *kUpsamplePass = "many_lods/upsample";
const std::string kGatheringFolder = "renderer/techniques/many_lods/gathering/";

struct ReceiverSettings {
  TreeSettings tree;
  many_lods::CutMode cuts;
  CutLimits limits{1.0, 4096};
  int tilePx = 16;
  int spacing = 1;
  double lift = 0.5;
  double nearest = 0.5;
  double normalPower = 8.0;
  double planeTolerance = 0.01;
  static const SettingsTable<ReceiverSettings>& table() {
    using S = ReceiverSettings;
    static const SettingsTable<S> kTable = {
        included(&S::tree),
        {&S::cuts, "cuts", kCutsText, kCutsSource},
        included(&S::limits),
        {&S::tilePx, "tile", {4, 64}, "px", "Side of a receiver's view", "Holländer 2013, table 3.3 (32)"},
        {&S::spacing,
         "spacing",
         {1, 32},
         "px",
         "Distance between receivers; those between are interpolated",
         "Holländer 2013, section 3.6.1"},
        {&S::lift, "lift", {0.0, 64.0}, "", "Height of a view above its surface, radii of leaves"},
        {&S::nearest, "nearest", {0.0, 64.0}, "", "Nodes nearer than this are not seen, radii of leaves"},
        {&S::normalPower,
         "normal_power",
         {0.0, 256.0},
         "",
         "Exponent of the cosine between a pixel's normal and a receiver's"},
        {&S::planeTolerance,
         "plane_tolerance",
         {0.0001, 1.0},
         "",
         "Distance of a receiver from a pixel's plane at which its weight is 1 / e, share of the scene's "
         "diagonal"}};
    return kTable;
  }
};

/// Occlusion: the radius. Light: what the light is scaled by.
struct GatheredOcclusion {
  double radius = 1.0;
  static const SettingsTable<GatheredOcclusion>& table() {
    static const SettingsTable<GatheredOcclusion> kTable = {
        {&GatheredOcclusion::radius,
         "radius",
         {0.0001, 10.0},
         "",
         "Distance beyond which nothing occludes, share of the scene's diagonal"}};
    return kTable;
  }
};
struct GatheredLight {
  double gain = 10.0;
  ReceiverSurface surface;
  static const SettingsTable<GatheredLight>& table() {
    static const SettingsTable<GatheredLight> kTable = {
        {&GatheredLight::gain,
         "gain",
         {0.0, 1000.0},
         "",
         "Factor on the light, for pictures of a useful brightness"},
        {&GatheredLight::surface, "receivers", kReceiverText}};
    return kTable;
  }
};

template <class Part>
struct GatheringSettings {
  Part part;
  ReceiverSettings receivers;
  static const SettingsTable<GatheringSettings>& table() {
    using S = GatheringSettings;
    static const SettingsTable<S> kTable = {included(&S::part), included(&S::receivers)};
    return kTable;
  }
};

template <class Part>
class Gathering : public Technique {
 public:
  using Settings = GatheringSettings<Part>;
  static constexpr bool kLight = std::is_same_v<Part, GatheredLight>;
  explicit Gathering(const Settings& settings) : settings_(settings), receivers_(settings.receivers) {}

  void prepare(frame::Frame& frame) override {
    tree_.emplace(frame, receivers_.tree);
    grid_ = (frame.sizePx() + receivers_.spacing - 1) / receivers_.spacing;
    const auto views = static_cast<uint32_t>(grid_.x * grid_.y);
    cut_.emplace(tree_->cutsFor(frame, views, receivers_.limits, receivers_.cuts));
    atlas_.emplace(frame.context(), views, glm::ivec2(receivers_.tilePx),
                   kLight ? many_lods::AtlasForm::Wide : many_lods::AtlasForm::Depth, receivers_.tree.discs);
    views_.emplace(views * int64_t{sizeof(many_lods::CutView)}, nullptr);
    gathered_.emplace(views * int64_t{kLight ? 32 : 16}, nullptr);
    gl::ProgramCache& cache = frame.context().programs();
    gl::ShaderDefines defines = {{"FORM", std::to_string(static_cast<int>(atlas_->form()))}};
    if (kLight) defines["LIGHT"] = "1";
    receiver_ = &cache.compute(kGatheringFolder + "receiver_views.comp.glsl");
    gather_ = &cache.compute(kGatheringFolder + "gather.comp.glsl", defines);
    upsample_ = &cache.compute(kGatheringFolder + "upsample.comp.glsl", defines);
    if (kLight) light_.emplace(frame, tree_->tree());
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kReceiversPass, views_->bytes());
    frame.passes().setBytesHeld(kCutsPass, cut_->bytes());
    frame.passes().setBytesHeld(kSplatPass, atlas_->bytes());
    frame.passes().setBytesHeld(kGatherPass, gathered_->bytes());
    frame.passes().setBytesHeld(kUpsamplePass, picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    tree_->update(frame);
    if constexpr (kLight) light_->make(frame, tree_->tree(), settings_.part.gain);
    findCuts(frame, false);
    {
      const auto scope = frame.passes().open(kSplatPass);
      atlas_->draw(*cut_, tree_->tree().nodes(), *views_, tree_->discs(receivers_.nearest));
    }
    gather(frame);
    const gl::Texture& positions = channel(frame, frame::Channel::Position);
    const gl::Texture& normals = channel(frame, frame::Channel::Normal);
    const gl::Texture& albedos = channel(frame, frame::Channel::Albedo);
    const auto scope = frame.passes().open(kUpsamplePass);
    positions.bindTexture(kGatherPositionsUnit);
    normals.bindTexture(kGatherNormalsUnit);
    albedos.bindTexture(kGatherAlbedosUnit);
    gathered_->bindStorage(kGatheredBuffer);
    picture_->bindImage(kGatherImage, gl::Access::Write);
    setGrid(*upsample_, frame);
    if constexpr (kLight) upsample_->set("glossShare", static_cast<float>(settings_.part.surface.gloss));
    upsample_->set("normalPower", static_cast<float>(receivers_.normalPower));
    upsample_->set("planeTolerance",
                   static_cast<float>(receivers_.planeTolerance * frame.gpuScene().diagonal()));
    upsample_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    findCuts(frame, true);
    return cutCounters(cut_->control(), cut_->viewCount(), *tree_);
  }

 private:
  static const gl::Texture& channel(frame::Frame& frame, frame::Channel of) {
    return frame.get<frame::GBufferChannel>(frame::ChannelSetting{of}).texture();
  }
  double range(const frame::Frame& frame) const { return 1.01 * frame.gpuScene().diagonal(); }
  void setGrid(const gl::Program& program, const frame::Frame& frame) const {
    program.set("sizePx", frame.sizePx());
    program.set("gridSize", grid_);
    program.set("spacing", receivers_.spacing);
  }

  void findCuts(frame::Frame& frame, bool counting) {
    const gl::Texture& positions = channel(frame, frame::Channel::Position);
    const gl::Texture& normals = channel(frame, frame::Channel::Normal);
    {
      const auto scope = frame.passes().open(kReceiversPass);
      positions.bindTexture(kGatherPositionsUnit);
      normals.bindTexture(kGatherNormalsUnit);
      views_->bindStorage(kGatherViewsBuffer);
      setGrid(*receiver_, frame);
      receiver_->set("lift", static_cast<float>(receivers_.lift) * tree_->tree().leafRadius());
      const double q = std::max(2.0 * receivers_.tilePx / std::sqrt(8.0) / receivers_.limits.epsilonPx, 1.0);
      receiver_->set("sizeFactor", static_cast<float>(q * q));
      receiver_->set("inverseRange", static_cast<float>(1.0 / range(frame)));
      receiver_->use();
      glDispatchCompute((cut_->viewCount() + kGatherGroup - 1) / kGatherGroup, 1, 1);
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    const auto scope = frame.passes().open(kCutsPass);
    cut_->update(tree_->tree().nodes(), *views_, counting);
  }

  void gather(frame::Frame& frame) {
    const auto scope = frame.passes().open(kGatherPass);
    views_->bindStorage(kGatherViewsBuffer);
    if constexpr (kLight) {
      light_->bind(tree_->tree(), *atlas_);
      configureReceivers(*gather_, frame, settings_.part.surface);
      gather_->set("lift", static_cast<float>(receivers_.lift) * tree_->tree().leafRadius());
    } else {
      atlas_->depths().bindStorage(kGatherDepthsBuffer);
    }
    gathered_->bindStorage(kGatheredBuffer);
    gather_->set("side", receivers_.tilePx);
    gather_->set("viewCount", cut_->viewCount());
    if constexpr (!kLight)
      gather_->set("farthest",
                   static_cast<float>(settings_.part.radius * frame.gpuScene().diagonal() / range(frame)));
    gather_->use();
    glDispatchCompute(std::min(cut_->viewCount(), 65535U), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }

  Settings settings_;
  ReceiverSettings receivers_;
  glm::ivec2 grid_{0};
  std::optional<SceneTree> tree_;
  std::optional<many_lods::MultiCut> cut_;
  std::optional<many_lods::ViewAtlas> atlas_;
  std::optional<LitPoints> light_;
  std::optional<gl::Buffer> views_, gathered_;
  const gl::Program *receiver_ = nullptr, *gather_ = nullptr, *upsample_ = nullptr;
  std::optional<gl::Texture> picture_;
};

const RegisteredTechnique<Gathering<GatheredOcclusion>> kViewOcclusion{
    {.name = "many_lods/ambient_occlusion",
     .version = 2,
     .summary = "Ambient occlusion from a small view at every pixel or every so many, drawn from cuts for "
                "all of them",
     .source = "Holländer 2013, section 3.6.1 (HOL-34)",
     .product = ProductKind::Colour,
     .counters = cutQuantities(),
     .effort = "levels"}};

const RegisteredTechnique<Gathering<GatheredLight>> kPointBasedLight{
    {.name = "many_lods/point_based",
     .version = 2,
     .summary =
         "One bounce of light from a small view at every pixel or every so many, drawn from lit points",
     .source = "Holländer 2013, section 3.6.1 (HOL-28)",
     .product = ProductKind::Colour,
     .needs = {"area_light"},
     .counters = cutQuantities(),
     .effort = "levels"}};

}  // namespace
}  // namespace limen::techniques
