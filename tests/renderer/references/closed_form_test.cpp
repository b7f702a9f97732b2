// SPDX-License-Identifier: BSD-3-Clause
// References against visibility known in closed form. All scenes have a light of extents w over a horizontal
// occluder, both parallel to the ground; light space has the light's centre at the origin and z downwards.
#include <cmath>
#include <numbers>

#include "tests/renderer/gl/gl_fixture.h"
#include "tests/renderer/references/render_reference.h"

namespace limen::references {
namespace {

constexpr glm::ivec2 kSize{64, 64};
/// Light over ground in the scenes half_plane and parallel_rectangle.
constexpr double kLightHeight = 2.0;

/// R32F rounding and the float rounding of points and vertices: 2^-24 of 4.5 m each at three places, over the
/// narrowest penumbra of these scenes on the light (0.3 m) and magnified by up to 2 towards the light.
constexpr double kFloatError = 3.0 * 4.5 * 0x1p-24 * 2.0 / 0.3 + 0x1p-24;

class ClosedForm : public gl::GlTest {
 protected:
  /// Calls check(visibility, point) for all receivers on the ground.
  template <class Check>
  void forGround(const Rendered& rendered, const Check& check) {
    size_t partial = 0;
    for (size_t i = 0; i < rendered.visibility.pixels(); ++i) {
      if (!rendered.isReceiver(i) || std::abs(rendered.point(i).z - kLightHeight) > 1e-4) continue;
      check(double(rendered.visibility.data[i]), rendered.point(i));
      partial += rendered.visibility.data[i] > 0.0F && rendered.visibility.data[i] < 1.0F;
    }
    EXPECT_GE(partial, 50U) << "the picture shows too little of the penumbra";
  }
};

/// Edge of the half-plane in light space: which coordinate it bounds, where, and on which side the occluder
/// is.
struct Edge {
  int axis = 0;
  double at = 0.0, side = 1.0;  ///< covers side * (x - at) < 0
};

/// The half_plane scene's edge x = 0 seen along the light's axes, found from the light alone.
Edge edgeOf(const scene::AreaLight& light) {
  const glm::dvec2 alongX(light.axisX.x, light.axisY.x);
  const int axis = std::abs(alongX.x) > 0.5 ? 0 : 1;
  return {axis, -light.centre.x * alongX[axis], alongX[axis]};
}

/// Seen from (x, z = H), the point s on the light lies over the occluder's plane at depth h' = H - h in
/// q = s + (x - s) h' / H. It is seen if q is beyond the edge at e: s (H - h') > H e - x h', that is s > s0 =
/// (H e - x h') / h. The light spans [-w/2, w/2], so V = 1/2 - s0 / w, clamped.
double halfPlaneOnRectangle(double x, double edge, double edgeHeight, double width) {
  const double s0 = (kLightHeight * edge - x * (kLightHeight - edgeHeight)) / edgeHeight;
  return glm::clamp(0.5 - s0 / width, 0.0, 1.0);
}

/// As above, but the part s > s0 of a disc with diameter w is a segment.
double halfPlaneOnDisc(double x, double edge, double edgeHeight, double width) {
  const double s0 = (kLightHeight * edge - x * (kLightHeight - edgeHeight)) / edgeHeight;
  const double t = glm::clamp(2.0 * s0 / width, -1.0, 1.0);
  return (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
}

TEST_F(ClosedForm, ExactUnionGivesTheLinearPenumbraOfAHalfPlane) {
  for (const double height : {0.3, 1.0, 1.6}) {
    const scene::Scene scene = builtScene("half_plane", {{"edge_height", height}});
    const Edge edge = edgeOf(scene.lights[0]);
    const double width = scene.lights[0].size[edge.axis];
    const Rendered rendered = renderReference(context(), scene, "soft_shadows/exact_union", {}, kSize);
    forGround(rendered, [&](double visibility, glm::dvec3 p) {
      EXPECT_NEAR(visibility,
                  halfPlaneOnRectangle(edge.side * p[edge.axis], edge.side * edge.at, height, width),
                  kFloatError * kLightHeight / height);
    });
  }
}

TEST_F(ClosedForm, ExactUnionGivesTheCircularSegmentsOfAHalfPlaneUnderADisc) {
  const scene::Scene scene = builtScene("half_plane", {{"light_shape", "disc"}});
  const Edge edge = edgeOf(scene.lights[0]);
  const double width = scene.lights[0].size[edge.axis];
  const Rendered rendered = renderReference(context(), scene, "soft_shadows/exact_union", {}, kSize);
  forGround(rendered, [&](double visibility, glm::dvec3 p) {
    // dV/ds0 of a disc is at most 4/pi of a rectangle's.
    EXPECT_NEAR(visibility, halfPlaneOnDisc(edge.side * p[edge.axis], edge.side * edge.at, 1.0, width),
                kFloatError * kLightHeight * 4.0 / std::numbers::pi);
  });
}

/// A straight edge crosses at most K = 2 n - 1 of n x n strata; the others are certain. Hoeffding for the K
/// independent values of weight 1 / n^2, all M pixels at once (Boole), with an error probability of 1e-3.
double stratifiedBound(int strata, size_t pixels) {
  const double crossed = 2.0 * strata - 1.0;
  return std::sqrt(0.5 * crossed * std::log(2.0 * double(pixels) / 1e-3)) / (double(strata) * strata);
}

TEST_F(ClosedForm, RayTracedLightGivesTheLinearPenumbraOfAHalfPlane) {
  const scene::Scene scene = builtScene("half_plane");
  const Edge edge = edgeOf(scene.lights[0]);
  const double width = scene.lights[0].size[edge.axis];
  const Rendered rendered =
      renderReference(context(), scene, "soft_shadows/ray_traced", {{"samples", int64_t{1024}}}, kSize);
  const double bound = stratifiedBound(32, rendered.receiverCount());
  forGround(rendered, [&](double visibility, glm::dvec3 p) {
    EXPECT_NEAR(visibility, halfPlaneOnRectangle(edge.side * p[edge.axis], edge.side * edge.at, 1.0, width),
                bound + kFloatError * kLightHeight);
  });
}

TEST_F(ClosedForm, RayTracedLightWithAnyPatternKeepsItsBoundOnADiscLight) {
  const scene::Scene scene = builtScene("half_plane", {{"light_shape", "disc"}});
  const Edge edge = edgeOf(scene.lights[0]);
  const double width = scene.lights[0].size[edge.axis];
  for (const char* pattern : {"stratified", "random"}) {
    const Rendered rendered = renderReference(context(), scene, "soft_shadows/ray_traced",
                                              {{"samples", int64_t{256}}, {"pattern", pattern}}, kSize);
    // ln(2 / 0.001) / 512, square root.
    EXPECT_NEAR(rendered.errorBound, 0.12184, 1e-5);
    size_t pixels = 0, within = 0;
    forGround(rendered, [&](double visibility, glm::dvec3 p) {
      ++pixels;
      within += std::abs(visibility - halfPlaneOnDisc(edge.side * p[edge.axis], edge.side * edge.at, 1.0,
                                                      width)) <= rendered.errorBound;
    });
    EXPECT_GE(double(within), 0.9975 * double(pixels)) << pattern;
  }
}

/// With S x S cell centres under an edge along the grid, V comes in steps of 1 / S: at most 1 / (2 S) off.
/// The map sees the edge shifted by up to a texel, which moves s0 by texel * h' * H / h tangents: a texel is
/// worth extent / resolution tangents, h' of which lie at the occluder, seen from the receiver magnified by H
/// / h.
TEST_F(ClosedForm, SampledLightGivesTheLinearPenumbraOfAHalfPlane) {
  const scene::Scene scene = builtScene("half_plane");
  const Edge edge = edgeOf(scene.lights[0]);
  const double width = scene.lights[0].size[edge.axis];
  constexpr int kSide = 16, kResolution = 1024;
  const Rendered rendered =
      renderReference(context(), scene, "soft_shadows/sampled_light",
                      {{"samples", int64_t{kSide * kSide}}, {"resolution", int64_t{kResolution}}}, kSize);
  // The half-plane covers at most [-4.7, 4.7] at a depth of 1, plus a texel's margin on each side.
  const double texel = 2.0 * 4.7 / (kResolution - 2);
  const double shift = texel * 1.0 * kLightHeight / 1.0 / width;
  forGround(rendered, [&](double visibility, glm::dvec3 p) {
    EXPECT_NEAR(visibility, halfPlaneOnRectangle(edge.side * p[edge.axis], edge.side * edge.at, 1.0, width),
                0.5 / kSide + shift);
  });
}

/// From (x, H), the rectangle [-a, a] at depth h' covers [(H c - x h') / h] for its corners c: an
/// axis-parallel rectangle on the light, whose overlap is a product of two intervals' overlaps.
TEST_F(ClosedForm, ExactUnionGivesTheOverlapOfAParallelRectangle) {
  for (const double height : {0.2, 0.7, 1.5}) {
    const scene::Scene scene = builtScene("parallel_rectangle", {{"height", height}});
    const scene::AreaLight& light = scene.lights[0];
    // "width" lies along the light's x axis.
    const glm::dvec2 half = 0.5 * glm::dvec2(0.6, 0.4), lightHalf = 0.5 * light.size;
    const Rendered rendered = renderReference(context(), scene, "soft_shadows/exact_union", {}, {96, 96});
    forGround(rendered, [&](double visibility, glm::dvec3 p) {
      double covered = 1.0;
      for (int axis = 0; axis < 2; ++axis) {
        const double shift = p[axis] * (kLightHeight - height);
        const double low = (-half[axis] * kLightHeight - shift) / height,
                     high = (half[axis] * kLightHeight - shift) / height;
        covered *= std::max(0.0, std::min(high, lightHalf[axis]) - std::max(low, -lightHalf[axis])) /
                   light.size[axis];
      }
      EXPECT_NEAR(visibility, 1.0 - covered, 2.0 * kFloatError * kLightHeight / height);
    });
  }
}

}  // namespace
}  // namespace limen::references
