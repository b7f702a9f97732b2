// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/g_buffer.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

constexpr glm::ivec2 kSize{56, 40};

class GBufferTest : public gl::GlTest {};

/// Rays through the pixels of a frame, relative to the anchor; their parameter is the distance along the
/// view.
struct PixelRays {
  explicit PixelRays(const Frame& frame)
      : toAnchor(glm::inverse(frame.anchorToCamera())), size(frame.sizePx()) {
    eye = glm::dvec3(toAnchor[3]);
    scale = {frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()};
  }
  glm::dvec3 direction(int x, int y, glm::dvec2 offset = glm::dvec2(0.0)) const {
    // Row 0 is the top.
    const glm::dvec2 ndc = 2.0 * (glm::dvec2(x, y) + 0.5 + offset) / glm::dvec2(size) - 1.0;
    return glm::dmat3(toAnchor) * glm::dvec3(ndc.x * scale.x, -ndc.y * scale.y, -1.0);
  }
  glm::dmat4 toAnchor;
  glm::ivec2 size;
  glm::dvec3 eye;
  glm::dvec2 scale;
};

std::vector<scene::Scene> scenes() {
  std::vector<scene::Scene> out;
  out.push_back(builtScene("two_boxes"));
  out.push_back(builtScene("two_boxes", {{"scale", 1e-4}}));
  out.push_back(builtScene("two_boxes", {{"scale", 1e4}}));
  out.push_back(builtScene("two_boxes", {{"offset", 1e4}}));
  out.push_back(builtScene("sphere_grid", {{"tessellation", int64_t{2}}}));
  out.push_back(builtScene("pole"));
  return out;
}

TEST_F(GBufferTest, TriangleIdsAreThoseOfRaysUpToTheRastersSnapping) {
  for (const scene::Scene& scene : scenes()) {
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, kSize);
    frame.begin();
    const std::vector<uint32_t> ids = frame.get<TriangleIds>().texture().readUint();
    frame.end();
    const BruteForce truth(scene, gpuScene.anchor());
    const PixelRays rays(frame);
    size_t different = 0, unexplained = 0;
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x; ++x) {
        const uint32_t id = ids[static_cast<size_t>(y * kSize.x + x)];
        if (truth.trace(rays.eye, rays.direction(x, y), 0.0).triangle == id) continue;
        ++different;
        bool explained = false;
        for (const glm::dvec2 offset : snappingOffsets())
          explained = explained || truth.trace(rays.eye, rays.direction(x, y, offset), 0.0).triangle == id;
        unexplained += !explained;
      }
    EXPECT_EQ(unexplained, 0U) << scene.name;
    // Of the pixels that an edge crosses, 2 in 128 have their centre within 1/128 of it; here 2 edges cross a
    // pixel at the very most.
    EXPECT_LE(different, static_cast<size_t>(kSize.x * kSize.y) * 4 / 128) << scene.name;
  }
}

TEST_F(GBufferTest, PositionsDepthsAndNormalsAreThoseOfTheRayOnTheTrianglesPlane) {
  for (const scene::Scene& scene : scenes()) {
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, kSize);
    frame.begin();
    const std::vector<uint32_t> ids = frame.get<TriangleIds>().texture().readUint();
    const Image position = frame.get<GBufferChannel>(ChannelSetting{Channel::Position}).texture().read();
    const Image normal = frame.get<GBufferChannel>(ChannelSetting{Channel::Normal}).texture().read();
    const Image depth = frame.get<GBufferChannel>(ChannelSetting{Channel::Depth}).texture().read();
    frame.end();
    const BruteForce truth(scene, gpuScene.anchor());
    const PixelRays rays(frame);
    size_t compared = 0;
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x; ++x) {
        const uint32_t id = ids[static_cast<size_t>(y * kSize.x + x)];
        if (id == TriangleIds::kNone) {
          EXPECT_EQ(position.at(x, y, 3), 0.0F);
          EXPECT_EQ(depth.at(x, y), 0.0F);
          continue;
        }
        const glm::dvec3 direction = rays.direction(x, y), n = truth.normal(id);
        const double cosine = std::abs(glm::dot(n, direction)) / glm::length(direction);
        const double distance = truth.planeDistance(id, rays.eye, direction);
        // Float's error in the plane is magnified by one over the cosine of the angle of incidence.
        const double tolerance = 1e-5 * distance * std::max(1.0, 0.1 / cosine);
        const glm::dvec3 expected = rays.eye + direction * distance;
        const glm::dvec3 p(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
        EXPECT_LE(glm::length(p - expected), tolerance) << scene.name << ' ' << x << ' ' << y;
        EXPECT_NEAR(depth.at(x, y), distance, tolerance);
        EXPECT_EQ(position.at(x, y, 3), 1.0F);
        const glm::dvec3 towards = glm::dot(n, direction) > 0.0 ? -n : n;
        const glm::dvec3 made(normal.at(x, y, 0), normal.at(x, y, 1), normal.at(x, y, 2));
        EXPECT_LE(glm::length(made - towards), 1e-4);
        ++compared;
      }
    EXPECT_GT(compared, 1000U) << scene.name;
  }
}

