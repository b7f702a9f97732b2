// SPDX-License-Identifier: BSD-3-Clause
// Masks of backprojected quads against a test of every sample on its own, in whole numbers.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/bitmask_settings.h"
#include "renderer/techniques/soft_shadows/bitmask/half_space_table.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "tests/renderer/techniques/quad_mask_twin.h"
#include "tests/renderer/techniques/readback_bindings.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using Bits = std::vector<bool>;

std::vector<Step> hullOf(const Quad& quad, int side) {
  std::vector<Step> corners;
  for (const glm::vec2& corner : quad) corners.push_back(toStep(corner, side));
  return monotoneChain(corners);
}

int countSet(const Bits& bits) { return static_cast<int>(std::count(bits.begin(), bits.end(), true)); }

int countDiffering(const Bits& a, const Bits& b) {
  int out = 0;
  for (size_t i = 0; i < a.size(); ++i) out += a[i] != b[i];
  return out;
}

Bits unite(Bits a, const Bits& b) {
  for (size_t i = 0; i < a.size(); ++i) a[i] = a[i] || b[i];
  return a;
}

/// Mean and 99th percentile, for the test's output.
struct Distribution {
  std::vector<double> values;
  double mean() const {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
  }
  double p99() const {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0.0 : sorted[sorted.size() * 99 / 100];
  }
  std::string text() const { return "mean " + std::to_string(mean()) + ", p99 " + std::to_string(p99()); }
};

class QuadMasks : public TechniqueTest, public testing::WithParamInterface<SamplePattern> {
 protected:
  static std::vector<int> probe(const std::vector<Quad>& quads, gl::ShaderDefines defines, int results) {
    std::vector<glm::vec4> corners;
    for (const Quad& quad : quads) {
      corners.emplace_back(quad[0], quad[1]);
      corners.emplace_back(quad[2], quad[3]);
    }
    const gl::Buffer in(corners), out(static_cast<int64_t>(quads.size()) * results * 4, nullptr);
    const gl::Program& program =
        context().programs().compute("tests/renderer/techniques/quad_mask_readback.comp.glsl", defines);
    in.bindStorage(kQuadMaskReadbackQuadsBuffer);
    out.bindStorage(kQuadMaskReadbackResultsBuffer);
    program.set("count", static_cast<int>(quads.size()));
    program.dispatch({static_cast<int>(quads.size()), 1}, {64, 1});
    return out.read<int>();
  }

  static std::vector<Bits> masks(const std::vector<Quad>& quads, const SamplePattern& pattern, QuadMask mask,
                                 int tableSize = 64) {
    std::optional<gl::Texture> table;
    if (mask == QuadMask::HalfSpaceTable) {
      table.emplace(makeHalfSpaceTable(lightSamples(pattern.pattern), tableSize));
      table->bindTexture(kHalfSpacesUnit);
    }
    const int words = pattern.samples() / 32;
    gl::ShaderDefines defines = {{"TABLE_SIZE", std::to_string(tableSize)}};
    defineSamples(defines, pattern.pattern);
    defineEnum(defines, "QUAD_MASK", mask);
    const std::vector<int> raw = probe(quads, defines, words);
    std::vector<Bits> out(quads.size(), Bits(static_cast<size_t>(pattern.samples())));
    for (size_t i = 0; i < raw.size(); ++i)
      for (size_t bit = 0; bit < 32; ++bit)
        out[i / static_cast<size_t>(words)][i % static_cast<size_t>(words) * 32 + bit] =
            (static_cast<uint32_t>(raw[i]) >> bit) & 1U;
    return out;
  }

  /// The exact masks: what the samples of a strict hull on the grid are.
  static Bits exact(const Quad& quad, const SamplePattern& pattern) {
    return samplesWithin(hullOf(quad, pattern.side), pattern);
  }
};

TEST_P(QuadMasks, LightSamplesLieWhereThePatternSays) {
  const SamplePattern pattern = GetParam();
  const std::vector<glm::dvec2> samples = lightSamples(pattern.pattern);
  ASSERT_EQ(samples.size(), static_cast<size_t>(pattern.samples()));
  for (int j = 0; j < pattern.side; ++j)
    for (int i = 0; i < pattern.side; ++i)
      EXPECT_EQ(samples[static_cast<size_t>(j * pattern.side + i)], pattern.place(i, j));
}

