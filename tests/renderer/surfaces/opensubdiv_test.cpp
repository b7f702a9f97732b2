// SPDX-License-Identifier: BSD-3-Clause
// Subdivision surfaces against Pixar's OpenSubdiv.
#include <gtest/gtest.h>
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <map>
#include <memory>
#include <utility>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/shapes.h"
#include "renderer/surfaces/acc_patches.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/loop_point.h"
#include "renderer/surfaces/loop_subdivision.h"
#include "renderer/surfaces/pccm_patches.h"
#include "renderer/surfaces/table_layout.h"

namespace limen::surfaces {
namespace {

namespace osd = OpenSubdiv;

/// The surface of a mesh as OpenSubdiv has it: irregular faces are refined ten times before a patch
/// approximates what is left of them.
class OpenSubdivSurface {
 public:
  OpenSubdivSurface(const PolygonMesh& mesh, osd::Sdc::SchemeType scheme) {
    std::vector<int> sizes, corners, ends;
    std::vector<float> sharpness;
    for (const std::vector<uint32_t>& face : mesh.faces) {
      sizes.push_back(int(face.size()));
      corners.insert(corners.end(), face.begin(), face.end());
    }
    for (const auto& [edge, s] : mesh.sharpness) {
      ends.insert(ends.end(), edge.begin(), edge.end());
      sharpness.push_back(float(s));
    }
    osd::Far::TopologyDescriptor description;
    description.numVertices = int(mesh.points.size());
    description.numFaces = int(sizes.size());
    description.numVertsPerFace = sizes.data();
    description.vertIndicesPerFace = corners.data();
    description.numCreases = int(sharpness.size());
    description.creaseVertexIndexPairs = ends.data();
    description.creaseWeights = sharpness.data();
    osd::Sdc::Options rules;
    rules.SetVtxBoundaryInterpolation(osd::Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    using Factory = osd::Far::TopologyRefinerFactory<osd::Far::TopologyDescriptor>;
    refiner_.reset(Factory::Create(description, Factory::Options(scheme, rules)));
    osd::Far::TopologyRefiner::AdaptiveOptions levels(kLevels);
    // Otherwise faces at sharp edges are approximated like irregular ones.
    levels.useInfSharpPatch = true;
    refiner_->RefineAdaptive(levels);
    osd::Far::PatchTableFactory::Options options(kLevels);
    options.SetEndCapType(osd::Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    options.useInfSharpPatch = true;
    options.SetPatchPrecision<double>();
    table_.reset(osd::Far::PatchTableFactory::Create(*refiner_, options));
    map_ = std::make_unique<osd::Far::PatchMap>(*table_);
    for (const glm::dvec3& p : mesh.points) points_.push_back({p});
    points_.resize(size_t(refiner_->GetNumVerticesTotal() + table_->GetNumLocalPoints()));
    const osd::Far::PrimvarRefinerReal<double> refine(*refiner_);
    Point* from = points_.data();
    for (int level = 1; level <= refiner_->GetMaxLevel(); ++level) {
      Point* to = from + refiner_->GetLevel(level - 1).GetNumVertices();
      refine.Interpolate(level, from, to);
      from = to;
    }
    if (table_->GetNumLocalPoints() > 0)
      table_->GetLocalPointStencilTable<double>()->UpdateValues(
          points_.data(), points_.data() + refiner_->GetNumVerticesTotal());
  }

  /// Parameters of a quad, from its first vertex to the second and to the last; of a triangle alike.
  LimitPoint at(uint32_t face, double s, double t) const {
    const auto* handle = map_->FindPatch(int(face), s, t);
    if (!handle) throw std::runtime_error("OpenSubdiv has no patch there");
    std::array<double, 20> p{}, ds{}, dt{};
    table_->EvaluateBasis(*handle, s, t, p.data(), ds.data(), dt.data());
    const osd::Far::ConstIndexArray control = table_->GetPatchVertices(*handle);
    Point out, alongS, alongT;
    for (int i = 0; i < control.size(); ++i) {
      const Point& point = points_[size_t(control[i])];
      out.AddWithWeight(point, p[size_t(i)]);
      alongS.AddWithWeight(point, ds[size_t(i)]);
      alongT.AddWithWeight(point, dt[size_t(i)]);
    }
    return {out.at, glm::normalize(glm::cross(alongS.at, alongT.at)), 0};
  }

 private:
  static constexpr int kLevels = 10;
  struct Point {
    glm::dvec3 at{0.0};
    void Clear() { at = glm::dvec3(0.0); }
    void AddWithWeight(const Point& other, double weight) { at += weight * other.at; }
  };
  std::vector<Point> points_;
  std::unique_ptr<osd::Far::TopologyRefiner> refiner_;
  std::unique_ptr<osd::Far::PatchTable> table_;
  std::unique_ptr<osd::Far::PatchMap> map_;
};

double diagonalOf(const PolygonMesh& mesh) {
  glm::dvec3 low = mesh.points[0], high = low;
  for (const glm::dvec3& p : mesh.points) low = glm::min(low, p), high = glm::max(high, p);
  return glm::length(high - low);
}

/// Largest distance over random parameters of all faces, as a share of the mesh's diagonal; corners included.
/// Normals are compared where there is no crease.
template <class Own>
void expectTheSame(const PolygonMesh& mesh, osd::Sdc::SchemeType scheme, Own own) {
  const OpenSubdivSurface theirs(mesh, scheme);
  scene::Random random(31);
  const bool triangles = scheme == osd::Sdc::SCHEME_LOOP;
  double most = 0.0, worstNormal = 0.0;
  for (uint32_t face = 0; face < mesh.faces.size(); ++face)
    for (int k = 0; k < 10; ++k) {
      double s = k == 0 ? 0.0 : k == 1 ? 1e-3 : random.uniform(0.0, 1.0);
      double t = k == 0 ? 0.0 : k == 1 ? 2e-3 : random.uniform(0.0, 1.0);
      if (triangles && s + t > 1.0) s = 1.0 - s, t = 1.0 - t;
      const LimitPoint expected = theirs.at(face, s, t), found = own(face, s, t);
      most = std::max(most, glm::length(expected.position - found.position));
      if (mesh.sharpness.empty() && k != 0)
        worstNormal = std::max(worstNormal, glm::length(expected.normal - found.normal));
    }
  EXPECT_LT(most, 1e-5 * diagonalOf(mesh));
  EXPECT_LT(worstNormal, 1e-3);
  testing::Test::RecordProperty("largest_share_of_the_diagonal", std::to_string(most / diagonalOf(mesh)));
}

void expectCatmullClark(const PolygonMesh& mesh) {
  expectTheSame(mesh, osd::Sdc::SCHEME_CATMARK,
                [&](uint32_t f, double s, double t) { return catmullClarkPoint(mesh, f, s, t); });
}
void expectLoop(const PolygonMesh& mesh) {
  expectTheSame(mesh, osd::Sdc::SCHEME_LOOP,
                [&](uint32_t f, double s, double t) { return loopPoint(mesh, f, 1.0 - s - t, s); });
}

/// A bumpy sheet with a boundary; creases of given sharpness on a line through it, in quads or triangles.
PolygonMesh sheet(bool triangles, double sharpness) {
  scene::Random random(12);
  PolygonMesh mesh;
  for (int y = 0; y <= 4; ++y)
    for (int x = 0; x <= 4; ++x) mesh.points.emplace_back(x, y, random.uniform(-0.6, 0.6));
  for (uint32_t y = 0; y < 4; ++y)
    for (uint32_t x = 0; x < 4; ++x) {
      const uint32_t a = x + 5 * y, b = a + 1, c = a + 6, d = a + 5;
      if (triangles) {
        mesh.faces.push_back({a, b, c}), mesh.faces.push_back({a, c, d});
      } else {
        mesh.faces.push_back({a, b, c, d});
      }
    }
  if (sharpness > 0.0)
    for (uint32_t y = 0; y < 3; ++y) mesh.sharpness[edgeKey(2 + 5 * y, 2 + 5 * (y + 1))] = sharpness;
  return mesh;
}

/// Two caps of `valence` faces, one each way: a vertex of any valence, closed. Quads: a ring of them between.
PolygonMesh spindle(int valence) {
  scene::Random random(valence);
  PolygonMesh mesh;
  mesh.points = {{0, 0, 1.2}, {0, 0, -1.2}};
  const auto n = uint32_t(valence);
  for (uint32_t i = 0; i < n; ++i) {
    const double turn = 2.0 * M_PI * i / n, radius = random.uniform(0.8, 1.2);
    mesh.points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), random.uniform(-0.2, 0.2));
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t a = 2 + i, b = 2 + (i + 1) % n;
    mesh.faces.push_back({0, a, b}), mesh.faces.push_back({1, b, a});
  }
  return mesh;
}

TEST(OpenSubdiv, CatmullClarkHasTheSameSurface) {
  expectCatmullClark(scene::doubleTorusCage());
  // Quads with vertices of valence 3 to 12.
  for (int valence = 3; valence <= 12; ++valence) expectCatmullClark(catmullClark(spindle(valence)));
}

/// SC-22, SC-23: patches over faces whose vertices are regular, on either side of creases and at boundaries.
TEST(OpenSubdiv, PatchesHaveTheSameSurfaceWhereFacesAreRegular) {
  for (const double sharpness : {0.0, kInfinitelySharp}) {
    PolygonMesh mesh = sheet(false, 0.0);
    if (sharpness > 0.0)
      for (uint32_t y = 0; y < 4; ++y) mesh.sharpness[edgeKey(2 + 5 * y, 2 + 5 * (y + 1))] = sharpness;
    const PatchSet acc = accPatches(mesh), pccm = pccmPatches(mesh);
    const OpenSubdivSurface theirs(mesh, osd::Sdc::SCHEME_CATMARK);
    for (uint32_t f = 0; f < mesh.faces.size(); ++f)
      for (const double u : {0.1, 0.35, 0.8})
        for (const double v : {0.0, 0.6, 0.95}) {
          const glm::dvec3 expected = theirs.at(f, u, v).position;
          // Its weights are single precision in part.
          EXPECT_LT(glm::length(evaluate(acc, acc.patches[f], rectanglePoint(u, v)).p - expected),
                    1e-6 * diagonalOf(mesh));
          if (sharpness > 0.0) continue;
          const size_t part = (u < 0.5 ? 0 : 1) + (v < 0.5 ? 0 : 2);
          const DomainPoint at = rectanglePoint(2.0 * u - (u < 0.5 ? 0 : 1), 2.0 * v - (v < 0.5 ? 0 : 1));
          EXPECT_LT(glm::length(evaluate(pccm, pccm.patches[4 * f + part], at).p - expected),
                    1e-6 * diagonalOf(mesh));
        }
  }
}

TEST(OpenSubdiv, LoopHasTheSameSurface) {
  for (int valence = 3; valence <= 12; ++valence) expectLoop(spindle(valence));
}

/// Boundaries, creases that end inside (darts), semi-sharp ones.
TEST(OpenSubdiv, CreasesAndBoundariesAreTheSame) {
  for (const double sharpness : {0.0, 0.5, 1.0, 2.3, kInfinitelySharp}) {
    SCOPED_TRACE(sharpness);
    expectCatmullClark(sheet(false, sharpness));
    expectLoop(sheet(true, sharpness));
  }
}

/// Tables of basis functions, at all places of level 4 of every patch, in double precision. The surface is
/// that of the control mesh refined once, by OpenSubdiv's rules for the rest of the way.
void expectTables(const PolygonMesh& mesh, SubdivisionScheme scheme) {
  const bool quads = scheme == SubdivisionScheme::CatmullClark;
  const int steps = std::max(1, stepsUntilSmooth(mesh));
  const PolygonMesh once = quads ? catmullClark(mesh, steps) : loop(mesh, steps);
  const OpenSubdivSurface theirs(once, quads ? osd::Sdc::SCHEME_CATMARK : osd::Sdc::SCHEME_LOOP);
  const TableLayout layout = tableLayout(mesh, scheme, 4, steps);
  // The first steps, by weights; CreasesAndBoundariesAreTheSame compares their points with OpenSubdiv's.
  for (size_t v = 0; v < once.points.size(); ++v) {
    glm::dvec3 sum(0.0);
    for (const auto& [vertex, weight] : layout.entries[v]) sum += weight * mesh.points[vertex];
    EXPECT_LT(glm::length(sum - once.points[v]), 1e-12);
  }
  std::map<std::vector<uint32_t>, std::pair<uint32_t, size_t>> faces;
  for (uint32_t f = 0; f < once.faces.size(); ++f)
    for (size_t r = 0; r < once.faces[f].size(); ++r) {
      std::vector<uint32_t> turned;
      for (size_t c = 0; c < once.faces[f].size(); ++c)
        turned.push_back(once.faces[f][(r + c) % once.faces[f].size()]);
      faces[turned] = {f, r};
    }
  double most = 0.0;
  for (const TablePatch& patch : layout.patches) {
    std::vector<uint32_t> corners;
    for (size_t c = 0; c < layout.corners(); ++c)
      corners.push_back(layout.controls[patch.controls[c]].vertex);
    const auto [face, rotation] = faces.at(corners);
    const BasisTable& table = layout.tables[patch.table];
    for (size_t row = 0; row < layout.rows(); ++row) {
      glm::dvec3 own(0.0);
      for (size_t s = 0; s < table.slots; ++s)
        own += table.weight(s, row) * once.points[layout.controls[patch.controls[s]].vertex];
      double x = layout.places[row][0] / 16.0, y = layout.places[row][1] / 16.0;
      if (quads) {
        for (size_t turn = 0; turn < rotation; ++turn) x = std::exchange(y, x), x = 1.0 - x;
      } else {
        std::array<double, 3> weights{};
        weights[rotation] = 1.0 - x - y, weights[(rotation + 1) % 3] = x, weights[(rotation + 2) % 3] = y;
        x = weights[1], y = weights[2];
      }
      most = std::max(most, glm::length(theirs.at(face, x, y).position - own));
    }
  }
  EXPECT_LT(most, 1e-5 * diagonalOf(mesh));
}

TEST(OpenSubdiv, TablesHaveTheSameSurface) {
  for (const int valence : {3, 4, 5, 6, 7, 12, 18}) expectTables(spindle(valence), SubdivisionScheme::Loop);
  expectTables(sheet(true, 0.0), SubdivisionScheme::Loop);
  expectTables(sheet(true, kInfinitelySharp), SubdivisionScheme::Loop);
  expectTables(scene::doubleTorusCage(), SubdivisionScheme::CatmullClark);
  expectTables(sheet(false, kInfinitelySharp), SubdivisionScheme::CatmullClark);
  for (const double sharpness : {0.5, 1.0, 2.3}) {
    expectTables(sheet(true, sharpness), SubdivisionScheme::Loop);
    expectTables(sheet(false, sharpness), SubdivisionScheme::CatmullClark);
  }
}

}  // namespace
}  // namespace limen::surfaces