TEST_F(GBufferTest, ReceiversAreWhatFacesTheLightInTheLightsSpace) {
  for (const scene::Scene& scene : scenes()) {
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, kSize);
    frame.begin();
    const std::vector<uint32_t> ids = frame.get<TriangleIds>().texture().readUint();
    const Image position = frame.get<GBufferChannel>(ChannelSetting{Channel::Position}).texture().read();
    const Image receivers = frame.get<Receivers>().texture().read();
    frame.end();
    const BruteForce truth(scene, gpuScene.anchor());
    const PixelRays rays(frame);
    const scene::AreaLight& light = scene.lights[0];
    const double extent = glm::length(light.centre - gpuScene.anchor());
    size_t facing = 0, averted = 0;
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x; ++x) {
        const uint32_t id = ids[static_cast<size_t>(y * kSize.x + x)];
        if (id == TriangleIds::kNone) {
          EXPECT_EQ(receivers.at(x, y, 3), -1.0F);
          continue;
        }
        const glm::dvec3 p(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
        const glm::dvec3 fromLight = p + gpuScene.anchor() - light.centre;
        glm::dvec3 n = truth.normal(id);
        if (glm::dot(n, p - rays.eye) > 0.0) n = -n;
        const double z = glm::dot(fromLight, light.direction()),
                     cosine = -glm::dot(n, glm::normalize(fromLight));
        if (std::abs(z) < 1e-4 * extent || std::abs(cosine) < 1e-3) continue;  // either side is right
        if (z < 0.0 || cosine < 0.0) {
          EXPECT_EQ(receivers.at(x, y, 3), -1.0F);
          ++averted;
          continue;
        }
        ++facing;
        const glm::dvec3 expected(glm::dot(fromLight, light.axisX), glm::dot(fromLight, light.axisY), z);
        const glm::dvec3 q(receivers.at(x, y, 0), receivers.at(x, y, 1), receivers.at(x, y, 2));
        EXPECT_LE(glm::length(q - expected), 1e-5 * extent) << scene.name;
        // Slope of z over the tangents u = x/z and v = y/z: differences of the plane's depth under a small
        // step.
        const glm::dvec3 m(glm::dot(n, light.axisX), glm::dot(n, light.axisY),
                           glm::dot(n, light.direction()));
        const auto depthAt = [&](double u, double v) {
          return glm::dot(m, expected) / glm::dot(m, {u, v, 1.0});
        };
        const double u = expected.x / z, v = expected.y / z, step = 1e-6;
        const double slope = std::abs(depthAt(u + step, v) - depthAt(u - step, v)) / (2.0 * step) +
                             std::abs(depthAt(u, v + step) - depthAt(u, v - step)) / (2.0 * step);
        if (cosine > 0.05) {
          EXPECT_NEAR(receivers.at(x, y, 3), slope, 1e-3 * (slope + z)) << scene.name;
        }
      }
    EXPECT_GT(facing, 500U) << scene.name;
    EXPECT_GT(averted, 0U) << scene.name;
  }
}

TEST_F(GBufferTest, AnInputIsMadeOnceAFrameAndOnlyIfAskedFor) {
  const scene::Scene scene = builtScene("two_boxes");
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, kSize);
  frame.begin();
  const Receivers& first = frame.get<Receivers>();
  EXPECT_EQ(&first, &frame.get<Receivers>());
  frame.end();
  std::vector<std::string> ran;
  for (const auto& pass : frame.passes().passes())
    if (pass.ran) ran.push_back(pass.name);
  EXPECT_THAT(ran, testing::UnorderedElementsAre("frame/triangle_ids", "frame/receivers"));
  frame.begin();
  frame.end();
  for (const auto& pass : frame.passes().passes()) EXPECT_FALSE(pass.ran) << pass.name;
}

}  // namespace
}  // namespace limen::frame