TEST_P(QuadMasks, ArithmeticEqualsTestingEverySample) {
  const SamplePattern pattern = GetParam();
  const std::vector<Quad> quads = hardQuads(pattern, 9000);
  const std::vector<Bits> found = masks(quads, pattern, QuadMask::Arithmetic);
  int wrong = 0, covering = 0;
  for (size_t n = 0; n < quads.size(); ++n) {
    const Bits expected = exact(quads[n], pattern);
    covering += countSet(expected) > 0;
    if (found[n] != expected && ++wrong < 5)
      ADD_FAILURE() << "quad " << n << " of kind " << n % 9 << ": " << countDiffering(found[n], expected)
                    << " samples differ";
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(covering, 3000);
}

TEST_P(QuadMasks, ArithmeticOfARectangleIsTheMaskOfRectangles) {
  // The eighth kind is parallel to the light's edges: there all masks have one meaning. Corners are rounded
  // to the grid of the exact mask first.
  const SamplePattern pattern = GetParam();
  std::vector<Quad> quads;
  const std::vector<Quad> all = hardQuads(pattern, 9000);
  for (size_t n = 8; n < all.size(); n += 9) quads.push_back(all[n]);
  for (Quad& quad : quads)
    for (glm::vec2& corner : quad)
      corner = glm::vec2(glm::dvec2(toStep(corner, pattern.side)) / (4096.0 * pattern.side));
  const std::vector<Bits> byRows = masks(quads, pattern, QuadMask::Arithmetic),
                          byRectangle = masks(quads, pattern, QuadMask::Approximate);
  for (size_t n = 0; n < quads.size(); ++n) ASSERT_EQ(byRows[n], byRectangle[n]) << n;
}

TEST_P(QuadMasks, MicrotrisOfAQuadUniteToIt) {
  const SamplePattern pattern = GetParam();
  const std::vector<Quad> quads = hardQuads(pattern, 2700);
  const std::vector<Bits> whole = masks(quads, pattern, QuadMask::Arithmetic);
  std::vector<Bits> united(quads.size(), Bits(static_cast<size_t>(pattern.samples())));
  for (size_t missing = 0; missing < 4; ++missing) {
    std::vector<Quad> triangles = quads;
    // One corner gives way to the next, as where it does not block.
    for (Quad& quad : triangles) quad[missing] = quad[(missing + 1) % 4];
    const std::vector<Bits> parts = masks(triangles, pattern, QuadMask::Arithmetic);
    for (size_t n = 0; n < quads.size(); ++n) {
      ASSERT_EQ(unite(parts[n], whole[n]), whole[n]) << "a microtri reaches beyond quad " << n;
      united[n] = unite(united[n], parts[n]);
    }
  }
  for (size_t n = 0; n < quads.size(); ++n) ASSERT_EQ(united[n], whole[n]) << n;
}

TEST_P(QuadMasks, ATiltedPlaneCutIntoQuadsIsOneQuad) {
  // Vertices of a plane seen in perspective; an affine one, then one with a strong convergence of lines.
  const SamplePattern pattern = GetParam();
  for (const double convergence : {0.0, 0.7})
    for (const int cells : {1, 2, 3, 5, 8, 16, 33, 64}) {
      const auto vertex = [&](int x, int y) {
        const glm::dvec2 at(double(x) / cells, double(y) / cells);
        const double depth = 1.0 + convergence * (0.3 * at.x + 0.7 * at.y);
        return glm::vec2((0.05 + 0.93 * at.x - 0.21 * at.y) / depth + 0.1,
                         (0.03 + 0.17 * at.x + 1.4 * at.y) / depth);
      };
      std::vector<Quad> quads = {{vertex(0, 0), vertex(cells, 0), vertex(cells, cells), vertex(0, cells)}};
      for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x)
          quads.push_back({vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)});
      const std::vector<Bits> found = masks(quads, pattern, QuadMask::Arithmetic);
      Bits united(found[0].size());
      int setInAll = 0;
      for (size_t n = 1; n < found.size(); ++n) {
        united = unite(united, found[n]);
        setInAll += countSet(found[n]);
      }
      EXPECT_EQ(setInAll, countSet(united)) << "cells share samples at " << cells;
      EXPECT_GT(countSet(united), pattern.samples() / 4);
      // Vertices along the plane's edges are rounded, by half a step of the grid on either axis: a step at
      // most.
      const std::vector<Step> hull = hullOf(quads[0], pattern.side);
      for (int j = 0; j < pattern.side; ++j)
        for (int i = 0; i < pattern.side; ++i) {
          const auto bit = static_cast<size_t>(j * pattern.side + i);
          if (united[bit] == found[0][bit]) continue;
          EXPECT_LT(distanceFromEdges(hull, pattern.place(i, j), pattern.side) * 4096.0 * pattern.side, 1.0)
              << cells << " cells, sample (" << i << ", " << j << ")";
        }
    }
}

