// SPDX-License-Identifier: BSD-3-Clause
// Peeled layers, maps of single parts and maps from other points of the light against rays.
#include <cmath>
#include <set>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/receivers_from.h"
#include "renderer/frame/shadow_map.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

constexpr int kTexels = 16, kLayers = 4;

/// Depths of the surfaces along rays through a map's texels, nearest first, by testing all triangles.
class RaysFrom {
 public:
  RaysFrom(const scene::Scene& scene, glm::dvec3 anchor, const LightFrustum& frustum, int part)
      : truth_(only(scene, part), anchor), light_(scene.lights[0]), anchor_(anchor), frustum_(frustum) {}

  std::vector<Hit> through(glm::dvec2 texel) const {
    const auto [eye, ray] = rayThrough(texel);
    std::vector<Hit> hits;
    double nearest = frustum_.near;
    while (hits.size() < kLayers) {
      const Hit hit = truth_.trace(eye, ray, nearest);
      if (!std::isfinite(hit.t)) break;
      nearest = hit.t * (1.0 + ShadowMapSettings{}.peelBias);
      hits.push_back(hit);
    }
    return hits;
  }

  /// Whether the ray has come to where two surfaces are one: the undersides of boxes lie on the ground, at
  /// height 0. A raster rounds their depths apart, so that a map may hold one of them or both in turn.
  bool coincident(glm::dvec2 texel, double t) const {
    const auto [eye, ray] = rayThrough(texel);
    return std::abs(eye.y + ray.y * t + anchor_.y) < 1e-6;
  }

 private:
  std::pair<glm::dvec3, glm::dvec3> rayThrough(glm::dvec2 texel) const {
    const glm::dvec2 tangent = frustum_.low + texel / double(kTexels) * (frustum_.high - frustum_.low);
    return {light_.centre + light_.axisX * frustum_.offset.x + light_.axisY * frustum_.offset.y - anchor_,
            light_.axisX * tangent.x + light_.axisY * tangent.y + light_.direction()};
  }

  static scene::Scene only(scene::Scene scene, int part) {
    if (part < 0) return scene;
    const scene::Part& chosen = scene.parts[static_cast<size_t>(part)];
    const auto first = scene.mesh.triangles.begin() + chosen.firstTriangle;
    scene.mesh.triangles = {first, first + chosen.triangleCount};
    return scene;
  }

  BruteForce truth_;
  scene::AreaLight light_;
  glm::dvec3 anchor_;
  LightFrustum frustum_;
};

class ShadowLayers : public gl::GlTest {
 protected:
  /// Texels whose rays meet the same triangles within the raster's snapping of vertices (1/256 pixel) have
  /// one answer, up to what such a step changes on a wall that the light sees at a grazing angle. Depth is
  /// near / z in float; near is at most a few tens of times smaller than z here, and the rounding of the
  /// interpolation of the order of 2^-23 of the nearest depth: 1e-5 of z.
  void expectLayers(const scene::Scene& scene, ShadowMapSettings settings, const std::string& what) {
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, {8, 8});
    frame.begin();
    settings.resolution = kTexels;
    settings.layer = 0;
    const RaysFrom rays(scene, gpuScene.anchor(), frame.get<ShadowDepth>(settings).frustum(), settings.part);
    std::vector<Image> layers;
    for (; settings.layer < kLayers; ++settings.layer)
      layers.push_back(frame.get<ShadowMap>(settings).texture().read());
    frame.end();
    int settled = 0;
    for (int y = 0; y < kTexels; ++y)
      for (int x = 0; x < kTexels; ++x) {
        const std::vector<Hit> hits = rays.through(glm::dvec2(x, y) + 0.5);
        std::vector<double> changes(hits.size(), 0.0);
        bool same = true;
        for (int corner = 0; corner < 4 && same; ++corner) {
          const glm::dvec2 moved(corner % 2 ? 1.0 : -1.0, corner / 2 ? 1.0 : -1.0);
          const std::vector<Hit> others = rays.through(glm::dvec2(x, y) + 0.5 + moved / 128.0);
          same = others.size() == hits.size();
          for (size_t i = 0; same && i < hits.size(); ++i) {
            same = others[i].triangle == hits[i].triangle;
            changes[i] = std::max(changes[i], std::abs(others[i].t - hits[i].t));
          }
        }
        if (!same) continue;
        ++settled;
        std::vector<double> measured;
        for (const Image& image : layers) {
          const double depth = image.at(x, y);
          const size_t last = measured.size() - 1;
          const bool again = !measured.empty() && last < hits.size() &&
                             rays.coincident(glm::dvec2(x, y) + 0.5, hits[last].t) &&
                             std::abs(depth - hits[last].t) <= 1e-5 * hits[last].t + changes[last];
          if (!again) measured.push_back(depth);
        }
        for (size_t layer = 0; layer < measured.size(); ++layer) {
          const double expected = layer < hits.size() ? hits[layer].t : double(kEmptyDepth);
          const double change = layer < hits.size() ? changes[layer] : 0.0;
          EXPECT_NEAR(measured[layer], expected, 1e-5 * expected + change)
              << what << ", layer " << layer << " at " << x << ' ' << y;
        }
      }
    EXPECT_GT(settled, kTexels * kTexels * 3 / 4) << what;
  }
};

