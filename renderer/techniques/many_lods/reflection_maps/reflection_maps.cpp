// SPDX-License-Identifier: BSD-3-Clause
// A map of its surroundings for each object that reflects or refracts, all of them drawn in every frame from
// cuts of one tree of points, or by rays, which is what maps of triangles hold. A map is two hemispheres
// around the object's middle, without the object. Rays look their light up by direction alone, as the thesis
// does, or by the depths in the map, a few steps. Refracted rays are those behind the first surface. Source:
// Holländer 2013, section 3.6.3; projection and steps are the bench's own (Szirmay-Kalos and others 2005).
#include <epoxy/gl.h>

#include <algorithm>
#include <optional>
#include <variant>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_path.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/mirror_trace.h"
#include "renderer/many_lods/node_predicate.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"
#include "renderer/techniques/many_lods/scene_tree.h"
#include "renderer/techniques/reflections/reflection_picture.h"

namespace limen::techniques {
namespace {

constexpr const char *kMapLookupPass = "many_lods/map_lookup", *kTracedMapsPass = "many_lods/traced_maps";

struct MapCuts {
  static constexpr const char *kKind = "cuts", *kSummary = "from cuts of a tree of points";
  TreeSettings tree;
  many_lods::CutMode cuts;
  CutLimits limits{2.0, 16384};
  static const SettingsTable<MapCuts>& table() {
    using S = MapCuts;
    static const SettingsTable<S> kTable = {
        included(&S::tree), {&S::cuts, "cuts", kCutsText, kCutsSource}, included(&S::limits)};
    return kTable;
  }
};
struct MapRays {
  static constexpr const char *kKind = "rays",
                              *kSummary = "by rays through pixels' middles: what triangles would show";
  static const SettingsTable<MapRays>& table() {
    static const SettingsTable<MapRays> kTable = {};
    return kTable;
  }
};

struct ReflectionMapSettings {
  int tilePx = 64;
  int steps = 0;
  bool refraction = true;
  std::variant<MapCuts, MapRays> maps;
  frame::ShadedSetting shading;
  static const SettingsTable<ReflectionMapSettings>& table() {
    using S = ReflectionMapSettings;
    static const SettingsTable<S> kTable = {
        {&S::tilePx, "tile", {4, 512}, "px", "Side of each of the two hemispheres of a map"},
        {&S::steps,
         "steps",
         {0, 16},
         "",
         "Times that a ray is met with the depths in its map; 0: by its direction alone",
         "Holländer 2013, section 3.6.3 (0)"},
        {&S::refraction, "refraction", frame::kRefractionText, frame::kRefractionSource},
        {&S::maps, "maps", "How maps are drawn"},
        shadingBinding(&S::shading)};
    return kTable;
  }
};

class ReflectionMaps : public Technique {
 public:
  using Settings = ReflectionMapSettings;
  explicit ReflectionMaps(const Settings& settings)
      : settings_(settings),
        cuts_(std::get_if<MapCuts>(&settings_.maps)),
        picture_(settings.shading, settings.refraction) {}