TEST_P(QuadMasks, ACornerFarOffTurnsItsEdgesByLittle) {
  // One corner beyond what the grid holds. It is moved towards the light's centre, so that its edges turn by
  // less than the light's diagonal (to the edge's other end, up to 2 from the centre) over 2048.
  const SamplePattern pattern = GetParam();
  std::vector<Quad> quads = hardQuads(pattern, 900);
  const std::vector<Quad> near = quads;
  for (size_t n = 0; n < quads.size(); ++n)
    quads[n][n % 4] = 0.5F + (quads[n][n % 4] - 0.5F) * (n % 3 == 0 ? 3e4F : n % 3 == 1 ? 1e9F : 1e18F);
  const std::vector<Bits> found = masks(quads, pattern, QuadMask::Arithmetic);
  for (size_t n = 0; n < quads.size(); ++n) {
    // The twin's corner is farther off by 10, so that a sample's distance from an edge has the rounding left
    // out here.
    Quad reachable = quads[n];
    const glm::dvec2 out = glm::dvec2(near[n][n % 4]) - 0.5;
    if (std::max(std::abs(out.x), std::abs(out.y)) < 0.1) continue;  // not far off after all
    reachable[n % 4] = glm::vec2(0.5 + out * (2e4 / std::max(std::abs(out.x), std::abs(out.y))));
    const std::vector<Step> hull = hullOf(reachable, pattern.side);
    const Bits expected = samplesWithin(hull, pattern);
    for (int j = 0; j < pattern.side; ++j)
      for (int i = 0; i < pattern.side; ++i) {
        const auto bit = static_cast<size_t>(j * pattern.side + i);
        if (found[n][bit] == expected[bit]) continue;
        EXPECT_LT(distanceFromEdges(hull, pattern.place(i, j), pattern.side), 2.0 * 2.0 / 2048.0)
            << "quad " << n << ", sample (" << i << ", " << j << ")";
      }
  }
}

