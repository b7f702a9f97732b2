// SPDX-License-Identifier: BSD-3-Clause
// Geomorphing (SP-57; Schwarz 2009, section 2.4): the vertices of a level move in straight lines onto the
// next coarser level while the object recedes, so that geometry does not jump when the level changes.
//
// Terrain and patches morph exactly into their next level if one factor divides the other. Simplified meshes
// have no map of collapsed vertices here: each vertex goes to the nearest point of the next level, whose
// surface the morphed one approaches without being identical to it. Normals and apertures remain those of the
// finer level, so shading still jumps a little at the switch.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/techniques/lod/box_view.h"
#include "renderer/techniques/lod/level_control.h"
#include "renderer/techniques/lod/lod_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kMorphPass = "lod/geomorph";

/// Vertices of one level of one object; group 0 holds everything that never moves.
std::vector<uint32_t> groupsOf(const scene::Scene& scene) {
  std::vector<uint32_t> out(scene.mesh.positions.size() + scene.coarser.positions.size(), 0);
  const auto before = static_cast<uint32_t>(scene.mesh.positions.size());
  uint32_t group = 0;
  for (const scene::LodObject& object : scene.lodObjects)
    for (size_t level = 0; level < object.levels.size(); ++level) {
      ++group;
      const scene::LodLevel& run = object.levels[level];
      const scene::Mesh& mesh = level == 0 ? scene.mesh : scene.coarser;
      for (uint32_t t = run.firstTriangle; t < run.firstTriangle + run.triangleCount; ++t)
        for (int corner = 0; corner < 3; ++corner)
          out[mesh.triangles[t][corner] + (level == 0 ? 0 : before)] = group;
    }
  return out;
}

std::vector<glm::vec3> targetsOf(const scene::Scene& scene, glm::dvec3 anchor) {
  std::vector<glm::vec3> out;
  for (const scene::Mesh* mesh : {&scene.mesh, &scene.coarser})
    for (size_t i = 0; i < mesh->positions.size(); ++i)
      out.emplace_back((mesh->morphTargets.empty() ? mesh->positions[i] : mesh->morphTargets[i]) - anchor);
  return out;
}

size_t groupCount(const scene::Scene& scene) {
  size_t count = 1;
  for (const scene::LodObject& object : scene.lodObjects) count += object.levels.size();
  return count;
}

const char* const kMorphSource = "Schwarz 2009, section 2.4";

struct MorphByDistance {
  static constexpr const char *kKind = "distance", *kSummary = "by the scene's switch distances";
  double factor = 1.0, range = 0.3;
  static const SettingsTable<MorphByDistance>& table() {
    using S = MorphByDistance;
    static const SettingsTable<S> kTable = {
        Binding(&S::factor, "factor", Range{0.001, 1000.0}, "", "Multiplies the scene's switch distances")
            .formerly({"distance_factor"}),
        Binding(&S::range, "range", Range{0.0, 1.0}, "",
                "Final share of the distance to a switch over which a level morphs; 0: hard switches")
            .formerly({"morph_range"})};
    return kTable;
  }
};

struct FixedMorph {
  static constexpr const char *kKind = "fixed", *kSummary = "one level and morph for all objects";
  int level = 0;
  double morph = 0.5;
  static const SettingsTable<FixedMorph>& table() {
    using S = FixedMorph;
    static const SettingsTable<S> kTable = {
        Binding(&S::level, "level", Range{0, 15}, "",
                "Level of all objects, clamped to each object's coarsest")
            .formerly({"level"}),
        Binding(&S::morph, "morph", Range{0.0, 1.0}, "", "Degree of morphing into the next level")
            .formerly({"morph"})};
    return kTable;
  }
};

