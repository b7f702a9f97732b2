// SPDX-License-Identifier: BSD-3-Clause
// What traces shadow rays makes no difference: packets against single rays, the GPU against the CPU.
#include <algorithm>
#include <cmath>

#include "renderer/references/compute_tracer.h"
#include "renderer/references/embree_tracer.h"
#include "renderer/scene/light.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/renderer/references/render_reference.h"

namespace limen::references {
namespace {

constexpr int64_t kSamples = 256;

/// The receivers of a scene's picture.
class View {
 public:
  View(gl::Context& context, const scene::Scene& scene, glm::ivec2 sizePx)
      : gpuScene_(scene), frame_(context, scene, gpuScene_, sizePx), triangles(scene, gpuScene_.anchor()) {
    frame_.begin();
    points = readReceiverPoints(frame_, triangles);
    frame_.end();
  }
  glm::dvec3 anchor() const { return gpuScene_.anchor(); }
  const ray_tracing::RayScene& rays() { return gpuScene_.rays(frame_.context()); }

 private:
  frame::GpuScene gpuScene_;
  frame::Frame frame_;

 public:
  Triangles triangles;
  std::vector<ReceiverPoint> points;
};

/// How far, as a share of the largest coordinate difference, a segment is from changing its mind: from the
/// outline of a triangle at either side. Double precision.
double distanceFromTie(const Triangles& triangles, const ReceiverPoint& from, glm::dvec3 to) {
  const glm::dvec3 d = to - from.position;
  double least = 1e300;
  for (uint32_t i = 0; i < triangles.count(); ++i) {
    if (i == from.triangle) continue;
    const glm::dvec3 corners[] = {triangles.corner(i, 0), triangles.corner(i, 1), triangles.corner(i, 2)};
    double reach = glm::length(d);
    for (const glm::dvec3 corner : corners) reach = std::max(reach, glm::length(corner - from.position));
    // The plane itself counts: it passes through an end of the segment.
    const glm::dvec3 n = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const auto off = [&](glm::dvec3 point) { return std::abs(glm::dot(n, point - corners[0])); };
    least = std::min(least, off(to) / reach);
    for (int k = 0; k < 3; ++k) {
      // From the segment to the edge.
      const glm::dvec3 a = corners[k], e = corners[(k + 1) % 3] - a, r = from.position - a;
      const double dd = glm::dot(d, d), ee = glm::dot(e, e), de = glm::dot(d, e), dr = glm::dot(d, r),
                   er = glm::dot(e, r), determinant = dd * ee - de * de;
      double s = determinant > 0.0 ? glm::clamp((de * er - dr * ee) / determinant, 0.0, 1.0) : 0.0;
      const double t = glm::clamp((er + s * de) / ee, 0.0, 1.0);
      s = glm::clamp((t * de - dr) / dd, 0.0, 1.0);
      least = std::min(least, glm::length(r + s * d - t * e) / reach);
    }
  }
  return least;
}

class Tracers : public gl::GlTest {
 protected:
  /// Rays that one tracer finds hidden and the other does not are at most 1 in 1e5, one for a small picture,
  /// and each passes within the rounding of coordinates of an outline: 2^-20 of the way, see
  /// tests/renderer/ray_tracing/trace_test.cpp.
  void expectSameRays(const scene::Scene& scene, const std::string& name, int side = 16, uint64_t part = 0) {
    View view(context(), scene, {64, 48});
    const LightShapeMap map(scene.lights[0]);
    const LightSamples samples{scene.lights[0], map, kSamples, side, 7, part};
    EmbreeTracer cpu(view.triangles);
    ComputeTracer gpu(context(), view.rays(), view.triangles);
    const auto onCpu = cpu.trace(view.points, samples, view.anchor()),
               onGpu = gpu.trace(view.points, samples, view.anchor());
    ASSERT_EQ(onCpu.size(), onGpu.size());
    int64_t rays = 0, seen = 0, differing = 0, explained = 0;
    for (size_t i = 0; i < onCpu.size(); ++i) {
      EXPECT_EQ(onCpu[i].rays, onGpu[i].rays) << name;
      rays += onCpu[i].rays, seen += onCpu[i].seen;
      if (onCpu[i].seen == onGpu[i].seen) continue;
      if (differing > 20) {
        ++differing;
        continue;
      }
      const int64_t apart = std::abs(int64_t{onCpu[i].seen} - int64_t{onGpu[i].seen});
      differing += apart;
      int64_t ties = 0;
      for (int64_t sample = 0; sample < kSamples; ++sample) {
        const glm::dvec3 to = samples.point(view.points[i].pixel, sample) - view.anchor();
        if (glm::dot(view.points[i].normal, to - view.points[i].position) > 0.0)
          ties += distanceFromTie(view.triangles, view.points[i], to) < 0x1p-20;
      }
      explained += std::min(apart, ties);
    }
    EXPECT_GT(rays, 30000) << name;
    EXPECT_GT(seen, 0) << name;
    EXPECT_LT(seen, rays) << name;
    EXPECT_LE(double(differing), std::max(1.0, 1e-5 * double(rays))) << name;
    EXPECT_EQ(explained, differing) << name;
    RecordProperty(name + "_differing", std::to_string(differing) + " of " + std::to_string(rays));
  }
};

TEST_F(Tracers, PacketsAgreeWithSingleRays) {
  for (const char* name : {"two_boxes", "cornell_box", "columns_hall", "degenerate_soup", "foliage"}) {
    const scene::Scene scene = builtScene(name);
    const View view(context(), scene, {48, 36});
    const EmbreeScene embree(view.triangles);
    const LightShapeMap map(scene.lights[0]);
    const LightSamples samples{scene.lights[0], map, 64, 8, 3};
    const std::vector<ShadowCounts> packets =
        EmbreeTracer(view.triangles).trace(view.points, samples, view.anchor());
    size_t differing = 0, rays = 0;
    for (size_t i = 0; i < view.points.size(); ++i) {
      ShadowCounts singles{0, 0};
      for (int64_t sample = 0; sample < samples.count; ++sample) {
        const glm::dvec3 to = samples.point(view.points[i].pixel, sample) - view.anchor();
        if (!(glm::dot(view.points[i].normal, to - view.points[i].position) > 0.0)) continue;
        ++singles.rays;
        singles.seen += !embree.occluded(view.points[i], to);
      }
      rays += singles.rays;
      EXPECT_EQ(singles.rays, packets[i].rays);
      differing += singles.seen != packets[i].seen;
    }
    EXPECT_GT(rays, 10000U) << name;
    EXPECT_EQ(differing, 0U) << name;
  }
}

TEST_F(Tracers, TheGpuAgreesWithTheCpuOnScenesOfEveryKind) {
  for (const char* name :
       {"two_boxes", "cornell_box", "columns_hall", "comb", "card_stack", "degenerate_soup"})
    expectSameRays(builtScene(name), name);
  expectSameRays(builtScene("foliage", {{"leaves", int64_t{2000}}}), "foliage");
  expectSameRays(builtScene("sphere_grid", {{"tessellation", int64_t{12}}}), "sphere_grid");
}

TEST_F(Tracers, TheGpuAgreesWithTheCpuForEveryShapeOfLightAndPattern) {
  for (const char* shape : {"rectangle", "disc", "polygon"})
    for (const int side : {16, 0})
      expectSameRays(builtScene("two_boxes", {{"light_shape", shape}, {"light_size", 3.0}}),
                     shape + std::to_string(side), side, 5);
  scene::Scene concave = builtScene("two_boxes", {{"light_size", 3.0}});
  concave.lights[0].shape = scene::LightShape::Polygon;
  concave.lights[0].outline = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.5, 0.2}, {0.0, 1.0}};
  expectSameRays(concave, "concave");
}

