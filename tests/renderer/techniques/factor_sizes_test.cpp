// SPDX-License-Identifier: BSD-3-Clause
// Factors from sizes on the screen (SC-54): those of the definitions, in double precision, and what they
// promise.
#include <cmath>

#include "renderer/surfaces/factors.h"
#include "renderer/surfaces/tessellated_surface.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using surfaces::CurveSize;

class FactorSizes : public TechniqueTest {
 protected:
  std::shared_ptr<const surfaces::TessellatedSurface> made(const scene::Scene& scene,
                                                           const std::string& measure, double segmentPx) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {320, 240});
    const TechniqueInfo& info = TechniqueRegistry::instance().get("tessellation/compute");
    const auto technique = info.make(ParameterValues(info.parameters, {{"factors", std::string("size")},
                                                                       {"factors.measure", measure},
                                                                       {"factors.segment_px", segmentPx},
                                                                       {"cull", false}}));
    technique->prepare(frame);
    frame.begin();
    technique->render(frame);
    frame.end();
    return technique->tessellation(frame);
  }
};

glm::dvec3 onScreen(const surfaces::SurfaceView& view, glm::dvec3 p) {
  const glm::dvec3 away = p - view.eye;
  return glm::dvec3(glm::dot(away, view.right), glm::dot(away, view.up), 0.0) *
         (view.pxAtDistance / glm::dot(away, view.forward));
}

/// Sizes of the two directions of a rectangle, or of its sides.
std::array<double, 4> sizesOf(const surfaces::PatchSet& set, const surfaces::Patch& patch,
                              const surfaces::SurfaceView& view, CurveSize size) {
  const int m = patch.degreeU, n = patch.degreeV;
  const auto curve = [&](int first, int step, int count) {
    std::vector<glm::dvec3> out;
    for (int k = 0; k < count; ++k) {
      const glm::dvec4& p = set.points[patch.firstPoint + size_t(first + k * step)];
      out.push_back(onScreen(view, glm::dvec3(p) / p.w));
    }
    return out;
  };
  if (size == CurveSize::Chord) {
    const auto chord = [&](int first, int step, int count) {
      return sizeOf(size, curve(first, step, count));
    };
    return {chord(0, 1, m + 1), chord(m, m + 1, n + 1), chord((m + 1) * n, 1, m + 1), chord(0, m + 1, n + 1)};
  }
  // The largest step of all curves; of Kumar's measure that of each coordinate.
  glm::dvec3 u(0.0), v(0.0);
  const auto raise = [&](glm::dvec3& most, const std::vector<glm::dvec3>& points) {
    for (size_t k = 1; k < points.size(); ++k) {
      const glm::dvec3 d = double(points.size() - 1) * (points[k] - points[k - 1]);
      most = glm::max(most, size == CurveSize::Kumar ? glm::abs(d) : glm::dvec3(glm::length(d), 0.0, 0.0));
    }
  };
  for (int j = 0; j <= n; ++j) raise(u, curve((m + 1) * j, 1, m + 1));
  for (int i = 0; i <= m; ++i) raise(v, curve(i, m + 1, n + 1));
  return {glm::length(u), glm::length(v), glm::length(u), glm::length(v)};
}

TEST_F(FactorSizes, AreThoseOfTheProjectedControlPoints) {
  constexpr double kSegment = 10.0;  // no side needs more than 64
  const scene::Scene scene = makeScene(
      "curved/sheet", {{"turned", true}, {"relief", 2.0}, {"columns", int64_t{6}}, {"rows", int64_t{6}}});
  const surfaces::PatchSet& set = scene.surfaces;
  for (const auto& [name, size] : {std::pair("chord", CurveSize::Chord),
                                   {"rockwood", CurveSize::Rockwood},
                                   {"kumar", CurveSize::Kumar}}) {
    const auto surface = made(scene, name, kSegment);
    std::vector<std::array<double, 4>> own;
    for (const surfaces::Patch& patch : set.patches) own.push_back(sizesOf(set, patch, surface->view, size));
    int larger = 0;
    for (size_t i = 0; i < own.size(); ++i)
      for (size_t side = 0; side < 4; ++side) {
        double segments = own[i][side] / kSegment;
        const surfaces::Neighbour& beside = set.neighbours[i][side];
        if (beside.patch >= 0)
          segments = std::max(segments, own[size_t(beside.patch)][size_t(beside.side)] / kSegment);
        // Sizes of up to 400 px in float: a number of segments may be missed by 1e-3, and units round up.
        EXPECT_GE(surface->factors[i][side], std::ceil(segments - 1e-3)) << name << ' ' << i << ' ' << side;
        EXPECT_LE(surface->factors[i][side], std::ceil(segments + 1e-3 + 1.0 / surfaces::kSegmentUnit))
            << name << ' ' << i << ' ' << side;
        larger += surface->factors[i][side] > 2;
      }
    EXPECT_GT(larger, 100) << name;
  }
}