  void prepare(frame::Frame& frame) override {
    findObjects(frame);
    const auto count = static_cast<uint32_t>(views_.size());
    if (cuts_)
      prepareCuts(frame, count);
    else
      prepareRays(frame);
    gl::ShaderDefines defines = {{"FORM", std::to_string(atlas_ ? static_cast<int>(atlas_->form()) : 0)}};
    if (!cuts_) defines["TRACED"] = "1";
    lookup_ = &frame.context().programs().compute(
        "renderer/techniques/many_lods/reflection_maps/reflection_lookup.comp.glsl", defines);
    reflected_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kMapLookupPass, reflected_->bytes());
    picture_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    if (cuts_) {
      tree_->update(frame);
      light_->make(frame, tree_->tree());
      findCuts(frame, false);
      const auto scope = frame.passes().open(kSplatPass);
      many_lods::ViewAtlas::Settings discs = tree_->discs(0.0);
      discs.owners = &*owners_;
      atlas_->draw(*cut_, tree_->tree().nodes(), *viewBuffer_, discs);
    } else {
      traceMaps(frame);
    }
    const frame::MirrorRays& rays = frame::firstRays(frame, settings_.refraction);
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    {
      const auto scope = frame.passes().open(kMapLookupPass);
      viewBuffer_->bindStorage(kMapViewsBuffer);
      if (atlas_) {
        atlas_->depths().bindStorage(kMapDepthsBuffer);
        if (atlas_->form() == many_lods::AtlasForm::TwoPasses)
          atlas_->winners().bindStorage(kMapWinnersBuffer);
        light_->values().bindStorage(kMapColoursBuffer);
      } else {
        maps_->bindTexture(kMapPixelsUnit);
      }
      rays.origins().bindTexture(kMapOriginsUnit);
      rays.directions().bindTexture(kMapDirectionsUnit);
      ids.bindTexture(kMapIdsUnit);
      objects_->bindTexture(kMapObjectsUnit);
      reflected_->bindImage(kMapReflectedImage, gl::Access::Write);
      lookup_->set("sizePx", frame.sizePx());
      lookup_->set("side", settings_.tilePx);
      lookup_->set("steps", settings_.steps);
      lookup_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    picture_.compose(frame, *reflected_);
  }

  const gl::Texture& product() const override { return picture_.texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> out;
    if (cuts_) {
      findCuts(frame, true);
      out = cutCounters(cut_->control(), cut_->viewCount(), *tree_);
    }
    out.push_back({"maps", double(views_.size()) / 2.0});
    return out;
  }

 private:
  bool takesPart(const scene::Material& material) const {
    return material.reflects() || (settings_.refraction && material.refracts());
  }

  void findObjects(frame::Frame& frame) {
    const scene::Scene& scene = frame.scene();
    const double range = 1.01 * frame.gpuScene().diagonal();
    objectOf_.assign(scene.mesh.triangles.size(), 0);
    for (const scene::Part& part : scene.parts) {
      if (!takesPart(scene.materials[part.material])) continue;
      scene::Bounds bounds;
      for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i)
        for (int corner = 0; corner < 3; ++corner)
          bounds.extend(scene.mesh.positions[scene.mesh.triangles[i][corner]]);
      if (bounds.empty()) continue;
      const auto number = static_cast<uint32_t>(views_.size() / 2 + 1);
      std::fill_n(objectOf_.begin() + part.firstTriangle, part.triangleCount, number);
      for (const double up : {1.0, -1.0}) {
        views_.push_back(many_lods::hemisphereView(bounds.centre() - frame.gpuScene().anchor(),
                                                   {0.0, up, 0.0}, settings_.tilePx,
                                                   cuts_ ? cuts_->limits.epsilonPx : 1.0, range));
        views_.back().frustum.w = static_cast<float>(number);
      }
    }
    if (views_.empty())
      throw Error("no part of the scene reflects or lets light through", {},
                  "use a scene with mirrors, or switch 'refraction' on for one with glass");
    viewBuffer_.emplace(views_);
    const int rows = (static_cast<int>(objectOf_.size()) + kMapObjectsWidth - 1) / kMapObjectsWidth;
    objects_.emplace(gl::Format::R32UI, glm::ivec2(kMapObjectsWidth, std::max(rows, 1)));
    std::vector<uint32_t> texels = objectOf_;
    texels.resize(static_cast<size_t>(kMapObjectsWidth) * static_cast<size_t>(std::max(rows, 1)));
    objects_->writeUint(texels);
  }

