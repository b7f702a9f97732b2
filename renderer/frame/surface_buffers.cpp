// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/surface_buffers.h"

#include <vector>

#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

constexpr bool shaderHas(uint number, scene::SurfaceKind kind) { return number == static_cast<uint>(kind); }
constexpr bool shaderHas(uint number, scene::Pattern::Kind kind) { return number == static_cast<uint>(kind); }
static_assert(shaderHas(kSurfaceMesh, scene::SurfaceKind::Mesh) &&
              shaderHas(kSurfacePatch, scene::SurfaceKind::BicubicPatch) &&
              shaderHas(kSurfaceAperture, scene::SurfaceKind::Aperture));
static_assert(shaderHas(kPatternNone, scene::Pattern::Kind::None) &&
              shaderHas(kPatternChecker, scene::Pattern::Kind::Checker) &&
              shaderHas(kPatternNoise, scene::Pattern::Kind::ValueNoise));

size_t vertexCount(const scene::Scene& scene) {
  return scene.mesh.positions.size() + scene.coarser.positions.size();
}

std::vector<SurfaceMaterial> materialsOf(const scene::Scene& scene, glm::dvec3 anchor) {
  std::vector<SurfaceMaterial> out;
  for (const scene::Material& material : scene.materials) {
    const scene::Pattern& pattern = material.pattern;
    out.push_back({material.albedo, static_cast<uint32_t>(material.surface),
                   glm::vec3(pattern.origin - anchor), static_cast<float>(1.0 / pattern.size),
                   static_cast<uint32_t>(pattern.kind), static_cast<float>(pattern.contrast), pattern.octaves,
                   static_cast<uint32_t>(vertexCount(scene)) + 16 * material.patch, material.mirror,
                   material.glossRad, material.transmittance, material.refractiveIndex, material.emission,
                   material.fresnel ? 1U : 0U});
  }
  return out;
}

std::vector<uint32_t> triangleMaterialsOf(const scene::Scene& scene) {
  std::vector<uint32_t> out(scene.mesh.triangles.size() + scene.coarser.triangles.size());
  for (const scene::Part& part : scene.parts)
    std::fill_n(out.begin() + part.firstTriangle, part.triangleCount, part.material);
  for (const scene::LodObject& object : scene.lodObjects)
    for (int level = 1; level < static_cast<int>(object.levels.size()); ++level) {
      const scene::TriangleRange range = scene.triangles(object, level);
      std::fill_n(out.begin() + range.first, range.count, scene.parts[object.part].material);
    }
  return out;
}

/// A vertex attribute of both meshes; empty if neither has it.
template <class Value>
std::vector<Value> joined(const scene::Scene& scene, std::vector<Value> scene::Mesh::*attribute) {
  std::vector<Value> out = scene.mesh.*attribute;
  const std::vector<Value>& more = scene.coarser.*attribute;
  if (out.empty() && more.empty()) return out;
  out.resize(scene.mesh.positions.size(), Value(0.0F));
  out.insert(out.end(), more.begin(), more.end());
  out.resize(scene.mesh.positions.size() + scene.coarser.positions.size(), Value(0.0F));
  return out;
}

/// Of vertices; then, if there are patches, their control points.
std::vector<glm::vec4> attributesOf(const scene::Scene& scene, glm::dvec3 anchor) {
  std::vector<glm::vec4> out = joined(scene, &scene::Mesh::attributes);
  if (!scene.patches.empty()) out.resize(vertexCount(scene), glm::vec4(0.0F));
  for (const scene::BicubicPatch& patch : scene.patches)
    for (const glm::dvec3& point : patch.points) out.emplace_back(glm::vec3(point - anchor), 1.0F);
  return out;
}

}  // namespace

SurfaceBuffers::SurfaceBuffers(const scene::Scene& scene, glm::dvec3 anchor)
    : hasNormals_(!scene.mesh.normals.empty() || !scene.coarser.normals.empty()),
      hasAttributes_(!scene.mesh.attributes.empty() || !scene.coarser.attributes.empty()),
      normals_(joined(scene, &scene::Mesh::normals)),
      attributes_(attributesOf(scene, anchor)),
      triangleMaterials_(triangleMaterialsOf(scene)),
      materials_(materialsOf(scene, anchor)) {}

void SurfaceBuffers::bindStorage() const {
  normals_.bindStorage(kSurfaceNormalsBuffer);
  attributes_.bindStorage(kSurfaceAttributesBuffer);
  triangleMaterials_.bindStorage(kSurfaceTriangleMaterialsBuffer);
  materials_.bindStorage(kSurfaceMaterialsBuffer);
}

int64_t SurfaceBuffers::bytes() const {
  return normals_.bytes() + attributes_.bytes() + triangleMaterials_.bytes() + materials_.bytes();
}

}  // namespace limen::frame
