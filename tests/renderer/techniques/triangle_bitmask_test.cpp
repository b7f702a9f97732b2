// SPDX-License-Identifier: BSD-3-Clause
// Triangle bitmasks bit by bit: against all triangles in double precision, and against Embree's shadow rays
// to the very same places on the light. Both leave out what rounding decides, which is counted.
#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bitmask.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "renderer/references/embree_scene.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bvh.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

/// A sample's answer: Edge if rounding decides it.
enum class Hidden { No, Edge, Yes };

/// Tests every sample against every triangle. A point that lies beside its place by e turns the plane through
/// it and an edge ab by e / distance(p, ab) and shifts it by e: with N = (a - p) x (b - a), a point at L from
/// p is on its side of the plane for sure if |N.(l - p)| > e (|N| + L |b - a|).
class TriangleTwin {
 public:
  TriangleTwin(const scene::Scene& scene, const references::Triangles& triangles, glm::dvec3 anchor,
               double rounding)
      : light_(scene.lights[0]), triangles_(triangles), anchor_(anchor), rounding_(rounding) {}

  std::vector<Hidden> samples(const references::ReceiverPoint& from,
                              const std::vector<glm::dvec3>& lights) const {
    std::vector<Hidden> out(lights.size(), Hidden::No);
    for (size_t s = 0; s < lights.size(); ++s) {
      const double above = glm::dot(from.normal, lights[s] - from.position);
      if (above < rounding_) out[s] = above < -rounding_ ? Hidden::Yes : Hidden::Edge;
    }
    const glm::dvec3 toLight = light_.direction();
    for (size_t t = 0; t < triangles_.count(); ++t) {
      if (t == from.triangle) continue;
      std::array<glm::dvec3, 3> q;
      std::array<double, 3> depths;
      for (int k = 0; k < 3; ++k) {
        q[static_cast<size_t>(k)] = triangles_.corner(t, k) - from.position;
        depths[static_cast<size_t>(k)] = glm::dot(q[static_cast<size_t>(k)], toLight);
      }
      // Wholly farther from the light than the receiver.
      if (std::min({depths[0], depths[1], depths[2]}) > rounding_) continue;
      enter(q, lights, from.position, out);
    }
    return out;
  }

 private:
  void enter(const std::array<glm::dvec3, 3>& q, const std::vector<glm::dvec3>& lights, glm::dvec3 p,
             std::vector<Hidden>& out) const {
    const glm::dvec3 n = glm::cross(q[1] - q[0], q[2] - q[0]);
    const double height = glm::dot(n, q[0]), side = height < 0.0 ? -1.0 : 1.0, size = glm::length(n);
    // Planes that the technique may take as going through the point.
    const bool flat = std::abs(height) < 4.0 * rounding_ * size;
    if (size == 0.0) return;
    std::array<glm::dvec3, 3> normals;
    std::array<double, 3> lengths, edges;
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 along = q[(k + 1) % 3] - q[k];
      normals[k] = side * glm::cross(q[k], along);
      lengths[k] = glm::length(normals[k]), edges[k] = glm::length(along);
    }
    // Lines across the light: what is beyond doubt at its corners is so all over it.
    for (size_t k = 0; k < 3; ++k) {
      bool apart = true;
      for (const glm::dvec2 unit : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
        const glm::dvec3 way = light_.point(unit) - anchor_ - p;
        apart = apart && glm::dot(normals[k], way) < -rounding_ * (lengths[k] + glm::length(way) * edges[k]);
      }
      if (apart) return;
    }
    const double perimeter = edges[0] + edges[1] + edges[2];
    for (size_t s = 0; s < lights.size(); ++s) {
      if (out[s] == Hidden::Yes) continue;
      const glm::dvec3 way = lights[s] - p;
      const double far = glm::length(way);
      // Beyond the triangle's plane, whose normal the same rounding turns.
      const double beyond = side * glm::dot(n, way) - std::abs(height);
      const double doubt = rounding_ * (size + far * perimeter);
      bool surely = beyond > doubt, perhaps = beyond > -doubt;
      for (size_t k = 0; k < 3 && perhaps; ++k) {
        const double inside = glm::dot(normals[k], way), unsure = rounding_ * (lengths[k] + far * edges[k]);
        surely = surely && inside > unsure, perhaps = inside > -unsure;
      }
      if (perhaps) out[s] = surely && !flat ? Hidden::Yes : Hidden::Edge;
    }
  }

  const scene::AreaLight& light_;
  const references::Triangles& triangles_;
  glm::dvec3 anchor_;
  double rounding_;
};

class TriangleMasks : public TechniqueTest {
 protected:
  struct Traced {
    std::vector<uint32_t> masks;
    Image product;
    std::vector<references::ReceiverPoint> points;
    std::vector<Counter> counters;
  };

