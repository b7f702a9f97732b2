// SPDX-License-Identifier: BSD-3-Clause
// What the GPU makes of tables, read back, and recursive subdivision to compare it with.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "renderer/scene/curved/figure.h"
#include "renderer/surfaces/loop_subdivision.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"
#include "renderer/techniques/subdivision/table_evaluator.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"
#include "tests/renderer/subdivision/meshes.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {

using surfaces::PolygonMesh;
using surfaces::SubdivisionScheme;

/// Everything that one frame makes.
struct Made {
  surfaces::TableLayout layout;
  int segments = 0;
  std::vector<ControlVertex> controls;
  std::vector<TessellatedVertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<glm::vec4> attributes;
};

class TablesOnGpu : public TechniqueTest {
 protected:
  static Made made(const surfaces::SubdivisionSurface& surface, const TableEvaluatorSettings& settings,
                   double timeS = 0.0) {
    const scene::Scene scene = makeScene("half_plane");
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {8, 8});
    TableEvaluator evaluator(context(), surface, 7, glm::dvec3(0.0), settings);
    evaluator.allocateMesh(context());
    frame.begin();
    evaluator.runFirstSteps(frame, timeS);
    evaluator.runMain(frame);
    frame.end();
    return {evaluator.layout(),
            evaluator.segments(),
            evaluator.controls().read<ControlVertex>(),
            evaluator.vertices().read<TessellatedVertex>(),
            evaluator.indices().read<uint32_t>(0, 3 * int64_t{evaluator.triangleCount()}),
            evaluator.attributes() ? evaluator.attributes()->read<glm::vec4>() : std::vector<glm::vec4>()};
  }
  static Made made(const PolygonMesh& mesh, int level, SubdivisionScheme scheme = SubdivisionScheme::Loop,
                   NormalStart normals = NormalStart::First) {
    surfaces::SubdivisionSurface surface;
    surface.cage = mesh;
    surface.scheme = scheme;
    return made(surface, {level, normals});
  }
};

/// Of a face of a recursively refined mesh the vertex at a place: weights, in 1 / n, of the face's vertices.
/// Children of a face are numbered as loop() says.
inline std::pair<uint32_t, size_t> fineCorner(uint32_t face, std::array<int, 3> w, int n) {
  if (n == 1) return {face, size_t(std::find(w.begin(), w.end(), 1) - w.begin())};
  const int h = n / 2;
  for (uint32_t c = 0; c < 3; ++c) {
    const int own = w[c], next = w[(c + 1) % 3], previous = w[(c + 2) % 3];
    if (own >= h) return fineCorner(4 * face + c, {own - h, next, previous}, h);
  }
  return fineCorner(4 * face + 3, {h - w[2], h - w[0], h - w[1]}, h);
}

/// Places of the three corners of a patch's triangles, in the order in which they are listed.
inline std::vector<std::array<surfaces::Place, 3>> trianglesOf(int n) {
  std::vector<std::array<surfaces::Place, 3>> out;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x + y < n; ++x) {
      out.push_back({{{x, y}, {x + 1, y}, {x, y + 1}}});
      if (x + y + 2 <= n) out.push_back({{{x + 1, y}, {x + 1, y + 1}, {x, y + 1}}});
    }
  return out;
}

/// Calls visit(drawn vertex, face, corner) for every corner of the drawn triangles, with its face and corner
/// in the mesh refined as often.
template <class Visit>
void forEachCorner(const Made& made, const PolygonMesh& mesh, Visit visit) {
  const PolygonMesh first = surfaces::loop(mesh, made.layout.steps);
  std::map<std::array<uint32_t, 3>, uint32_t> faces;
  for (uint32_t f = 0; f < first.faces.size(); ++f)
    for (size_t r = 0; r < 3; ++r)
      faces[{first.faces[f][r], first.faces[f][(r + 1) % 3], first.faces[f][(r + 2) % 3]}] =
          3 * f + uint32_t(r);
  const auto triangles = trianglesOf(made.segments);
  size_t index = 0;
  for (const surfaces::TablePatch& patch : made.layout.patches) {
    const auto vertex = [&](size_t c) { return made.layout.controls[patch.controls[c]].vertex; };
    const uint32_t found = faces.at({vertex(0), vertex(1), vertex(2)});
    for (const auto& triangle : triangles)
      for (const surfaces::Place& place : triangle) {
        std::array<int, 3> weights{};
        weights[found % 3] = made.segments - place[0] - place[1];
        weights[(found + 1) % 3] = place[0], weights[(found + 2) % 3] = place[1];
        const auto [face, corner] = fineCorner(found / 3, weights, made.segments);
        visit(made.indices[index++], face, corner);
      }
  }
  EXPECT_EQ(index, made.indices.size());
}

/// Largest distance of drawn vertices from the limits of the recursively refined mesh, every triangle's
/// corners taken by its place; and largest angle of normals from the limit's [rad].
struct Errors {
  double position = 0.0, normal = 0.0;
};
inline Errors errorsOf(const Made& made, const PolygonMesh& mesh) {
  const PolygonMesh fine = surfaces::loop(mesh, made.layout.steps + int(std::log2(made.segments)));
  const surfaces::LoopLimit limit = surfaces::loopLimit(fine);
  Errors out;
  forEachCorner(made, mesh, [&](uint32_t index, uint32_t face, size_t corner) {
    const TessellatedVertex& drawn = made.vertices[index];
    out.position = std::max(out.position,
                            glm::length(glm::dvec3(drawn.position) - limit.points[fine.faces[face][corner]]));
    out.normal =
        std::max(out.normal,
                 std::acos(std::min(1.0, glm::dot(glm::dvec3(drawn.normal), limit.normals[face][corner]))));
  });
  return out;
}

inline PolygonMesh figureCage() { return scene::figureOfTriangles().cage; }

}  // namespace limen::techniques
