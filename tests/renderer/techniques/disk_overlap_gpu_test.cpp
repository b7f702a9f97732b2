// SPDX-License-Identifier: BSD-3-Clause
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/reflections/cones/cone_bindings.h"
#include "renderer/techniques/reflections/cones/disk_overlap.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::techniques {
namespace {

class DiskOverlapsOnGpu : public gl::GlTest {
 protected:
  static std::vector<glm::vec4> onGpu(const std::vector<std::array<glm::dvec2, 3>>& triangles) {
    std::vector<glm::vec4> packed;
    for (const auto& triangle : triangles) {
      packed.emplace_back(triangle[0].x, triangle[0].y, triangle[1].x, triangle[1].y);
      packed.emplace_back(triangle[2].x, triangle[2].y, 0.0F, 0.0F);
    }
    const gl::Buffer in(packed), out(std::vector<glm::vec4>(triangles.size()));
    in.bindStorage(kOverlapTrianglesBuffer);
    out.bindStorage(kOverlapsBuffer);
    const gl::Program& program =
        context().programs().compute("renderer/techniques/reflections/cones/disk_overlaps.comp.glsl");
    program.set("count", static_cast<uint32_t>(triangles.size()));
    program.use();
    glDispatchCompute(static_cast<GLuint>((triangles.size() + kOverlapGroup - 1) / kOverlapGroup), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    return out.read<glm::vec4>();
  }
};

// The cases in double precision share no formula with the sums over edges. In single precision a sum of six
// terms of the size of the disk errs by some 6e-7, and arctangents of drivers by 1e-6 each; a chord near a
// tangent is uncertain by the square root of 1e-7, but so thin that its area is not. A centroid errs by that
// over the area.
TEST_F(DiskOverlapsOnGpu, EqualTheCasesInDoublePrecision) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<std::array<glm::dvec2, 3>> triangles(5000);
  for (auto& triangle : triangles) {
    const double size = std::exp(1.2 * number(random));
    // Corners as the shader has them.
    for (glm::dvec2& corner : triangle)
      corner = glm::dvec2(glm::vec2(1.5 * size * glm::dvec2(number(random), number(random))));
  }
  const std::vector<glm::vec4> found = onGpu(triangles);
  int met = 0;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const DiskOverlap expected = diskOverlapByCases(triangles[i]);
    ASSERT_NEAR(found[i].x, expected.area, 1e-5);
    if (expected.area < 1e-2) continue;
    ++met;
    ASSERT_NEAR(glm::length(glm::dvec2(found[i].y, found[i].z) - expected.centroid), 0.0,
                1e-5 / std::min(expected.area, 1.0));
  }
  EXPECT_GT(met, 2500);
}

TEST_F(DiskOverlapsOnGpu, AreSoundForDegenerateTriangles) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<glm::vec4> found =
      onGpu({{},
             {glm::dvec2(-3.0), glm::dvec2(3.0), glm::dvec2(3.0)},
             {glm::dvec2(-2.0, 0.0), glm::dvec2(0.5, 0.0), glm::dvec2(2.0, 0.0)},
             {glm::dvec2(1.0, 0.0), glm::dvec2(3.0, 1.0), glm::dvec2(3.0, -1.0)},
             {glm::dvec2(nan), glm::dvec2(1.0), glm::dvec2(0.0)}});
  for (const glm::vec4& one : found) EXPECT_EQ(one, glm::vec4(0.0F));
}

}  // namespace
}  // namespace limen::techniques
