// SPDX-License-Identifier: BSD-3-Clause
// Geomorphing (SP-57; Schwarz 2009, section 2.4): the vertices of a level move in straight lines onto the
// next coarser level while the object recedes, so that geometry does not jump when the level changes.
//
// Terrain and patches morph into exactly their next level where one divides the other. Simplified meshes have
// no map of collapsed vertices here: each vertex goes to the nearest point of the next level, whose surface
// the morphed one approaches without being identical to it. Normals and apertures stay those of the finer
// level, so shading still jumps a little at the change.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/techniques/lod/box_view.h"
#include "renderer/techniques/lod/level_control.h"

namespace limen::techniques {
namespace {

constexpr const char* kMorphPass = "lod/geomorph";

/// Vertices of one level of one object, and group 0 for all that never moves.
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

class Geomorph : public Technique {
 public:
  explicit Geomorph(const ParameterValues& values)
      : fixed_(values.text("control") == "fixed_level"),
        level_(static_cast<int>(values.integer("level"))),
        morph_(values.real("morph")),
        factor_(values.real("distance_factor")),
        range_(values.real("morph_range")),
        samples_(static_cast<int>(values.integer("samples"))),
        shaded_(frame::ShadedSetting::from(values)) {}

  void prepare(frame::Frame& frame) override {
    const scene::Scene& scene = frame.scene();
    program_ = &frame.context().programs().compute("renderer/techniques/lod/geomorph/morph.comp.glsl");
    targets_.emplace(targetsOf(scene, frame.gpuScene().anchor()));
    groups_.emplace(groupsOf(scene));
    shares_.emplace(static_cast<int64_t>(groupCount(scene) * sizeof(float)), nullptr);
    moved_.emplace(frame.gpuScene().positions().bytes(), nullptr);
    frame.passes().setBytesHeld(kMorphPass,
                                targets_->bytes() + groups_->bytes() + shares_->bytes() + moved_->bytes());
    view_.emplace(frame, "morphed", shaded_, samples_);
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
      constexpr int kPerRow = 1 << 20;  // a dispatch has at most 65,535 groups a dimension
      frame.gpuScene().positions().bindStorage(0);
      targets_->bindStorage(1);
      groups_->bindStorage(2);
      shares_->bindStorage(3);
      moved_->bindStorage(4);
      program_->set("vertexCount", frame.gpuScene().vertexCount());
      program_->dispatch({std::min(vertices, kPerRow), (vertices + kPerRow - 1) / kPerRow}, {64, 1});
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
    out.push_back({"morph_mean", sum / static_cast<double>(frame.scene().lodObjects.size()), "", false});
    return out;
  }

 private:
  /// Level of an object and how far it has morphed into the next.
  std::pair<int, double> place(const scene::LodObject& object, const scene::LodView& view) const {
    const int last = static_cast<int>(object.levels.size()) - 1;
    if (fixed_) return {std::min(level_, last), level_ < last ? morph_ : 0.0};
    const double distance = viewDistance(object, view.camera);
    int level = 0;
    while (level < last && distance >= factor_ * object.switchDistances[static_cast<size_t>(level)]) ++level;
    if (level == last) return {level, 0.0};
    // Begins at this share of the way to the switch; complete where the level changes.
    const double end = factor_ * object.switchDistances[static_cast<size_t>(level)],
                 begin = end * (1.0 - range_);
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

  bool fixed_;
  int level_;
  double morph_, factor_, range_;
  int samples_;
  frame::ShadedSetting shaded_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Buffer> targets_, groups_, shares_, moved_;
  std::optional<BoxView> view_;
};

std::vector<Parameter> geomorphParameters() {
  const char* const kSource = "Schwarz 2009, section 2.4";
  std::vector<Parameter> out = {
      choiceParameter("control", "distance", {"fixed_level", "distance"}, "What decides level and morph",
                      kSource),
      integerParameter("level", 0, 0, 15, "", "fixed_level: of all objects; at most their last"),
      realParameter("morph", 0.5, 0.0, 1.0, "", "fixed_level: share of the way to the next level"),
      realParameter("distance_factor", 1.0, 0.001, 1000.0, "",
                    "distance: multiplies the scene's switch distances"),
      realParameter("morph_range", 0.3, 0.0, 1.0, "",
                    "distance: last share of the way to a switch over which a level morphs; 0 switches hard"),
      samplesParameter(1)};
  for (Parameter& parameter : frame::ShadedSetting::parameters()) out.push_back(std::move(parameter));
  return out;
}

const Registered<TechniqueInfo> kGeomorphRegistered{
    {.name = "lod/geomorph",
     .version = 1,
     .summary = "Levels whose vertices move onto the next level before it takes over",
     .source = "Schwarz 2009, section 2.4 (SP-57)",
     .product = ProductKind::Colour,
     .parameters = geomorphParameters(),
     .needs = {"lod_sets"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Geomorph>(values); },
     .errorBound = {},
     .counters = {"triangles_drawn", "level_mean", "screen_error_px", "morph_mean"}}};

}  // namespace
}  // namespace limen::techniques
