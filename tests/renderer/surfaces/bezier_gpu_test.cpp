// SPDX-License-Identifier: BSD-3-Clause
// bezier.glsl against double precision.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstring>

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/scene/curved/teapot.h"
#include "renderer/surfaces/normal.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/renderer/surfaces/bezier_oracle.h"
#include "tests/renderer/surfaces/bezier_samples_bindings.h"

namespace limen::surfaces {
namespace {

using scene::Random;

struct Sample {
  glm::ivec4 shape, place;
  glm::vec4 diagonal;
};
struct Result {
  std::array<glm::vec4, 6> jet;  ///< p, u, v, uu, uv, vv
  glm::vec4 normal;              ///< and the rung
};

class BezierShader : public gl::GlTest {
 protected:
  /// Compiling takes longer than all tests.
  static void SetUpTestSuite() {
    context();
    programs_ = std::make_unique<gl::ProgramCache>();
  }
  static void TearDownTestSuite() { programs_.reset(); }
  struct Place {
    size_t patch;
    glm::ivec4 at;  ///< i, m, j, n of a rectangle; i, j, m of a triangle
    bool fixedDegree = false;
  };
  static std::vector<Result> evaluated(const PatchSet& set, const std::vector<Place>& places) {
    std::vector<glm::vec4> points(set.points.begin(), set.points.end());
    std::vector<Sample> samples;
    for (const Place& place : places) {
      const Patch& patch = set.patches[place.patch];
      const int v = patch.domain == Domain::Triangle ? 0 : patch.degreeV;
      samples.push_back({{int(patch.firstPoint), patch.degreeU, v, int(place.fixedDegree)},
                         place.at,
                         glm::vec4(float(controlDiagonal(set, patch)))});
    }
    const gl::Program& program = programs_->compute("tests/renderer/surfaces/bezier_samples.comp.glsl");
    const gl::Buffer pointBuffer(points), sampleBuffer(samples),
        results(int64_t(places.size() * sizeof(Result)), nullptr);
    pointBuffer.bindStorage(kBezierPointsBuffer), sampleBuffer.bindStorage(kBezierSamplesBuffer);
    results.bindStorage(kBezierResultsBuffer);
    program.use();
    program.set("count", int(places.size()));
    program.dispatch({int(places.size()), 1}, {64, 1});
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    return results.read<Result>();
  }