TEST_F(Tracers, TheGpuAgreesWithTheCpuAtEveryScaleAndPlace) {
  for (const auto& [scale, offset] : {std::pair(1e-4, 0.0), {1e4, 0.0}, {1.0, 1e4}})
    expectSameRays(builtScene("two_boxes", {{"scale", scale}, {"offset", offset}}),
                   "scale" + std::to_string(scale) + "_" + std::to_string(offset));
}

TEST_F(Tracers, TheGpuAgreesWithTheCpuWhereSurfacesTouch) {
  scene::Scene touching;
  scene::addGround(touching, 6.0);
  scene::Mesh cards = scene::card({0.0, 0.25, 0.0}, {0.5, 0.0, 0.0}, {0.0, 0.25, 0.0});
  scene::append(cards, scene::card({0.6, 0.0, 0.6}, {0.0, 0.0, 0.2}, {0.2, 0.0, 0.0}));
  scene::append(cards, scene::card({-0.6, 0.1, 0.4}, {0.0, 0.0, 0.2}, {0.2, 0.1, 0.0}));
  scene::addPart(touching, "cards", cards, glm::vec3(0.5F));
  touching.lights = {scene::lightTowards({-0.5, 2.0, 1.0}, {0.0, 0.0, 0.0}, {0.5, 0.4})};
  scene::setStillCamera(touching, scene::orbitCamera({0.0, 0.1, 0.0}, 3.5, 20.0, 35.0));
  expectSameRays(touching, "touching");
}