TEST_F(ShadowLayers, AreTheSurfacesAlongEachRayInOrder) {
  for (const Raster raster : {Raster::Hardware, Raster::Compute})
    for (const char* name : {"box_under_light", "two_boxes"})
      expectLayers(builtScene(name), {.raster = raster}, name);
}

TEST_F(ShadowLayers, OfASmallerFrustumAndFromACornerOfTheLightToo) {
  for (const Raster raster : {Raster::Hardware, Raster::Compute}) {
    expectLayers(builtScene("two_boxes"), {.raster = raster, .extent = 0.4}, "smaller");
    expectLayers(builtScene("two_boxes"), {.raster = raster, .eye = {1.0, 0.0}}, "corner");
  }
}

TEST_F(ShadowLayers, OfAPartHoldThatPartAlone) {
  const scene::Scene scene = builtScene("two_boxes");
  for (const Raster raster : {Raster::Hardware, Raster::Compute})
    for (int part = 1; part < 3; ++part) {
      ASSERT_FALSE(scene.parts[static_cast<size_t>(part)].receiverOnly);
      expectLayers(scene, {.raster = raster, .part = part}, scene.parts[static_cast<size_t>(part)].name);
    }
}

TEST_F(ShadowLayers, BehindTheLastSurfaceThereIsNothing) {
  const scene::Scene scene = builtScene("half_plane");  // a card and the ground
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, {8, 8});
  for (const Raster raster : {Raster::Hardware, Raster::Compute}) {
    frame.begin();
    for (int layer = 2; layer < 8; ++layer) {
      const Image map =
          frame.get<ShadowMap>(ShadowMapSettings{.resolution = 64, .raster = raster, .layer = layer})
              .texture()
              .read();
      for (const float z : map.data) ASSERT_EQ(z, kEmptyDepth) << layer;
    }
    frame.end();
  }
}

TEST_F(ShadowLayers, HaveNamesOfTheirOwn) {
  std::set<std::string> keys;
  const std::vector<ShadowMapSettings> all = {{},
                                              {.layer = 1},
                                              {.layer = 2},
                                              {.layer = 1, .peelBias = 1e-3},
                                              {.layer = 1, .extent = 0.5},
                                              {.extent = 0.5},
                                              {.eye = {0.0, 0.0}},
                                              {.eye = {0.0, 1.0}},
                                              {.part = 0},
                                              {.part = 1}};
  for (const ShadowMapSettings& settings : all) keys.insert(settings.key());
  EXPECT_EQ(keys.size(), all.size());
  EXPECT_EQ(ShadowMapSettings{}.name(), "");
}

/// Depth of the ground plane y = 0 along a tangent from a point of the light; what a slope is the change of.
double groundDepth(const scene::AreaLight& light, glm::dvec2 eye, glm::dvec2 tangent) {
  const glm::dvec3 from = light.point(eye);
  const glm::dvec3 ray = light.axisX * tangent.x + light.axisY * tangent.y + light.direction();
  return -from.y / ray.y;
}

TEST_F(ShadowLayers, ReceiversFromAnotherPointHaveTheSlopeSeenFromThere) {
  const scene::Scene scene = builtScene("two_boxes", {{"light_size", 4.0}});
  const scene::AreaLight& light = scene.lights[0];
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, {32, 24});
  for (const glm::dvec2 eye : {glm::dvec2(0.0, 0.0), glm::dvec2(1.0, 0.25)}) {
    frame.begin();
    const Image usual = frame.get<Receivers>().texture().read();
    const Image moved = frame.get<ReceiversFrom>(EyeSetting{eye}).texture().read();
    frame.end();
    const glm::dvec2 offset = (eye - 0.5) * light.size;
    int onGround = 0;
    for (int y = 0; y < usual.height; ++y)
      for (int x = 0; x < usual.width; ++x) {
        if (usual.at(x, y, 3) < 0.0F) {
          EXPECT_LT(moved.at(x, y, 3), 0.0F);
          continue;
        }
        const glm::dvec3 p(moved.at(x, y, 0), moved.at(x, y, 1), moved.at(x, y, 2));
        EXPECT_NEAR(p.x + offset.x, usual.at(x, y, 0), 1e-5);
        EXPECT_NEAR(p.y + offset.y, usual.at(x, y, 1), 1e-5);
        EXPECT_EQ(moved.at(x, y, 2), usual.at(x, y, 2));
        const glm::dvec3 world =
            light.point(eye) + light.axisX * p.x + light.axisY * p.y + light.direction() * p.z;
        if (std::abs(world.y) > 1e-4) continue;
        ++onGround;
        const glm::dvec2 tangent = glm::dvec2(p) / p.z;
        constexpr double kStep = 1e-5;
        double slope = 0.0;
        for (int axis = 0; axis < 2; ++axis) {
          glm::dvec2 step(0.0);
          step[axis] = kStep;
          slope +=
              std::abs(groundDepth(light, eye, tangent + step) - groundDepth(light, eye, tangent - step)) /
              (2.0 * kStep);
        }
        EXPECT_NEAR(moved.at(x, y, 3), slope, 1e-3 * slope + 1e-4);
      }
    EXPECT_GT(onGround, 100);
  }
}

}  // namespace
}  // namespace limen::frame