  static Traced trace(const scene::Scene& scene, const std::string& pattern, glm::ivec2 sizePx,
                      const references::Triangles& triangles) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    TriangleBitmask made(TriangleBitmaskSettings{fromText<GridPattern>(pattern)});
    made.prepare(frame);
    frame.begin();
    made.render(frame);
    Traced out{{}, made.product().read(), references::readReceiverPoints(frame, triangles), {}};
    frame.end();
    out.counters = made.count(frame);
    out.masks = made.masks();
    return out;
  }

  static glm::dvec3 anchorOf(const scene::Scene& scene) { return frame::GpuScene(scene).anchor(); }
};

TEST_F(TriangleMasks, HoldTheSamplesThatTrianglesHide) {
  struct Case {
    const char *scene, *pattern;
    Given given;
    /// Share of the samples that may lie within rounding of an edge. In the soup four of eleven triangles
    /// have no area: all of a line across the light is in doubt for each.
    double doubtful = 0.01;
  };
  const std::vector<Case> cases = {
      {"two_boxes", "jittered_16", {{"gap", 0.0}, {"light_size", 4.0}}},
      {"box_under_light", "regular_16", {{"light_size", 2.0}}},
      {"sphere_grid", "regular_8", {{"tessellation", int64_t{3}}}},
      {"degenerate_soup", "jittered_16", {{"triangles", int64_t{300}}, {"light_size", 2.0}}, 0.03},
      {"two_boxes", "jittered_16", {{"light_shape", std::string("disc")}, {"light_size", 3.0}}}};
  for (const Case& each : cases) {
    const scene::Scene scene = makeScene(each.scene, each.given);
    const references::Triangles triangles(scene, anchorOf(scene));
    const Traced traced = trace(scene, each.pattern, {28, 21}, triangles);
    const references::EmbreeScene embree(triangles);
    const std::vector<glm::dvec2> places = lightSamples(fromText<LightPattern>(each.pattern));
    std::vector<glm::dvec3> lights;
    double farthest = 0.0;
    for (const glm::dvec2 place : places) lights.push_back(scene.lights[0].point(place) - anchorOf(scene));
    const scene::Camera camera = scene.camera.at(0.0);
    for (const glm::dvec3& corner : scene.mesh.positions)
      farthest = std::max(
          {farthest, glm::distance(corner, camera.eye), glm::distance(corner, scene.lights[0].centre)});
    // Positions go through two transforms with float matrices: four roundings for each sum of products and as
    // many for the matrix, at the distance from the camera or the light.
    const TriangleTwin twin(scene, triangles, anchorOf(scene), 16.0 * 0x1p-24 * farthest);
    int64_t samples = 0, onEdges = 0, wrong = 0, wrongRays = 0, unlikeRays = 0, partly = 0;
    for (const references::ReceiverPoint& point : traced.points) {
      const std::vector<Hidden> expected = twin.samples(point, lights);
      int hidden = 0, onLight = 0;
      for (size_t s = 0; s < places.size(); ++s) {
        if (!scene.lights[0].contains(places[s])) continue;
        const bool set = (traced.masks[point.pixel * (places.size() / 32) + s / 32] >> (s % 32) & 1U) != 0;
        const bool hit =
            glm::dot(point.normal, lights[s] - point.position) <= 0.0 || embree.occluded(point, lights[s]);
        ++onLight, hidden += set;
        ++samples, onEdges += expected[s] == Hidden::Edge;
        wrong += expected[s] != Hidden::Edge && set != (expected[s] == Hidden::Yes);
        wrongRays += expected[s] != Hidden::Edge && hit != (expected[s] == Hidden::Yes);
        unlikeRays += hit != set;
      }
      partly += hidden > 0 && hidden < onLight;
      EXPECT_FLOAT_EQ(traced.product.data[point.pixel],
                      static_cast<float>(onLight - hidden) / static_cast<float>(onLight));
    }
    std::printf("%s: %lld samples, %lld within rounding of an edge, %lld unlike rays\n", each.scene,
                static_cast<long long>(samples), static_cast<long long>(onEdges),
                static_cast<long long>(unlikeRays));
    EXPECT_GT(partly, 20) << each.scene;
    EXPECT_EQ(wrong, 0) << each.scene;
    EXPECT_EQ(wrongRays, 0) << each.scene;
    // What is left open must not be where anything could hide.
    EXPECT_LT(double(onEdges), each.doubtful * double(samples)) << each.scene;
    EXPECT_LE(unlikeRays, onEdges) << each.scene;
  }
}