TEST_P(QuadMasks, TableErrsOnlyWithinItsQuantisation) {
  const SamplePattern pattern = GetParam();
  std::vector<Quad> quads = hardQuads(pattern, 1800);
  const std::vector<Quad> mesh = meshQuads(12, 1200, 3);
  quads.insert(quads.end(), mesh.begin(), mesh.end());
  std::vector<double> means;
  for (const int size : {64, 128, 256, 512, 1024}) {
    if (size == 1024 && pattern.side == 32) continue;  // 128 MiB
    const std::vector<Bits> found = masks(quads, pattern, QuadMask::HalfSpaceTable, size);
    // Rounding of single precision in the distance, beside that of the table.
    const double bound = halfSpaceTableError(size) * (1.0 + 1e-3);
    Distribution wrongShare;
    int outside = 0;
    for (size_t n = 0; n < quads.size(); ++n) {
      // The table's hull is on the grid of 32 samples whatever the pattern.
      const std::vector<Step> hull = hullOf(quads[n], 32);
      std::vector<Step> scaled = hull;
      for (Step& corner : scaled) corner *= pattern.side;
      Bits expected(found[n].size(), hull.size() >= 3);
      for (int j = 0; j < pattern.side && hull.size() >= 3; ++j)
        for (int i = 0; i < pattern.side; ++i)
          for (size_t k = 0; k < hull.size(); ++k) {
            const Step a = scaled[k], b = scaled[(k + 1) % scaled.size()];
            if (doubledArea(a, b, Step(pattern.quarters(i, j)) * int64_t{1024 * 32}) < 0)
              expected[static_cast<size_t>(j * pattern.side + i)] = false;
          }
      if (n >= 1800)
        wrongShare.values.push_back(countDiffering(found[n], expected) / double(pattern.samples()));
      for (int j = 0; j < pattern.side; ++j)
        for (int i = 0; i < pattern.side; ++i) {
          const auto bit = static_cast<size_t>(j * pattern.side + i);
          if (found[n][bit] == expected[bit]) continue;
          if (hull.size() < 3 || distanceFromEdges(hull, pattern.place(i, j), 32) > bound) ++outside;
        }
    }
    EXPECT_EQ(outside, 0) << "size " << size;
    means.push_back(wrongShare.mean());
    std::printf("table %d, %s: share of samples wrong for a cell of 1/12 of the light: %s\n", size,
                limen::toText(pattern.pattern), wrongShare.text().c_str());
    RecordProperty("wrong_share_" + std::to_string(size), wrongShare.text());
  }
  // Lines known twice as well on either axis leave half of the wrong samples; the smallest table against the
  // largest.
  EXPECT_LT(means.back(), 0.5 * means.front());
  for (size_t i = 1; i < means.size(); ++i) EXPECT_LE(means[i], means[i - 1]);
}

TEST_P(QuadMasks, TableMasksOfBothSidesOfAnEdgeAreDisjoint) {
  // Triangles on both sides of one diagonal: what the table says of the diagonal is the complement for the
  // other.
  const SamplePattern pattern = GetParam();
  std::vector<Quad> left, right;
  for (const Quad& quad : meshQuads(2, 600, 11)) {
    left.push_back({quad[0], quad[1], quad[2], quad[2]});
    right.push_back({quad[0], quad[2], quad[3], quad[3]});
  }
  const std::vector<Bits> a = masks(left, pattern, QuadMask::HalfSpaceTable),
                          b = masks(right, pattern, QuadMask::HalfSpaceTable);
  int covered = 0;
  for (size_t n = 0; n < left.size(); ++n) {
    ASSERT_EQ(countSet(unite(a[n], b[n])), countSet(a[n]) + countSet(b[n])) << n;
    covered += countSet(a[n]) + countSet(b[n]);
  }
  EXPECT_GT(covered, 1000);
}

TEST_P(QuadMasks, ApproximateStaysWithinTheClampedQuadsBounds) {
  const SamplePattern pattern = GetParam();
  std::vector<Quad> quads = hardQuads(pattern, 4500);
  for (const int perLight : {4, 12, 32}) {
    const std::vector<Quad> mesh = meshQuads(perLight, 1000, static_cast<unsigned>(perLight));
    const std::vector<Bits> found = masks(mesh, pattern, QuadMask::Approximate);
    Distribution differing, excess;
    for (size_t n = 0; n < mesh.size(); ++n) {
      const Bits expected = exact(mesh[n], pattern);
      differing.values.push_back(countDiffering(found[n], expected) / double(pattern.samples()));
      excess.values.push_back((countSet(found[n]) - countSet(expected)) / double(pattern.samples()));
    }
    std::printf(
        "approximate, %s, cells of 1/%d of the light: share of samples that differ: %s; excess: mean %f\n",
        limen::toText(pattern.pattern), perLight, differing.text().c_str(), excess.mean());
    RecordProperty("differing_share_" + std::to_string(perLight), differing.text());
    quads.insert(quads.end(), mesh.begin(), mesh.end());
  }
  const std::vector<Bits> found = masks(quads, pattern, QuadMask::Approximate);
  for (size_t n = 0; n < quads.size(); ++n) {
    glm::vec2 low(1.0F), high(0.0F);
    for (const glm::vec2& corner : quads[n]) {
      low = glm::min(low, glm::clamp(corner, 0.0F, 1.0F));
      high = glm::max(high, glm::clamp(corner, 0.0F, 1.0F));
    }
    for (int j = 0; j < pattern.side; ++j)
      for (int i = 0; i < pattern.side; ++i) {
        const glm::dvec2 s = pattern.place(i, j);
        const bool set = found[n][static_cast<size_t>(j * pattern.side + i)];
        ASSERT_TRUE(!set || (low.x < s.x && s.x <= high.x && low.y < s.y && s.y <= high.y)) << "quad " << n;
      }
  }
}

