// SPDX-License-Identifier: BSD-3-Clause
// Light of pixels from the voxels that they see, beside rays in double precision to all voxels around.
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/voxel_propagation/light_grid.h"
#include "renderer/techniques/global_illumination/voxel_propagation/reconstruction_settings.h"
#include "renderer/techniques/global_illumination/voxel_propagation/seen_light.h"
#include "tests/renderer/scene/geometry_checks.h"
#include "tests/renderer/techniques/global_illumination/indirect_light_fixture.h"

namespace limen::techniques {
namespace {

constexpr float kAlbedo = 0.8F;
constexpr int kWidth = 64, kHeight = 48;

/// A floor with walls thinner than a voxel, one of them slanted, boxes, and plates closer above the floor
/// than a voxel is high.
scene::Scene clutteredFloor() {
  scene::Scene scene;
  const auto add = [&](const char* name, const scene::Mesh& mesh) {
    scene::addPart(scene, name, mesh, glm::vec3(kAlbedo));
  };
  add("floor", scene::box({-1.0, -0.1, -1.0}, {1.0, 0.0, 1.0}));
  add("wall", scene::box({-0.33, 0.0, -0.9}, {-0.3, 0.7, 0.5}));
  add("slanted wall", scene::card({0.4, 0.3, -0.5}, {0.35, 0.0, 0.3}, {0.1, 0.35, 0.0}));
  add("box", scene::box({-0.85, 0.0, -0.2}, {-0.55, 0.35, 0.2}));
  add("plate", scene::box({0.0, 0.1, -0.3}, {0.9, 0.11, 0.8}));
  add("plates", scene::box({-0.9, 0.1, 0.25}, {-0.1, 0.12, 0.95}));
  add("ball", scene::sphere({0.0, 0.16, 0.0}, 0.15, 4));
  scene.lights = {scene::lightTowards({0.9, 2.0, 1.2}, {0.0, 0.0, 0.0}, glm::dvec2(0.1))};
  scene::setStillCamera(scene, {{0.3, 0.4, 2.2}, {0.0, 0.08, 0.0}, {0.0, 1.0, 0.0}, 45.0});
  return scene;
}

/// The same from the light that has arrived, read back. No voxel is taken to be seen without a ray.
class Oracle {
 public:
  Oracle(const scene::Scene& scene, const LightGrid& grid) : scene_(scene), grid_(grid.volume().grid()) {
    for (int layer = 0; layer < 6 * grid_.resolution.z; ++layer)
      arrived_.push_back(grid.arrived().readLayer(layer));
  }

  struct Point {
    glm::dvec3 position, normal;
  };
  std::optional<Point> seenBy(int x, int y) const {
    const scene::Camera camera = scene_.camera.at(0.0);
    const glm::dvec3 ray = scene::checks::cameraRay(
        camera, 2.0 * (x + 0.5) / kWidth - 1.0, 1.0 - 2.0 * (y + 0.5) / kHeight, double(kWidth) / kHeight);
    const auto hit = scene::checks::intersect(scene_.mesh, camera.eye, ray);
    if (!hit) return std::nullopt;
    const glm::dvec3 normal = glm::normalize(hit->normal);
    return Point{camera.eye + hit->distance * ray, glm::dot(normal, ray) < 0.0 ? normal : -normal};
  }

  /// Radiance of the first channel; `widest` as the technique's.
  double light(const Point& point, int widest) const {
    const glm::dvec3 at = grid_.toVoxels(point.position) - 0.5;
    double sum = 0.0, weights = 0.0;
    const auto add = [&](int face, double light) {
      sum += weight(point, face) * light;
      weights += weight(point, face);
    };
    for (int face = 0; face < 6; ++face) {
      if (weight(point, face) == 0.0) continue;
      if (const auto near = around(point, at, face))
        add(face, *near);
      else if (const auto one = nearest(point, at, face, 0, 1))
        add(face, *one);
    }
    if (weights == 0.0 && widest > 1)
      for (int face = 0; face < 6; ++face)
        for (int reach = 2; reach <= widest && weight(point, face) > 0.0; ++reach)
          if (const auto one = nearest(point, at, face, reach, reach)) {
            add(face, *one);
            break;
          }
    return weights > 1e-4 ? kAlbedo * sum / (weights * M_PI) : 0.0;
  }

