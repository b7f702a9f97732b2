// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/scene.h"

#include <cmath>
#include <cstring>
#include <type_traits>

#include "experiments/base/hash.h"

namespace limen::scene {
namespace {

bool finite(glm::dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Feeds exact bytes; every array is preceded by its length, so that no two contents give the same stream.
class Feed {
 public:
  template <class Value>
  void value(const Value& value) {
    static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value>);
    hash_.update(&value, sizeof value);
  }
  void vector(glm::dvec3 v) { value(v.x), value(v.y), value(v.z); }
  void vector(glm::vec3 v) { value(v.x), value(v.y), value(v.z); }
  void text(const char* word) { hash_.update(word, std::strlen(word) + 1); }
  void vector(glm::dvec2 v) { value(v.x), value(v.y); }
  void outline(const std::vector<glm::dvec2>& points) {
    value(static_cast<uint64_t>(points.size()));
    for (const glm::dvec2 point : points) vector(point);
  }
  template <class Element>
  void array(const std::vector<Element>& elements) {
    value(static_cast<uint64_t>(elements.size()));
    hash_.update(elements.data(), elements.size() * sizeof(Element));
  }
  std::string hex() { return hash_.hex(); }

 private:
  Sha256 hash_;
};

void feed(Feed& out, const AreaLight& light) {
  out.value(static_cast<int32_t>(light.shape));
  out.vector(light.centre), out.vector(light.axisX), out.vector(light.axisY), out.vector(light.size);
  out.outline(light.outline);
  out.value(static_cast<uint64_t>(light.parts.size()));
  for (const LightPart& part : light.parts) out.outline(part.outline), out.vector(part.radiance);
}

void feed(Feed& out, const CameraPath& path) {
  out.value(static_cast<uint64_t>(path.keys.size()));
  for (const CameraPath::Key& key : path.keys) {
    out.value(key.timeS);
    out.vector(key.camera.eye), out.vector(key.camera.target), out.vector(key.camera.up);
    out.value(key.camera.verticalFovDeg);
  }
  if (path.runIn) out.value(uint64_t{1});
}

void feedSurfaces(Feed& out, const surfaces::PatchSet& set) {
  out.text("surfaces"), out.array(set.points), out.array(set.normals);
  for (const surfaces::Patch& patch : set.patches) {
    out.value(static_cast<uint8_t>(patch.domain)), out.value(patch.degreeU), out.value(patch.degreeV);
    out.value(patch.normalDegree), out.value(patch.firstPoint), out.value(patch.firstNormal);
    out.value(patch.part);
  }
  for (const auto& sides : set.neighbours)
    for (const surfaces::Neighbour& side : sides)
      out.value(side.patch), out.value(side.side), out.value(static_cast<uint8_t>(side.reversed));
  for (const surfaces::TrimRegion& region : set.trims)
    for (const std::vector<glm::dvec2>& loop : region.loops) out.text("trim"), out.outline(loop);
  for (const surfaces::PatchTrim& trim : set.trimOf)
    out.value(trim.region), out.vector(trim.low), out.vector(trim.high);
  if (set.motion.moves())
    out.value(set.motion.periodS), out.array(set.motion.sine), out.array(set.motion.cosine);
}

void feedSubdivision(Feed& out, const surfaces::SubdivisionSurface& surface) {
  out.text("subdivision"), out.array(surface.cage.points), out.value(static_cast<uint8_t>(surface.scheme));
  out.value(surface.part);
  for (const std::vector<uint32_t>& face : surface.cage.faces) out.array(face);
  for (const auto& [edge, sharpness] : surface.cage.sharpness)
    out.value(edge[0]), out.value(edge[1]), out.value(sharpness);
  for (const surfaces::Joint& joint : surface.joints) {
    out.vector(joint.pivot), out.vector(joint.axis);
    out.value(joint.amplitudeRad), out.value(joint.periodS), out.value(joint.phaseRad);
  }
  for (const surfaces::JointBinding& binding : surface.bindings)
    out.value(binding.joint), out.value(binding.weight);
}

/// What only some scenes have. Each is preceded by its own keyword, so that scenes without it keep their
/// hash.
void feedExtras(Feed& out, const Scene& scene) {
  static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::vec4) == 16, "arrays are hashed without padding");
  if (!scene.mesh.normals.empty()) out.text("normals"), out.array(scene.mesh.normals);
  if (!scene.mesh.attributes.empty()) out.text("attributes"), out.array(scene.mesh.attributes);
  if (!scene.mesh.morphTargets.empty()) out.text("morph"), out.array(scene.mesh.morphTargets);
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    if (material.surface != SurfaceKind::Mesh) {
      out.text("surface"), out.value(static_cast<uint64_t>(i));
      out.value(static_cast<int32_t>(material.surface)), out.value(material.patch);
    }
    if (material.reflects()) {
      out.text("mirror"), out.value(static_cast<uint64_t>(i)), out.vector(material.mirror);
      out.value(static_cast<uint8_t>(material.fresnel)), out.value(material.glossRad);
    }
    if (material.refracts()) {
      out.text("refraction"), out.value(static_cast<uint64_t>(i)), out.vector(material.transmittance);
      out.value(material.refractiveIndex);
    }
    if (material.emits())
      out.text("emission"), out.value(static_cast<uint64_t>(i)), out.vector(material.emission);
    const Pattern& pattern = material.pattern;
    if (pattern.kind == Pattern::Kind::None) continue;
    out.text("pattern"), out.value(static_cast<uint64_t>(i));
    out.value(static_cast<int32_t>(pattern.kind)), out.value(pattern.size), out.value(pattern.contrast);
    out.value(pattern.octaves), out.vector(pattern.origin);
  }
  for (const BicubicPatch& patch : scene.patches) {
    out.text("patch");
    for (const glm::dvec3& point : patch.points) out.vector(point);
  }
  for (const LodObject& object : scene.lodObjects) {
    out.text("levels"), out.value(object.part), out.value(static_cast<uint64_t>(object.levels.size()));
    for (const LodLevel& level : object.levels) {
      out.value(level.firstTriangle), out.value(level.triangleCount);
      out.value(level.deviation), out.value(level.statedError);
    }
    for (const double distance : object.switchDistances) out.value(distance);
    out.vector(object.bounds.low), out.vector(object.bounds.high);
  }
  for (const PartMotion& motion : scene.motions) {
    out.text("motion"), out.value(motion.part), out.vector(motion.pivot), out.vector(motion.axis);
    out.value(motion.turnDegS), out.vector(motion.travel), out.value(motion.periodS);
    out.value(motion.startS);
  }
  if (!scene.surfaces.empty()) feedSurfaces(out, scene.surfaces);
  if (scene.items)
    out.text("stream"), out.array(scene.items->items), out.array(scene.items->keys),
        out.value(scene.items->buckets);
  for (const surfaces::SubdivisionSurface& surface : scene.subdivisions) feedSubdivision(out, surface);
  if (scene.lodObjects.empty()) return;
  out.text("coarser"), out.array(scene.coarser.positions), out.array(scene.coarser.triangles);
  out.array(scene.coarser.normals), out.array(scene.coarser.attributes);
  out.array(scene.coarser.morphTargets);
}

}  // namespace

