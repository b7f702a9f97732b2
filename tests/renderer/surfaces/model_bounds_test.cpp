// SPDX-License-Identifier: BSD-3-Clause
// Bounds on the deviation, for the patches of all models and for many random triangles.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/curved/herd_animal.h"
#include "renderer/scene/curved/nurbs_solids.h"
#include "renderer/scene/curved/tea_table.h"
#include "renderer/scene/curved/teapot.h"
#include "renderer/scene/shapes.h"
#include "renderer/surfaces/acc_patches.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/factors.h"
#include "renderer/surfaces/patch_convert.h"
#include "renderer/surfaces/pn_set.h"
#include "renderer/surfaces/quadrics.h"
#include "tests/renderer/surfaces/bezier_oracle.h"

namespace limen::surfaces {
namespace {

/// Distance between a triangle of the uniform tessellation and the surface at the same weighted parameters,
/// at samples of one triangle of the grid: corners i/m, j/n and their neighbours, `upper` the other half of a
/// cell.
struct Cell {
  int i, j;
  bool upper;
};
double deviation(const PatchSet& set, const Patch& patch, glm::ivec2 m, Cell cell) {
  const bool rectangle = patch.domain == Domain::Rectangle;
  const auto at = [&](int i, int j) { return glm::dvec2(double(i) / m.x, double(j) / m.y); };
  const std::array<glm::dvec2, 3> corners =
      cell.upper ? std::array<glm::dvec2, 3>{at(cell.i + 1, cell.j + 1), at(cell.i, cell.j + 1),
                                             rectangle ? at(cell.i, cell.j) : at(cell.i + 1, cell.j)}
                 : std::array<glm::dvec2, 3>{at(cell.i, cell.j), at(cell.i + 1, cell.j),
                                             rectangle ? at(cell.i + 1, cell.j + 1) : at(cell.i, cell.j + 1)};
  const auto surface = [&](glm::dvec2 p) {
    return homogeneousJet(set, patch, domainPoint(patch.domain, p.x, p.y), Order::Position).p;
  };
  std::array<glm::dvec4, 3> points;
  for (size_t c = 0; c < 3; ++c) points[c] = surface(corners[c]);
  double most = 0.0;
  constexpr int kSteps = 5;
  for (int b = 0; b <= kSteps; ++b)
    for (int c = 0; b + c <= kSteps; ++c) {
      const double x = double(b) / kSteps, y = double(c) / kSteps, z = 1.0 - x - y;
      const glm::dvec4 flat = x * points[0] + y * points[1] + z * points[2],
                       curved = surface(x * corners[0] + y * corners[1] + z * corners[2]);
      most = std::max(most, glm::length(glm::dvec3(flat) / flat.w - glm::dvec3(curved) / curved.w));
    }
  return most;
}

struct Outcome {
  size_t checked = 0, broken = 0;
  double worst = 0.0;  ///< deviation over tolerance
  void add(double share) {
    ++checked, broken += share > 1.0 + 1e-9;
    worst = std::max(worst, share);
  }
};

/// At a few triangles of every patch.
void check(const PatchSet& set, double share, size_t stride, Outcome& outcome) {
  scene::Random random(41);
  for (size_t p = 0; p < set.patches.size(); p += stride) {
    const Patch& patch = set.patches[p];
    const double eps = share * controlDiagonal(set, patch);
    if (eps <= 0.0) continue;
    glm::ivec2 m;
    bool capped = false;
    constexpr int kMost = 1 << 28;
    if (patch.domain == Domain::Rectangle) {
      const glm::dvec2 segments =
          segmentsOf(derivativeBounds(set, patch, eps), eps, FactorRule::AbiEzziShirman);
      m = {wholeFactor(segments.x, kMost, &capped), wholeFactor(segments.y, kMost, &capped)};
    } else {
      const std::array<double, 3> s = triangleSegments(set, patch, eps);
      m = glm::ivec2(wholeFactor(std::max({s[0], s[1], s[2]}), kMost, &capped));
    }
    if (capped) continue;
    const auto below = [&](int n) { return std::min(n - 1, int(random.uniform(0.0, n))); };
    for (int k = 0; k < 6; ++k) {
      Cell cell{below(m.x), below(m.y), random.uniform(0.0, 1.0) < 0.5};
      if (patch.domain == Domain::Triangle) {
        cell.j = below(m.x - cell.i);
        cell.upper = cell.upper && cell.i + cell.j + 2 <= m.x;
      }
      outcome.add(deviation(set, patch, m, cell) / eps);
    }
  }
}

TEST(ModelBounds, HoldForThePatchesOfEveryModel) {
  std::vector<std::pair<std::string, PatchSet>> models = {
      {"teapot", scene::teapot()},
      {"tea table", scene::teaTable()},
      {"herd animal", scene::herdAnimal()},
      {"octants", elevated(unitSphere(), 3, 3)},
      {"double torus, PN triangles", pnSet(scene::doubleTorus())},
      {"double torus, Phong tessellation", phongSet(scene::doubleTorus(), 0.75)},
      {"double torus, bicubic approximation", accPatches(scene::doubleTorusCage())}};
  for (const scene::NurbsSolid& solid : scene::nurbsSolids()) models.emplace_back(solid.name, solid.patches);
  for (const auto& [name, set] : models)
    for (const double share : {1e-1, 1e-2, 1e-4}) {
      Outcome outcome;
      check(set, share, set.patches.size() > 4000 ? 7 : 1, outcome);
      EXPECT_EQ(outcome.broken, 0U) << name << ", tolerance of " << share << ": " << outcome.worst;
      EXPECT_GT(outcome.checked, 0U) << name;
      EXPECT_GT(outcome.worst, 0.01) << name << ": the tolerance is another one";
    }
}

/// How many random patches of each kind; 100,000 take a minute.
size_t randomPatches() {
  const char* const given = std::getenv("LIMEN_RANDOM_PATCHES");
  return given ? std::stoul(given) : 3000;
}

/// A sheet bent by up to its own size, weights between 1 / range and range.
PatchSet bentSheet(scene::Random& random, Domain domain, int degreeU, int degreeV, double range) {
  PatchSet set = oracle::randomPatch(random, domain, degreeU, degreeV, range);
  const double bend = std::pow(10.0, random.uniform(-3.0, 0.0));
  const Patch& patch = set.patches[0];
  size_t next = 0;
  const auto put = [&](double x, double y) {
    glm::dvec4& p = set.points[next++];
    p = weighted(glm::dvec3(x, y, 0.0) + bend * glm::dvec3(p) / p.w, p.w);
  };
  if (domain == Domain::Rectangle) {
    for (int j = 0; j <= degreeV; ++j)
      for (int i = 0; i <= degreeU; ++i) put(double(i) / degreeU, double(j) / degreeV);
  } else {
    for (int row = 0; row <= patch.degreeU; ++row)
      for (int k = 0; k <= row; ++k)
        put(double(patch.degreeU - row) / patch.degreeU, double(row - k) / patch.degreeU);
  }
  return set;
}

TEST(ModelBounds, HoldForRandomPatchesOfEveryKind) {
  scene::Random random(47);
  const auto degree = [&](int least) {
    return std::min(kMaxDegree, least + int(random.uniform(0.0, kMaxDegree - least + 1.0)));
  };
  struct Kind {
    const char* name;
    Domain domain;
    double weights;
  };
  for (const Kind& kind : {Kind{"polynomial rectangles", Domain::Rectangle, 1.0},
                           {"rational rectangles", Domain::Rectangle, 10.0},
                           {"rational rectangles of any weights", Domain::Rectangle, 1e3},
                           {"polynomial triangles", Domain::Triangle, 1.0}}) {
    Outcome outcome;
    for (size_t i = 0; i < randomPatches(); ++i) {
      const int m = degree(kind.domain == Domain::Triangle ? 2 : 1);
      const PatchSet set = bentSheet(random, kind.domain, m, degree(1), kind.weights);
      check(set, std::pow(10.0, random.uniform(-4.0, -0.5)), 1, outcome);
    }
    std::printf("%s: %zu of %zu broken, at most %.3f of the tolerance\n", kind.name, outcome.broken,
                outcome.checked, outcome.worst);
    EXPECT_EQ(outcome.broken, 0U) << kind.name << ' ' << outcome.worst;
    EXPECT_GT(outcome.worst, 0.01) << kind.name;
  }
}

/// SC-58: how often the thesis's factor of 9/4 is too small on the double torus is reported; the constants
/// that are proven are never too small.
TEST(ModelBounds, PnEstimateOnTheDoubleTorusIsCounted) {
  const PatchSet set = pnSet(scene::doubleTorus());
  scene::Random random(43);
  std::array<Outcome, 3> outcomes;
  for (const Patch& patch : set.patches) {
    const double distance = largestTangentDistance(set, patch);
    for (const double share : {0.9, 0.3, 0.1, 0.03}) {
      const double eps = share * distance;
      if (eps <= 0.0) continue;
      for (const PnBound bound : {PnBound::Boundary, PnBound::Tied, PnBound::Safe}) {
        const int m = wholeFactor(pnSegments(set, patch, eps, bound), 4096);
        double most = 0.0;
        for (int j = 0; j < m; ++j)
          for (int i = 0; i + j < m; ++i) {
            most = std::max(most, deviation(set, patch, glm::ivec2(m), {i, j, false}));
            if (i + j + 2 <= m) most = std::max(most, deviation(set, patch, glm::ivec2(m), {i, j, true}));
          }
        outcomes[size_t(bound)].add(most / eps);
      }
    }
  }
  for (size_t b = 0; b < 3; ++b)
    std::printf("constant %.2f: broken %zu of %zu, worst %.3f of the tolerance\n",
                constantOf(static_cast<PnBound>(b)), outcomes[b].broken, outcomes[b].checked,
                outcomes[b].worst);
  RecordProperty("broken_9_4", int(outcomes[0].broken));
  EXPECT_EQ(outcomes[1].broken, 0U);
  EXPECT_EQ(outcomes[2].broken, 0U);
}

}  // namespace
}  // namespace limen::surfaces