struct GeomorphSettings {
  std::variant<MorphByDistance, FixedMorph> control;
  int samples = 1;
  frame::ShadedSetting shading;
  static const SettingsTable<GeomorphSettings>& table() {
    using S = GeomorphSettings;
    static const SettingsTable<S> kTable = {
        {&S::control, "control", "How level and morph are determined", kMorphSource},
        samplesBinding(&S::samples),
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class Geomorph : public Technique {
 public:
  using Settings = GeomorphSettings;
  explicit Geomorph(const GeomorphSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    const scene::Scene& scene = frame.scene();
    program_ = &frame.context().programs().compute("renderer/techniques/lod/geomorph/morph.comp.glsl");
    targets_.emplace(targetsOf(scene, frame.gpuScene().anchor()));
    groups_.emplace(groupsOf(scene));
    shares_.emplace(static_cast<int64_t>(groupCount(scene) * sizeof(float)), nullptr);
    moved_.emplace(frame.gpuScene().positions().bytes(), nullptr);
    frame.passes().setBytesHeld(kMorphPass,
                                targets_->bytes() + groups_->bytes() + shares_->bytes() + moved_->bytes());
    view_.emplace(frame, "morphed", settings_.shading, settings_.samples);
    view_->frame().setPositions(&*moved_);
  }

  void render(frame::Frame& frame) override {
    const scene::LodView view{frame.camera(), frame.sizePx().y};
    const scene::LodSelection chosen = levels(frame.scene(), view);
    view_->setLevels(chosen);
    const std::vector<float> shares = sharesOf(frame.scene(), chosen, view);
    shares_->write(0, static_cast<int64_t>(shares.size() * sizeof(float)), shares.data());
    {
      const auto scope = frame.passes().open(kMorphPass);
      const auto vertices = static_cast<int>(frame.gpuScene().vertexCount());
      constexpr int kPerRow = 1 << 20;  // a dispatch has at most 65,535 groups per dimension
      frame.gpuScene().positions().bindStorage(kMorphPositionsBuffer);
      targets_->bindStorage(kMorphTargetsBuffer);
      groups_->bindStorage(kMorphGroupsBuffer);
      shares_->bindStorage(kMorphSharesBuffer);
      moved_->bindStorage(kMorphMovedBuffer);
      program_->set("vertexCount", frame.gpuScene().vertexCount());
      program_->dispatch({std::min(vertices, kPerRow), (vertices + kPerRow - 1) / kPerRow}, {kMorphGroup, 1});
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
    }
    view_->render();
  }

  const gl::Texture& product() const override { return view_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const scene::LodView view{frame.camera(), frame.sizePx().y};
    std::vector<Counter> out = selectionCounters(frame.scene(), levels(frame.scene(), view), view);
    double sum = 0.0;
    for (const scene::LodObject& object : frame.scene().lodObjects) sum += place(object, view).second;
    out.push_back({"morph_mean", sum / static_cast<double>(frame.scene().lodObjects.size())});
    return out;
  }

 private:
  /// Level of an object and how far it has morphed into the next.
  std::pair<int, double> place(const scene::LodObject& object, const scene::LodView& view) const {
    const int last = static_cast<int>(object.levels.size()) - 1;
    if (const auto* fixed = std::get_if<FixedMorph>(&settings_.control))
      return {std::min(fixed->level, last), fixed->level < last ? fixed->morph : 0.0};
    const auto [factor, range] = std::get<MorphByDistance>(settings_.control);
    const double distance = viewDistance(object, view.camera);
    int level = 0;
    while (level < last && distance >= factor * object.switchDistances[static_cast<size_t>(level)]) ++level;
    if (level == last) return {level, 0.0};
    // Begins at this share of the distance to the switch; complete where the level changes.
    const double end = factor * object.switchDistances[static_cast<size_t>(level)],
                 begin = end * (1.0 - range);
    return {level, end > begin ? std::clamp((distance - begin) / (end - begin), 0.0, 1.0) : 0.0};
  }

  scene::LodSelection levels(const scene::Scene& scene, const scene::LodView& view) const {
    scene::LodSelection out;
    for (const scene::LodObject& object : scene.lodObjects) out.levels.push_back(place(object, view).first);
    return out;
  }

  std::vector<float> sharesOf(const scene::Scene& scene, const scene::LodSelection& chosen,
                              const scene::LodView& view) const {
    std::vector<float> out(1, 0.0F);
    for (size_t i = 0; i < scene.lodObjects.size(); ++i)
      for (size_t level = 0; level < scene.lodObjects[i].levels.size(); ++level)
        out.push_back(static_cast<int>(level) == chosen.levels[i]
                          ? static_cast<float>(place(scene.lodObjects[i], view).second)
                          : 0.0F);
    return out;
  }

  GeomorphSettings settings_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Buffer> targets_, groups_, shares_, moved_;
  std::optional<BoxView> view_;
};

std::vector<Quantity> geomorphQuantities() {
  std::vector<Quantity> out = selectionQuantities();
  out.emplace_back("morph_mean", "Mean morph", "", Direction::Neither);
  return out;
}

const RegisteredTechnique<Geomorph> kGeomorphRegistered{
    {.name = "lod/geomorph",
     .version = 1,
     .summary = "Levels whose vertices move onto the next level before it takes over",
     .source = "Schwarz 2009, section 2.4 (SP-57)",
     .product = ProductKind::Colour,
     .needs = {"lod_sets"},
     .counters = geomorphQuantities()}};

}  // namespace
}  // namespace limen::techniques