TEST_F(TriangleMasks, LeaveNoGapsBetweenTriangles) {
  // A card, and the same card as 4^5 times as many triangles, whose new corners lie on the old edges up to
  // rounding: where all samples of the light lie behind the one, all lie behind the other.
  scene::Scene whole = makeScene("parallel_rectangle", {{"height", 1.0}, {"light_size", 0.5}});
  scene::Scene cut = whole;
  const scene::Part& card = cut.parts.back();
  for (int round = 0; round < 5; ++round) {
    std::vector<glm::uvec3> finer(cut.mesh.triangles.begin(),
                                  cut.mesh.triangles.begin() + card.firstTriangle);
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [found, added] = middles.try_emplace(std::minmax(a, b), 0U);
      if (added) {
        found->second = static_cast<uint32_t>(cut.mesh.positions.size());
        // Not the exact middle: interior edges must not fall together with rows of samples.
        cut.mesh.positions.push_back(
            glm::mix(cut.mesh.positions[std::min(a, b)], cut.mesh.positions[std::max(a, b)], 0.47));
      }
      return found->second;
    };
    for (size_t i = card.firstTriangle; i < cut.mesh.triangles.size(); ++i) {
      const glm::uvec3 t = cut.mesh.triangles[i];
      const uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
      for (const glm::uvec3& part : {glm::uvec3(t.x, ab, ca), glm::uvec3(ab, t.y, bc),
                                     glm::uvec3(ca, bc, t.z), glm::uvec3(ab, bc, ca)})
        finer.push_back(part);
    }
    cut.mesh.triangles = finer;
    cut.parts.back().triangleCount = static_cast<uint32_t>(finer.size()) - card.firstTriangle;
    cut.mesh.normals.clear(), cut.mesh.attributes.clear();
  }
  whole.mesh.normals.clear();
  const Rendered one = render(whole, "soft_shadows/triangle_bitmask", {}, {64, 48});
  const Rendered many = render(cut, "soft_shadows/triangle_bitmask", {}, {64, 48}, true);
  int dark = 0, differing = 0;
  for (size_t i = 0; i < one.product.pixels(); ++i) {
    if (one.receivers.data[4 * i + 3] < 0.0F) continue;
    const float a = one.product.data[i], b = many.product.data[i];
    dark += a == 0.0F;
    EXPECT_FALSE(a == 0.0F && b != 0.0F) << i;
    differing += a != b;
  }
  EXPECT_GT(dark, 50);
  // Samples within rounding of the card's rim, or of pixels that now see another triangle.
  EXPECT_LE(differing, 8);
  EXPECT_LT(many.counter("triangles_per_receiver"), 0.5 * 4096.0) << "the hierarchy culls nothing";
}

TEST(TriangleBvhTest, HoldsEveryTriangleOnceWithinItsBoxes) {
  std::vector<Corners3> corners;
  for (int i = 0; i < 500; ++i) {
    const float t = static_cast<float>(i);
    const glm::vec3 at(std::sin(t), std::cos(2.0F * t), i < 250 ? 0.0F : std::sin(3.0F * t));
    corners.push_back({at, at + glm::vec3(0.1F, 0.0F, 0.0F), at + glm::vec3(0.0F, 0.1F, 0.05F)});
  }
  for (int i = 0; i < 20; ++i) corners.push_back(corners[7]);  // all in one place
  corners.push_back({glm::vec3(NAN), glm::vec3(0.0F), glm::vec3(1.0F)});
  const TriangleBvh bvh = buildTriangleBvh(corners);
  ASSERT_EQ(bvh.triangles.size(), corners.size() - 1);
  size_t seen = 0;
  for (size_t node = 0; node < bvh.nodes.size(); ++node) {
    const TriangleBvh::Node& box = bvh.nodes[node];
    ASSERT_GT(box.skip, node);
    const size_t first = box.leaf / 8, count = box.leaf % 8;
    EXPECT_TRUE(count == 0 || first == seen) << "leaves out of order";
    seen += count;
    // All leaves up to `skip` lie within the box.
    for (size_t below = node; below < box.skip; ++below)
      for (size_t t = bvh.nodes[below].leaf / 8; t < bvh.nodes[below].leaf / 8 + bvh.nodes[below].leaf % 8;
           ++t)
        for (const glm::vec3& corner : {bvh.triangles[t].a, bvh.triangles[t].b, bvh.triangles[t].c})
          ASSERT_TRUE(glm::all(glm::lessThanEqual(box.low, corner)) &&
                      glm::all(glm::lessThanEqual(corner, box.high)));
  }
  EXPECT_EQ(seen, bvh.triangles.size());
  std::vector<bool> found(corners.size());
  for (const TriangleBvh::Triangle& triangle : bvh.triangles) {
    EXPECT_FALSE(found[triangle.id]);
    found[triangle.id] = true;
    EXPECT_EQ(triangle.b, corners[triangle.id][1]);
  }
  EXPECT_EQ(bvh.nodes[0].skip, bvh.nodes.size());
  EXPECT_EQ(buildTriangleBvh({}).triangles.size(), 0U);
}

}  // namespace
}  // namespace limen::techniques