TEST_P(QuadMasks, ApproximateNeighboursShareNoSampleAcrossAnEdge) {
  // Two cells of a mesh side by side: their rectangles meet at the middle of the edge between them.
  const SamplePattern pattern = GetParam();
  std::vector<Quad> left, right;
  for (const Quad& quad : meshQuads(3, 600, 5)) {
    const glm::vec2 across = quad[1] - quad[0];
    if (across.x <= 0.0F || quad[2].x <= quad[3].x) continue;  // folded
    left.push_back(quad);
    right.push_back({quad[1], quad[1] + across, quad[2] + across, quad[2]});
  }
  const std::vector<Bits> a = masks(left, pattern, QuadMask::Approximate),
                          b = masks(right, pattern, QuadMask::Approximate);
  ASSERT_GT(left.size(), 300U);
  for (size_t n = 0; n < left.size(); ++n)
    ASSERT_EQ(countSet(unite(a[n], b[n])), countSet(a[n]) + countSet(b[n])) << n;
}

INSTANTIATE_TEST_SUITE_P(Patterns, QuadMasks, testing::ValuesIn(kSamplePatterns), [](const auto& instance) {
  return std::string(limen::toText(instance.param.pattern));
});

using ConvexHull = QuadMasks;

TEST_P(ConvexHull, EqualsTheMonotoneChain) {
  const SamplePattern pattern = GetParam();
  const std::vector<Quad> quads = hardQuads(pattern, 9000);
  gl::ShaderDefines defines = {{"TABLE_SIZE", "64"}, {"HULL", "1"}};
  defineSamples(defines, LightPattern::Regular16);
  defineEnum(defines, "QUAD_MASK", QuadMask::Arithmetic);
  const std::vector<int> raw = probe(quads, defines, 9);
  std::array<int, 5> sizes{};
  for (size_t n = 0; n < quads.size(); ++n) {
    const std::vector<Step> expected = hullOf(quads[n], 16);
    const int* result = raw.data() + 9 * n;
    ++sizes.at(expected.size());
    ASSERT_EQ(result[0] != 0, expected.size() >= 3) << "quad " << n << " of kind " << n % 9;
    if (result[0] == 0) continue;
    std::vector<Step> corners;
    for (int k = 0; k < 4; ++k) corners.emplace_back(result[1 + 2 * k], result[2 + 2 * k]);
    // Counter-clockwise all the way round, and through the strict hull's corners in order: others lie on its
    // edges.
    std::vector<Step> strict;
    for (size_t k = 0; k < 4; ++k) {
      const Step before = corners[(k + 3) % 4], here = corners[k], after = corners[(k + 1) % 4];
      ASSERT_GE(doubledArea(before, here, after), 0) << "quad " << n;
      if (std::find(expected.begin(), expected.end(), here) != expected.end() &&
          (strict.empty() || strict.back() != here))
        strict.push_back(here);
    }
    if (strict.size() > 1 && strict.front() == strict.back()) strict.pop_back();
    ASSERT_EQ(strict.size(), expected.size()) << "quad " << n << " of kind " << n % 9;
    const auto start = std::find(strict.begin(), strict.end(), expected[0]);
    std::rotate(strict.begin(), start, strict.end());
    ASSERT_EQ(strict, expected) << "quad " << n << " of kind " << n % 9;
  }
  EXPECT_GT(sizes[3], 500);
  EXPECT_GT(sizes[4], 1000);
  EXPECT_GT(sizes[0] + sizes[1] + sizes[2], 500);
}

INSTANTIATE_TEST_SUITE_P(Hulls, ConvexHull, testing::Values(kSamplePatterns[1]),
                         [](const auto&) { return std::string("SevenPlaces"); });

}  // namespace
}  // namespace limen::techniques