Bounds Scene::bounds() const {
  Bounds bounds;
  for (const glm::dvec3& position : mesh.positions)
    if (finite(position)) bounds.extend(position);
  for (const PartMotion& motion : motions) {
    const Part& part = parts[motion.part];
    Bounds swept;
    double reach = 0.0;
    for (uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t)
      for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3& position = mesh.positions[mesh.triangles[t][corner]];
        if (!finite(position)) continue;
        swept.extend(position);
        reach = std::max(reach, glm::length(position - motion.pivot));
      }
    if (swept.empty()) continue;
    if (motion.turnDegS != 0.0) swept = {motion.pivot - reach, motion.pivot + reach};
    bounds.extend(swept.low - glm::abs(motion.travel));
    bounds.extend(swept.high + glm::abs(motion.travel));
  }
  return bounds;
}

Bounds Scene::casterBounds() const {
  Bounds bounds;
  for (const Part& part : parts) {
    if (part.receiverOnly) continue;
    for (uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t)
      for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3& position = mesh.positions[mesh.triangles[t][corner]];
        if (finite(position)) bounds.extend(position);
      }
  }
  return bounds;
}

std::string Scene::contentHash() const {
  static_assert(sizeof(glm::dvec3) == 24 && sizeof(glm::uvec3) == 12, "arrays are hashed without padding");
  Feed out;
  out.array(mesh.positions);
  out.array(mesh.triangles);
  out.value(static_cast<uint64_t>(parts.size()));
  for (const Part& part : parts) {
    out.value(part.firstTriangle), out.value(part.triangleCount), out.value(part.material);
    out.value(static_cast<uint8_t>(part.receiverOnly));
  }
  out.value(static_cast<uint64_t>(materials.size()));
  for (const Material& material : materials) out.vector(material.albedo);
  out.value(static_cast<uint64_t>(lights.size()));
  for (const AreaLight& light : lights) feed(out, light);
  feed(out, camera);
  feedExtras(out, *this);
  return out.hex();
}

TriangleRange Scene::triangles(const LodObject& object, int level) const {
  const LodLevel& chosen = object.levels.at(static_cast<size_t>(level));
  const uint32_t before = level == 0 ? 0 : static_cast<uint32_t>(mesh.triangles.size());
  return {before + chosen.firstTriangle, chosen.triangleCount};
}

std::set<std::string> Scene::traits() const {
  std::set<std::string> out;
  if (!lights.empty()) {
    const AreaLight& light = lights[0];
    const bool plain = light.parts.size() == 1 && light.parts[0].outline.empty();
    out.insert("area_light");
    if (light.shape == LightShape::Rectangle && plain) out.insert("rectangular_light");
    if (light.shape == LightShape::Disc && plain) out.insert("disc_light");
    if (light.shape == LightShape::Polygon && plain) out.insert("polygonal_light");
    if (!plain) out.insert("multi_part_light");
    if (lights.size() > 1) out.insert("several_lights");
  }
  if (camera.keys.size() > 1) out.insert("moving_camera");
  if (!lodObjects.empty()) out.insert("lod_sets");
  if (!surfaces.empty()) out.insert("curved_surfaces");
  if (!nurbs.empty()) out.insert("nurbs");
  if (surfaces.motion.moves()) out.insert("moving_surfaces");
  if (!motions.empty()) out.insert("moving_parts");
  if (!surfaces.trims.empty()) out.insert("trimmed_surfaces");
  if (items) out.insert("item_stream");
  if (!subdivisions.empty()) out.insert("subdivision_surfaces");
  for (const Part& part : parts) {
    out.insert(part.receiverOnly ? "receiver_only_parts" : "casters");
    const Material& material = materials[part.material];
    if (material.reflects()) out.insert("mirrors");
    if (material.reflects() && material.glossRad > 0.0F) out.insert("glossy_materials");
    if (material.refracts()) out.insert("refractive_materials");
    if (material.emits()) out.insert("emissive_materials");
  }
  return out;
}

}  // namespace limen::scene