  void prepareCuts(frame::Frame& frame, uint32_t count) {
    tree_.emplace(frame, cuts_->tree);
    light_.emplace(frame, tree_->tree(), settings_.shading);
    cut_.emplace(tree_->cutsFor(frame, count, cuts_->limits, cuts_->cuts));
    atlas_.emplace(frame.context(), count, glm::ivec2(settings_.tilePx), many_lods::AtlasForm::Wide,
                   cuts_->tree.discs, true);
    // A node belongs to an object if all points below it do.
    const std::vector<many_lods::SurfaceSample> samples =
        tree_->tree().samples().read<many_lods::SurfaceSample>();
    std::vector<uint32_t> owners(2 * samples.size());
    for (size_t i = 0; i < samples.size(); ++i) owners[samples.size() + i] = objectOf_[samples[i].triangle];
    for (size_t i = samples.size() - 1; i > 0; --i)
      owners[i] = owners[2 * i] == owners[2 * i + 1] ? owners[2 * i] : 0;
    owners_.emplace(owners);
    frame.passes().setBytesHeld(kCutsPass, cut_->bytes());
    frame.passes().setBytesHeld(kSplatPass, atlas_->bytes() + owners_->bytes());
  }

  void prepareRays(frame::Frame& frame) {
    const auto count = static_cast<int>(views_.size());
    trace_ = &frame.context().programs().compute(
        "renderer/techniques/many_lods/reflection_maps/traced_maps.comp.glsl",
        frame::mirrorTraceDefines(settings_.shading, frame));
    Image rows(4, count, 4);
    for (int i = 0; i < count; ++i)
      for (int c = 0; c < 3; ++c) {
        const many_lods::CutView& view = views_[static_cast<size_t>(i)];
        rows.at(0, i, c) = view.eye[c];
        rows.at(1, i, c) = view.axisX[c];
        rows.at(2, i, c) = view.axisY[c];
        rows.at(3, i, c) = view.axisZ[c];
      }
    viewRows_.emplace(gl::Format::RGBA32F, glm::ivec2(4, count));
    viewRows_->write(rows);
    maps_.emplace(gl::Format::RGBA32F,
                  settings_.tilePx * glm::ivec2(kMapRow, (count + kMapRow - 1) / kMapRow));
    frame.passes().setBytesHeld(kTracedMapsPass, maps_->bytes());
  }

  void traceMaps(frame::Frame& frame) {
    const auto scope = frame.passes().open(kTracedMapsPass);
    frame::configureMirrorTrace(*trace_, frame, settings_.shading);
    viewRows_->bindTexture(kTracedMapViewsUnit);
    objects_->bindTexture(kMapObjectsUnit);
    maps_->bindImage(kTracedMapImage, gl::Access::Write);
    trace_->set("sizePx", frame.sizePx());
    trace_->set("side", settings_.tilePx);
    trace_->set("inverseRange", views_[0].frustum.z);
    trace_->use();
    glDispatchCompute(
        static_cast<uint32_t>((settings_.tilePx * settings_.tilePx + kGatherGroup - 1) / kGatherGroup),
        static_cast<uint32_t>(views_.size()), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  void findCuts(frame::Frame& frame, bool counting) {
    const auto scope = frame.passes().open(kCutsPass);
    cut_->update(tree_->tree().nodes(), *viewBuffer_, counting);
  }

  ReflectionMapSettings settings_;
  const MapCuts* cuts_;
  ReflectionPicture picture_;
  std::vector<uint32_t> objectOf_;  // of triangles: number from 1, 0: none
  std::vector<many_lods::CutView> views_;
  std::optional<gl::Buffer> viewBuffer_, owners_;
  std::optional<gl::Texture> objects_, reflected_, maps_, viewRows_;
  std::optional<SceneTree> tree_;
  std::optional<TreeLight> light_;
  std::optional<many_lods::MultiCut> cut_;
  std::optional<many_lods::ViewAtlas> atlas_;
  const gl::Program *lookup_ = nullptr, *trace_ = nullptr;
};

std::vector<Quantity> mapQuantities() {
  std::vector<Quantity> out = cutQuantities();
  out.push_back({"maps", "Objects with a map", "", Direction::Neither});
  return out;
}

const RegisteredTechnique<ReflectionMaps> kReflectionMapsRegistered{
    {.name = "many_lods/reflection_maps",
     .version = 1,
     .summary =
         "A map of its surroundings for each object that reflects or refracts, drawn from cuts for all of "
         "them",
     .source = "Holländer 2013, section 3.6.3 (HOL-31, HOL-32)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .counters = mapQuantities(),
     .effort = "tile"}};

}  // namespace
}  // namespace limen::techniques