 private:
  static inline std::unique_ptr<gl::ProgramCache> programs_;
};

/// As the shader gets them.
PatchSet rounded(PatchSet set) {
  for (glm::dvec4& point : set.points) point = glm::dvec4(glm::vec4(point));
  return set;
}

DomainPoint pointAt(const Patch& patch, glm::ivec4 at) {
  return patch.domain == Domain::Triangle ? triangleGridPoint(at.x, at.y, at.z)
                                          : rectangleGridPoint(at.x, at.y, at.z, at.w);
}

/// Random points of a patch's grid of m = 37 segments, which no binary fraction is.
glm::ivec4 randomPlace(Random& random, Domain domain) {
  const auto any = [&](int last) { return std::min(last, int(random.uniform(0.0, last + 1.0))); };
  if (domain == Domain::Rectangle) return {any(37), 37, any(37), 37};
  const int i = any(37);
  return {i, any(37 - i), 37, 0};
}

/// SC-01: within 1e-6 of the diagonal, all degrees, weights between 1e-3 and 1e3. First derivatives lose the
/// digits of the quotient rule: they are compared by their size.
TEST_F(BezierShader, AgreesWithDoublePrecision) {
  Random random(17);
  PatchSet set;
  std::vector<Place> places;
  for (const double range : {1.0, 10.0, 1e3})
    for (const Domain domain : {Domain::Rectangle, Domain::Triangle})
      for (int m = 1; m <= kMaxDegree; ++m)
        for (int n = 1; n <= kMaxDegree; ++n) {
          if (domain == Domain::Triangle && n != m) continue;
          append(set, oracle::randomPatch(random, domain, m, n, range));
          for (int k = 0; k < 12; ++k)
            places.push_back({set.patches.size() - 1, randomPlace(random, domain)});
        }
  set = rounded(std::move(set));
  const std::vector<Result> results = evaluated(set, places);
  for (size_t i = 0; i < places.size(); ++i) {
    const Patch& patch = set.patches[places[i].patch];
    const DomainPoint at = pointAt(patch, places[i].at);
    const SurfaceJet jet = evaluate(set, patch, at);
    const double diagonal = controlDiagonal(set, patch);
    SCOPED_TRACE(testing::Message() << (patch.domain == Domain::Rectangle ? "rectangle " : "triangle ")
                                    << int(patch.degreeU) << 'x' << int(patch.degreeV) << " sample " << i);
    const auto difference = [&](size_t which, glm::dvec3 expected) {
      return glm::length(glm::dvec3(results[i].jet[which]) - expected);
    };
    EXPECT_LT(difference(0, jet.p), 1e-6 * diagonal);
    // n differences of points, each with an error of 1e-6 of the diagonal, times what weights can do.
    const double scale = diagonal * patch.degreeU * patch.degreeV + glm::length(jet.u) + glm::length(jet.v);
    EXPECT_LT(difference(1, jet.u), 1e-5 * scale);
    EXPECT_LT(difference(2, jet.v), 1e-5 * scale);
    const double second = scale * scale / diagonal + glm::length(jet.uu) + glm::length(jet.vv);
    EXPECT_LT(difference(3, jet.uu), 1e-4 * second);
    EXPECT_LT(difference(4, jet.uv), 1e-4 * second);
    EXPECT_LT(difference(5, jet.vv), 1e-4 * second);
  }
}

/// The functions of fixed degree give the bits of the general ones.
TEST_F(BezierShader, FixedDegreesHaveTheBitsOfAnyDegree) {
  Random random(19);
  PatchSet set;
  std::vector<Place> places, again;
  for (int k = 0; k < 60; ++k) {
    const Domain domain = k % 2 ? Domain::Triangle : Domain::Rectangle;
    append(set, oracle::randomPatch(random, domain, 3, 3, 100.0));
    for (int i = 0; i < 20; ++i) {
      places.push_back({set.patches.size() - 1, randomPlace(random, domain)});
      again.push_back({places.back().patch, places.back().at, true});
    }
  }
  const std::vector<Result> general = evaluated(set, places), fast = evaluated(set, again);
  for (size_t i = 0; i < places.size(); ++i)
    for (size_t k = 0; k < 3; ++k)
      EXPECT_EQ(std::memcmp(&general[i].jet[k], &fast[i].jet[k], sizeof(glm::vec4)), 0)
          << i << ", derivative " << k << " of patch " << places[i].patch;
}

/// SC-05: patches with a common boundary, in either direction, degrees 1 to 9, 1 to 64 segments.
TEST_F(BezierShader, SharedBoundariesAreBitwiseTheSame) {
  Random random(23);
  PatchSet set;
  std::vector<Place> places;
  std::vector<std::array<size_t, 2>> pairs;
  const auto place = [](Domain domain, int side, int i, int m) -> glm::ivec4 {
    if (domain == Domain::Triangle) {
      const std::array<glm::ivec4, 3> at = {{{m - i, i, m, 0}, {0, m - i, m, 0}, {i, 0, m, 0}}};
      return at[size_t(side)];
    }
    const std::array<glm::ivec4, 4> at = {{{i, m, 0, m}, {m, m, i, m}, {m - i, m, m, m}, {0, m, m - i, m}}};
    return at[size_t(side)];
  };
  for (int n = 1; n <= kMaxDegree; ++n) {
    std::vector<glm::dvec4> curve;
    for (int i = 0; i <= n; ++i) curve.push_back(oracle::randomPoint(random, 1e3));
    // Both domains, every side, both directions: all share the curve.
    std::vector<std::array<int, 3>> sharing;
    for (const Domain domain : {Domain::Rectangle, Domain::Triangle})
      for (int side = 0; side < sidesOf(domain); ++side)
        for (const bool reversed : {false, true}) {
          PatchSet one = oracle::randomPatch(random, domain, n, n, 1e3);
          const std::vector<glm::dvec4> old = sidePoints(one, one.patches[0], side);
          for (glm::dvec4& point : one.points)
            for (int i = 0; i <= n; ++i)
              if (point == old[size_t(i)]) {
                point = curve[size_t(reversed ? n - i : i)];
                break;
              }
          sharing.push_back({int(set.patches.size()), side, reversed});
          append(set, one);
        }
    for (int m = 1; m <= 64; ++m)
      for (int i = 0; i <= m; ++i) {
        const size_t base = places.size();
        for (const auto& [patch, side, reversed] : sharing) {
          const Domain domain = set.patches[size_t(patch)].domain;
          if (places.size() > base) pairs.push_back({base, places.size()});
          places.push_back({size_t(patch), place(domain, side, reversed ? m - i : i, m), n == 3});
        }
      }
  }
  const std::vector<Result> results = evaluated(set, places);
  size_t different = 0;
  for (const auto& [a, b] : pairs)
    different += std::memcmp(&results[a].jet[0], &results[b].jet[0], sizeof(glm::vec4)) != 0;
  EXPECT_EQ(different, 0U) << "of " << pairs.size();
}

TEST_F(BezierShader, NormalsOfTheTeapotAreThoseOfDoublePrecision) {
  const PatchSet set = rounded(scene::teapot());
  std::vector<Place> places;
  for (size_t p = 0; p < set.patches.size(); ++p)
    for (int j = 0; j <= 9; ++j)
      for (int i = 0; i <= 9; ++i) places.push_back({p, {i, 9, j, 9}, true});
  const std::vector<Result> results = evaluated(set, places);
  for (size_t i = 0; i < places.size(); ++i) {
    const Patch& patch = set.patches[places[i].patch];
    const SurfaceNormal normal = normalAt(set, patch, pointAt(patch, places[i].at));
    EXPECT_LT(glm::length(glm::dvec3(results[i].normal) - normal.direction), 1e-4) << places[i].patch;
    EXPECT_EQ(results[i].normal.w, float(normal.rung)) << places[i].patch;
  }
}

}  // namespace
}  // namespace limen::surfaces