TEST_F(Tracers, TheGpuSendsRaysToTheSamePoints) {
  const glm::dvec3 anchor(0.3, -0.2, 0.1);
  for (const scene::LightShape shape :
       {scene::LightShape::Rectangle, scene::LightShape::Disc, scene::LightShape::Polygon})
    for (const int side : {0, 50}) {
      const scene::AreaLight light =
          scene::withShape(scene::lightTowards({1.0, 2.0, 3.0}, {}, {0.7, 0.4}), shape);
      const LightShapeMap map(light);
      const LightSamples samples{light, map, 2500, side, 11, 3};
      const Triangles none(scene::Scene{}, anchor);
      const ray_tracing::RayScene nothing(context(), {}, {});
      ComputeTracer gpu(context(), nothing, none);
      double worst = 0.0;
      for (const uint32_t pixel : {0U, 77U, 0xfffffU}) {
        const std::vector<glm::dvec3> points = gpu.lightPoints(context(), samples, anchor, pixel);
        ASSERT_EQ(points.size(), 2500U);
        for (int64_t i = 0; i < samples.count; ++i)
          worst = std::max(worst, glm::length(points[size_t(i)] - (samples.point(pixel, i) - anchor)));
      }
      // Some tens of roundings of numbers up to 4.
      EXPECT_LT(worst, 1e-14) << int(shape) << ' ' << side;
    }
}

TEST_F(Tracers, CountsOfSamplesThatFillNoGroupAreWhole) {
  const scene::Scene scene = builtScene("two_boxes");
  View view(context(), scene, {24, 16});
  const LightShapeMap map(scene.lights[0]);
  ComputeTracer gpu(context(), view.rays(), view.triangles);
  EmbreeTracer cpu(view.triangles);
  for (const int64_t count : {1, 4, 5, 16, 25, 100, 289}) {
    const LightSamples samples{scene.lights[0], map, count, 0, 3};
    const auto onGpu = gpu.trace(view.points, samples, view.anchor()),
               onCpu = cpu.trace(view.points, samples, view.anchor());
    for (size_t i = 0; i < view.points.size(); ++i) {
      ASSERT_EQ(onGpu[i].rays, onCpu[i].rays) << count;
      ASSERT_EQ(onGpu[i].seen, onCpu[i].seen) << count;
    }
  }
}

TEST_F(Tracers, ProductsOfBothReferencesAgree) {
  for (const auto& [name, scene] : {std::pair("soft_shadows/ray_traced", "two_boxes"),
                                    {"soft_shadows/ray_traced_colours", "two_colour_light"}}) {
    const scene::Scene built = builtScene(scene);
    const Given common = {{"samples", int64_t{64}}};
    Given cpu = common, gpu = common;
    cpu["tracer"] = "cpu", gpu["tracer"] = "gpu";
    const Rendered one = renderReference(context(), built, name, cpu, {64, 48}),
                   other = renderReference(context(), built, name, gpu, {64, 48});
    size_t differing = 0;
    ASSERT_EQ(one.visibility.data.size(), other.visibility.data.size());
    for (size_t i = 0; i < one.visibility.data.size(); ++i)
      differing += one.visibility.data[i] != other.visibility.data[i];
    EXPECT_LE(differing, 4U) << name;  // a ray, in each channel
    EXPECT_EQ(one.counters.at("rays"), other.counters.at("rays")) << name;
  }
}

TEST_F(Tracers, ASceneWithoutTrianglesHidesNothing) {
  scene::Scene scene;
  const Triangles triangles(scene, glm::dvec3(0.0));
  scene::AreaLight light;
  light.centre = {0.0, 2.0, 0.0};
  const LightShapeMap map(light);
  const LightSamples samples{light, map, 16, 4, 1};
  const auto counts = ComputeTracer(context(), ray_tracing::RayScene(context(), {}, {}), triangles)
                          .trace({ReceiverPoint{0, 0, {}, {0.0, 1.0, 0.0}}}, samples, {});
  EXPECT_EQ(counts.at(0).rays, 16U);
  EXPECT_EQ(counts.at(0).seen, 16U);
}

}  // namespace
}  // namespace limen::references
