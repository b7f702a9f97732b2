// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/patch_buffers.h"

#include <algorithm>

#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

uint32_t shapeOf(const surfaces::Patch& patch) {
  // Two bits: a rectangle's field is always of degree 5.
  const uint32_t normals = std::min<uint32_t>(patch.normalDegree, 3);
  return (patch.domain == surfaces::Domain::Rectangle ? 1U : 0U) | uint32_t{patch.degreeU} << 1 |
         uint32_t{patch.degreeV} << 5 | normals << 9;
}

std::vector<TessellatedPatch> recordsOf(const scene::Scene& scene) {
  const surfaces::PatchSet& set = scene.surfaces;
  std::vector<TessellatedPatch> out;
  out.reserve(set.patches.size());
  for (size_t i = 0; i < set.patches.size(); ++i) {
    const surfaces::Patch& patch = set.patches[i];
    TessellatedPatch record{patch.firstPoint, patch.firstNormal, shapeOf(patch),
                            scene.parts[patch.part].material, ivec4(-1)};
    if (i < set.neighbours.size())
      for (int side = 0; side < surfaces::sidesOf(patch.domain); ++side) {
        const surfaces::Neighbour& neighbour = set.neighbours[i][static_cast<size_t>(side)];
        if (neighbour.patch >= 0)
          record.neighbours[side] = 8 * neighbour.patch + 2 * neighbour.side + (neighbour.reversed ? 1 : 0);
      }
    out.push_back(record);
  }
  return out;
}

std::vector<glm::vec4> pointsOf(const surfaces::PatchSet& set, glm::dvec3 anchor) {
  std::vector<glm::vec4> out;
  out.reserve(set.points.size());
  for (const glm::dvec4& p : set.points) out.emplace_back(glm::dvec4(glm::dvec3(p) - p.w * anchor, p.w));
  return out;
}

std::vector<PointMotion> motionsOf(const surfaces::PatchSet& set, glm::dvec3 anchor) {
  const std::vector<glm::vec4> rest = pointsOf(set, anchor);
  std::vector<PointMotion> out;
  for (size_t i = 0; i < rest.size(); ++i) {
    const double w = set.points[i].w;
    out.push_back({rest[i], glm::vec4(glm::dvec4(w * set.motion.sine[i], 0.0)),
                   glm::vec4(glm::dvec4(w * set.motion.cosine[i], 0.0))});
  }
  return out;
}

std::vector<glm::vec4> normalsOf(const surfaces::PatchSet& set) {
  std::vector<glm::vec4> out;
  out.reserve(set.normals.size());
  for (const glm::dvec3& n : set.normals) out.emplace_back(glm::dvec4(n, 0.0));
  return out;
}

gl::ShaderDefines definesOf(const surfaces::PatchSet& set) {
  gl::ShaderDefines out;
  const auto isUnweighted = [](const glm::dvec4& point) { return point.w == 1.0; };
  if (std::all_of(set.points.begin(), set.points.end(), isUnweighted)) out["POLYNOMIAL"] = "1";
  const auto isAlike = [&](const surfaces::Patch& patch) {
    return shapeOf(patch) == shapeOf(set.patches[0]);
  };
  if (!set.patches.empty() && std::all_of(set.patches.begin(), set.patches.end(), isAlike))
    out["SHAPE"] = std::to_string(shapeOf(set.patches[0])) + "u";
  return out;
}

}  // namespace

void requireDrawn(const scene::Scene& scene, const DrawnSurfaces& drawn) {
  const surfaces::PatchSet& set = scene.surfaces;
  if (!drawn.trimmed && !set.trims.empty())
    throw Error("the scene has trimmed surfaces, which this technique would draw whole", "scene",
                "use tessellation/compute or ray_casting/exact");
  if (!set.motion.moves()) return;
  if (!drawn.moving)
    throw Error("the scene has moving surfaces, which this technique would draw at rest", "scene",
                "use tessellation/compute, tessellation/hardware or ray_casting/exact");
  for (const surfaces::Patch& patch : set.patches)
    if (patch.normalDegree > 0 || patch.domain == surfaces::Domain::Triangle)
      throw Error("the scene has moving patches that are triangles or have normals of their own", "scene",
                  "rectangles without a normal field can move");
}

PatchBuffers::PatchBuffers(const scene::Scene& scene, glm::dvec3 anchor, const DrawnSurfaces& drawn)
    : count_(static_cast<uint32_t>(scene.surfaces.patches.size())),
      pointCount_(static_cast<uint32_t>(scene.surfaces.points.size())),
      patches_(recordsOf(scene)),
      points_(pointsOf(scene.surfaces, anchor)),
      normals_(normalsOf(scene.surfaces)),
      defines_(definesOf(scene.surfaces)) {
  requireDrawn(scene, drawn);
  if (scene.surfaces.motion.moves()) motions_.emplace(motionsOf(scene.surfaces, anchor));
}

void PatchBuffers::bindStorage() const {
  patches_.bindStorage(kPatchesBuffer);
  points_.bindStorage(kPatchPointsBuffer);
  normals_.bindStorage(kPatchNormalsBuffer);
}

}  // namespace limen::techniques