/// Kumar's measure bounds all segments of a polynomial curve. Projected, a curve is rational, its weights the
/// distances: its derivative is at most (most / least)^2 times what successive control points say (Floater
/// 1992).
TEST_F(FactorSizes, KumarsBoundsTheLengthOfSegments) {
  const scene::Scene scene =
      makeScene("curved/sheet", {{"relief", 2.0}, {"columns", int64_t{6}}, {"rows", int64_t{6}}});
  const surfaces::PatchSet& set = scene.surfaces;
  constexpr double kSegment = 4.0;
  const auto surface = made(scene, "kumar", kSegment);
  std::vector<double> slack;
  for (const surfaces::Patch& patch : set.patches) {
    double least = 1e300, most = 0.0;
    for (size_t k = 0; k < 16; ++k) {
      const double depth =
          glm::dot(glm::dvec3(set.points[patch.firstPoint + k]) - surface->view.eye, surface->view.forward);
      least = std::min(least, depth), most = std::max(most, depth);
    }
    slack.push_back(most * most / (least * least));
  }
  int64_t edges = 0;
  double longest = 0.0;
  for (const glm::uvec3& t : surface->triangles)
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      const surfaces::DomainPoint &p = surface->parameters[a], &q = surface->parameters[b];
      if (p.u != q.u && p.v != q.v) continue;  // diagonals
      const double length =
          glm::length(onScreen(surface->view, surface->anchor + glm::dvec3(surface->positions[a])) -
                      onScreen(surface->view, surface->anchor + glm::dvec3(surface->positions[b])));
      EXPECT_LT(length, kSegment * slack[surface->patches[a]] * (1.0 + 1e-5));
      longest = std::max(longest, length), ++edges;
    }
  EXPECT_GT(edges, 5000);
  EXPECT_GT(longest, 0.3 * kSegment);  // no bound that is never met
}

/// Of triangles the factors of a chord are the distances of corners.
TEST_F(FactorSizes, ChordsOfTrianglesAreDistancesOfCorners) {
  const scene::Scene scene = makeScene("curved/double_torus");
  const auto surface = made(scene, "chord", 4.0);
  const surfaces::PatchSet& set = scene.surfaces;
  for (size_t i = 0; i < set.patches.size(); i += 7) {
    const glm::dvec4* points = &set.points[set.patches[i].firstPoint];
    const glm::dvec3 corners[3] = {onScreen(surface->view, points[0]), onScreen(surface->view, points[6]),
                                   onScreen(surface->view, points[9])};
    for (size_t side = 0; side < 3; ++side) {
      const double segments = glm::length(corners[side] - corners[(side + 1) % 3]) / 4.0;
      EXPECT_GE(surface->factors[i][side], std::ceil(segments - 1e-3)) << i;
      EXPECT_LE(surface->factors[i][side], std::ceil(segments + 1e-3 + 1.0 / surfaces::kSegmentUnit)) << i;
    }
  }
}

TEST_F(FactorSizes, DoNotComeFromBoundsMadeOnce) {
  const scene::Scene scene = makeScene("curved/teapot");
  EXPECT_THROW(render(scene, "tessellation/compute", {{"factors", std::string("size")}, {"precompute", true}},
                      {32, 24}),
               Error);
}

}  // namespace
}  // namespace limen::techniques