 private:
  static glm::ivec3 step(int face) {
    glm::ivec3 out(0);
    out[face / 2] = face % 2 == 0 ? 1 : -1;
    return out;
  }
  static double weight(const Point& point, int face) {
    const double cosine = glm::dot(point.normal, glm::dvec3(step(face)));
    return cosine > 1e-3 ? cosine * cosine : 0.0;
  }
  /// Light at a face that the point sees.
  std::optional<double> seen(const Point& point, glm::dvec3 at, glm::ivec3 voxel, int face) const {
    if (!grid_.contains(voxel)) return std::nullopt;
    const Image& layer = arrived_[size_t(face * grid_.resolution.z + voxel.z)];
    if (layer.at(voxel.x, voxel.y, 3) < 0.5F) return std::nullopt;
    const glm::ivec3 beyond = voxel + step(face);
    if (!(glm::dot(glm::dvec3(beyond) - at, point.normal) > 0.0)) return std::nullopt;
    const glm::dvec3 way = grid_.centre(beyond) - point.position;
    const double length = glm::length(way);
    // The point's own triangle is in a plane through it.
    if (const auto hit = scene::checks::intersect(scene_.mesh, point.position, way / length, 1e-9);
        hit && hit->distance < length)
      return std::nullopt;
    return layer.at(voxel.x, voxel.y, 0);
  }
  std::optional<double> around(const Point& point, glm::dvec3 at, int face) const {
    const glm::dvec3 low = glm::floor(at), part = at - low;
    double sum = 0.0, shares = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::ivec3 upper(corner & 1, corner >> 1 & 1, corner >> 2);
      double share = 1.0;
      for (int axis = 0; axis < 3; ++axis) share *= upper[axis] ? part[axis] : 1.0 - part[axis];
      if (share <= 1e-5) continue;
      if (const auto one = seen(point, at, glm::ivec3(low) + upper, face)) {
        sum += share * *one;
        shares += share;
      }
    }
    if (shares <= 1e-4) return std::nullopt;
    return sum / shares;
  }
  /// The nearest of those from `least` to `most` voxels away.
  std::optional<double> nearest(const Point& point, glm::dvec3 at, int face, int least, int most) const {
    const glm::ivec3 own(glm::floor(at + 0.5));
    double distance = 1e30;
    std::optional<double> out;
    for (int z = -most; z <= most; ++z)
      for (int y = -most; y <= most; ++y)
        for (int x = -most; x <= most; ++x) {
          if (std::max({std::abs(x), std::abs(y), std::abs(z)}) < least) continue;
          const glm::ivec3 voxel = own + glm::ivec3(x, y, z);
          const double away = glm::length(glm::dvec3(voxel) - at);
          if (away >= distance) continue;
          if (const auto one = seen(point, at, voxel, face)) {
            distance = away;
            out = one;
          }
        }
    return out;
  }

  const scene::Scene& scene_;
  voxels::VoxelGrid grid_;
  std::vector<Image> arrived_;
};

class SeenLightTest : public IndirectLightTest {
 protected:
  struct Made {
    Image picture;
    SeenLight::Costs costs;
  };
  void SetUp() override {
    IndirectLightTest::SetUp();
    gpuScene_.emplace(scene_);
    frame_.emplace(context(), scene_, *gpuScene_, glm::ivec2(kWidth, kHeight));
    surfaces_.light = frame::LightPart::Indirect;
    LightGridSettings settings;
    settings.resolution = 14;
    grid_.emplace(*frame_, settings, surfaces_);
  }
  Made make(int widest, int64_t raysPerPx) {
    gl::ShaderDefines defines = grid_->volume().defines();
    ReconstructionSettings{}.define(defines);
    const SeenLight light(*frame_, defines, surfaces_, "reconstruct", widest, raysPerPx);
    // Twice, as lists are emptied for the next frame.
    for (int i = 0; i < 2; ++i) {
      frame_->begin();
      grid_->update(*frame_);
      light.render(
          *frame_,
          [&](const gl::Program& program) {
            grid_->volume().configure(program);
            grid_->arrived().bindTexture(kReconstructArrivedUnit);
            grid_->lightCells().bindTexture(kLightCellsUnit);
          },
          grid_->tree());
      frame_->end();
    }
    return {light.texture().read(), light.costs()};
  }

  const scene::Scene scene_ = clutteredFloor();
  std::optional<frame::GpuScene> gpuScene_;
  std::optional<frame::Frame> frame_;
  frame::SurfaceLightSettings surfaces_;
  std::optional<LightGrid> grid_;
};

/// Also where no ray was traced, as a voxel was sure to be seen. Such voxels may hold the rim of a plate that
/// none of their samples are in, and rays that end at an edge may go either way: one point of
/// 50.
TEST_F(SeenLightTest, IsThatOfTheVoxelsThatRaysReach) {
  for (const int widest : {1, 2, 3}) {
    const Made made = make(widest, SeenLight::kRaysPerPx);
    const Oracle oracle(scene_, *grid_);
    int points = 0, lit = 0, different = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto point = oracle.seenBy(x, y);
        if (!point) continue;
        ++points;
        const double expected = oracle.light(*point, widest), found = made.picture.at(x, y, 0);
        lit += expected > 0.0;
        different += std::abs(found - expected) > 1e-3 * expected + 1e-5;
      }
    EXPECT_GT(points, kWidth * kHeight / 3);
    EXPECT_GT(lit, points / 3);
    EXPECT_LE(different, points / 50) << "of " << points << ", within " << widest;
    EXPECT_GT(made.costs.raysPerPx, 0.05);
    EXPECT_GT(made.costs.searchingShare, 0.01);
  }
}

/// Pixels trace rays by themselves that do not fit into the list: all, or some of them.
TEST_F(SeenLightTest, IsTheSameWhereRaysDoNotFit) {
  const Made usual = make(2, SeenLight::kRaysPerPx);
  ASSERT_GT(usual.costs.raysPerPx, 0.05);
  const Made none = make(2, 0);
  EXPECT_EQ(none.costs.raysPerPx, 0.0);
  EXPECT_GT(none.costs.searchingShare, usual.costs.searchingShare);
  double sum = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float expected = usual.picture.at(x, y, 0);
      EXPECT_NEAR(none.picture.at(x, y, 0), expected, 1e-5F * expected) << x << ", " << y;
      sum += expected;
    }
  EXPECT_GT(sum, 1.0);
}

}  // namespace
}  // namespace limen::techniques
