// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/ray_casting/pn_prisms/prism_buffers.h"

#include <epoxy/gl.h>

#include <optional>

#include "experiments/base/error.h"
#include "renderer/surfaces/pn_prism.h"
#include "renderer/techniques/ray_casting/ray_casting_bindings.h"

namespace limen::techniques {
namespace {

using glm::dvec3;

/// One degree more.
std::vector<dvec3> elevatedTriangle(int n, const std::vector<dvec3>& points) {
  std::vector<dvec3> out;
  for (int i = n + 1; i >= 0; --i)
    for (int k = 0; k <= n + 1 - i; ++k) {
      const int j = n + 1 - i - k;
      dvec3 sum(0.0);
      const auto add = [&](int weight, int x, int z) {
        if (weight > 0) sum += double(weight) * points[static_cast<size_t>(surfaces::triangleIndex(n, x, z))];
      };
      add(i, i - 1, k), add(j, i, k), add(k, i, k - 1);
      out.push_back(sum / double(n + 1));
    }
  return out;
}

std::vector<dvec3> elevatedTo(int degree, int n, std::vector<dvec3> points) {
  for (; n < degree; ++n) points = elevatedTriangle(n, points);
  return points;
}

[[noreturn]] void refuse() {
  throw Error("the scene has curved surfaces other than polynomial triangles of degree 3 at most", "scene",
              "use a scene of PN triangles, such as curved/pn_model or curved/double_torus");
}

}  // namespace

struct PrismBuffers::Made {
  std::vector<CurvedTriangle> triangles;
  std::vector<PrismVertex> vertices;
  std::vector<uint32_t> indices;
};

PrismBuffers::Made PrismBuffers::make(const scene::Scene& scene, glm::dvec3 anchor, int level) {
  Made made;
  const surfaces::PatchSet& set = scene.surfaces;
  const std::vector<surfaces::TrianglePart> parts = surfaces::partsOf(level);
  for (uint32_t number = 0; number < set.patches.size(); ++number) {
    const surfaces::Patch& patch = set.patches[number];
    if (patch.domain != surfaces::Domain::Triangle || patch.degreeU > 3) refuse();
    std::vector<dvec3> points, normals;
    for (uint32_t i = 0; i < static_cast<uint32_t>(patch.points()); ++i) {
      const glm::dvec4& p = set.points[patch.firstPoint + i];
      if (p.w != 1.0) refuse();
      points.push_back(dvec3(p) - anchor);
    }
    for (uint32_t i = 0; i < static_cast<uint32_t>(patch.normals()); ++i)
      normals.push_back(set.normals[patch.firstNormal + i]);
    points = elevatedTo(3, patch.degreeU, points);
    CurvedTriangle triangle{};
    for (size_t i = 0; i < 10; ++i) triangle.points[i] = glm::vec4(glm::dvec4(points[i], 1.0));
    if (!normals.empty()) {
      normals = elevatedTo(2, patch.normalDegree, normals);
      for (size_t i = 0; i < 6; ++i) triangle.normals[i] = glm::vec4(glm::dvec4(normals[i], 0.0));
      triangle.hasNormals = 1;
    }
    triangle.material = scene.parts[patch.part].material;
    made.triangles.push_back(triangle);
    for (const surfaces::TrianglePart& part : parts) {
      const surfaces::PnPrism prism = surfaces::pnPrism(3, points, part);
      const auto first = static_cast<uint32_t>(made.vertices.size());
      for (size_t c = 0; c < 6; ++c)
        made.vertices.push_back(
            {glm::vec3(prism.corners[c]), number, glm::vec2(prism.parameters[c % 3]), 0, 0});
      for (const auto& t : surfaces::kPrismTriangles)
        for (const uint8_t corner : t) made.indices.push_back(first + corner);
    }
  }
  return made;
}

PrismBuffers::PrismBuffers(const scene::Scene& scene, glm::dvec3 anchor, int level)
    : PrismBuffers(make(scene, anchor, level)) {}

PrismBuffers::PrismBuffers(const Made& made)
    : prisms_(static_cast<int64_t>(made.indices.size() / 24)),
      triangles_(made.triangles),
      vertices_(made.vertices),
      indices_(made.indices) {
  glCreateVertexArrays(1, &vertexArray_);
  glVertexArrayAttribFormat(vertexArray_, 0, 3, GL_FLOAT, GL_FALSE, offsetof(PrismVertex, position));
  glVertexArrayAttribIFormat(vertexArray_, 1, 1, GL_UNSIGNED_INT, offsetof(PrismVertex, patchNumber));
  glVertexArrayAttribFormat(vertexArray_, 2, 2, GL_FLOAT, GL_FALSE, offsetof(PrismVertex, start));
  for (GLuint attribute = 0; attribute < 3; ++attribute) {
    glVertexArrayAttribBinding(vertexArray_, attribute, 0);
    glEnableVertexArrayAttrib(vertexArray_, attribute);
  }
  glVertexArrayVertexBuffer(vertexArray_, 0, vertices_.id(), 0, sizeof(PrismVertex));
  glVertexArrayElementBuffer(vertexArray_, indices_.id());
}

PrismBuffers::~PrismBuffers() { glDeleteVertexArrays(1, &vertexArray_); }

void PrismBuffers::draw(bool front) const {
  triangles_.bindStorage(kCurvedTrianglesBuffer);
  glEnable(GL_CULL_FACE);
  glCullFace(front ? GL_BACK : GL_FRONT);
  glBindVertexArray(vertexArray_);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(24 * prisms_), GL_UNSIGNED_INT, nullptr);
  glDisable(GL_CULL_FACE);
}

}  // namespace limen::techniques
