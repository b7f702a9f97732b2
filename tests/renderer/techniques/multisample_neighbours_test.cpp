// SPDX-License-Identifier: BSD-3-Clause
// Samples looked at only beside other surfaces: which pixels are listed, by double precision, and that their
// samples see what those of the search by triangles see.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/frame/centre_samples.h"
#include "renderer/frame/sample_raster.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr size_t kSamplesOfPixel = 4;
constexpr uint32_t kNoTriangleSeen = frame::TriangleIds::kNone;

struct Listing {
  std::vector<uint32_t> marks, ids, centres;
  /// Triangle that sample k of pixel p sees.
  uint32_t seen(size_t p, size_t k) const { return marks[p] ? ids[p * kSamplesOfPixel + k] : centres[p]; }
};

template <class Samples>
Listing drawnTwice(frame::Frame& frame, const Samples& raster) {
  Listing out;
  // The second frame has the first one's leftovers to clear.
  for (int i = 0; i < 2; ++i) {
    frame.begin();
    raster.draw(frame, "samples");
    out = {raster.marks().readUint(), raster.ids().template read<uint32_t>(),
           frame.get<frame::TriangleIds>().texture().readUint()};
    frame.end();
  }
  return out;
}

Listing listingOf(frame::Frame& frame, frame::SampleSearch search) {
  std::vector<glm::vec2> places = frame::standardSamplePlaces(kSamplesOfPixel);
  if (search == frame::SampleSearch::Centres) return drawnTwice(frame, frame::CentreSamples(frame, places));
  return drawnTwice(frame, frame::SampleRaster(frame, places, search));
}

/// What pixels' centres see, in double precision and in camera space.
class CentrePoints {
 public:
  CentrePoints(const frame::Frame& frame, const scene::Scene& scene, const frame::GpuScene& gpuScene)
      : frame_(frame), triangles_(scene, gpuScene.anchor()) {
    toLight_ = scene.lights.at(0).toLightSpace(gpuScene.anchor()) * glm::inverse(frame.anchorToCamera());
  }

  struct Point {
    glm::dvec3 position, normal;
    bool lit;
  };
  Point at(glm::ivec2 pixel, uint32_t id) const {
    const glm::dvec2 ndc = glm::dvec2(2.0, -2.0) * (glm::dvec2(pixel) + 0.5) / glm::dvec2(frame_.sizePx()) +
                           glm::dvec2(-1.0, 1.0);
    const glm::dvec3 ray(ndc.x * frame_.tanHalfFov() * frame_.aspect(), ndc.y * frame_.tanHalfFov(), -1.0);
    const auto corner = [&](int which) {
      return glm::dvec3(frame_.anchorToCamera() * glm::dvec4(triangles_.corner(id, which), 1.0));
    };
    glm::dvec3 normal = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    const glm::dvec3 position = ray * glm::dot(normal, corner(0)) / glm::dot(normal, ray);
    if (glm::dot(normal, position) > 0.0) normal = -normal;
    const glm::dvec3 p(toLight_ * glm::dvec4(position, 1.0));
    return {position, normal, p.z > 0.0 && glm::dot(glm::dmat3(toLight_) * normal, p) < 0.0};
  }

 private:
  const frame::Frame& frame_;
  frame::BruteForce triangles_;
  glm::dmat4 toLight_;
};

enum class Relation { Same, Other, Undecided };

/// `Undecided`: within rounding of a limit.
Relation relationOf(const CentrePoints::Point& own, const CentrePoints::Point& other) {
  const double cosine = glm::dot(own.normal, other.normal) - std::cos(glm::radians(15.0));
  const double distance =
      std::abs(glm::dot(own.normal, other.position - own.position)) / -other.position.z - 0.003;
  // Triangles that the camera sees nearly edge-on have no sharp position.
  const auto grazes = [](const CentrePoints::Point& point) {
    return std::abs(glm::dot(point.normal, glm::normalize(point.position))) < 0.02;
  };
  if (own.lit != other.lit || cosine < -1e-3 || distance > 1e-4)
    return grazes(own) || grazes(other) || (own.lit != other.lit && cosine > -1e-3 && distance < 1e-4)
               ? Relation::Undecided
               : Relation::Other;
  return cosine < 1e-3 || distance > -1e-4 ? Relation::Undecided : Relation::Same;
}

class MultisampleNeighbours : public TechniqueTest {};

TEST_F(MultisampleNeighbours, PixelsBesideOtherSurfacesAreListed) {
  for (const char* name : {"two_boxes", "sphere_grid", "columns_hall", "foliage"}) {
    const scene::Scene scene = makeScene(name);
    const frame::GpuScene gpuScene(scene);
    const glm::ivec2 sizePx(61, 43);
    frame::Frame frame(context(), scene, gpuScene, sizePx);
    const Listing listing = listingOf(frame, frame::SampleSearch::Neighbours);
    const CentrePoints points(frame, scene, gpuScene);
    int listed = 0, unlisted = 0;
    for (int y = 0; y < sizePx.y; ++y)
      for (int x = 0; x < sizePx.x; ++x) {
        const auto idAt = [&](int px, int py) {
          return listing.centres[size_t(py) * size_t(sizePx.x) + size_t(px)];
        };
        const uint32_t own = idAt(x, y);
        Relation most = Relation::Same;
        for (int py = std::max(y - 1, 0); py <= std::min(y + 1, sizePx.y - 1); ++py)
          for (int px = std::max(x - 1, 0); px <= std::min(x + 1, sizePx.x - 1); ++px) {
            const uint32_t other = idAt(px, py);
            if (other == own) continue;
            const Relation here = own == kNoTriangleSeen || other == kNoTriangleSeen
                                      ? Relation::Other
                                      : relationOf(points.at({x, y}, own), points.at({px, py}, other));
            if (here == Relation::Other || most == Relation::Other)
              most = Relation::Other;
            else if (here == Relation::Undecided)
              most = here;
          }
        const uint32_t mark = listing.marks[size_t(y) * size_t(sizePx.x) + size_t(x)];
        if (most == Relation::Undecided) continue;
        (mark ? listed : unlisted) += 1;
        EXPECT_EQ(mark, most == Relation::Other ? 1U : 0U) << name << ' ' << x << ' ' << y;
      }
    EXPECT_GT(listed, 100) << name;
    EXPECT_GT(unlisted, 100) << name;
  }
}

TEST_F(MultisampleNeighbours, SamplesOfListedPixelsSeeWhatTheSearchByTrianglesSees) {
  // Triangles large and small, few and many, some through the eye's plane.
  for (const char* name : {"two_boxes", "sphere_grid", "columns_hall", "foliage", "street_light"})
    for (const glm::ivec2 sizePx : {glm::ivec2(61, 43), glm::ivec2(320, 200)}) {
      const scene::Scene scene = makeScene(name);
      const frame::GpuScene gpuScene(scene);
      frame::Frame frame(context(), scene, gpuScene, sizePx);
      const Listing all = listingOf(frame, frame::SampleSearch::Triangles),
                    near = listingOf(frame, frame::SampleSearch::Neighbours);
      ASSERT_EQ(all.centres, near.centres);
      size_t listed = 0, differing = 0;
      for (size_t p = 0; p < near.marks.size(); ++p) {
        if (!near.marks[p]) continue;
        ++listed;
        for (size_t k = 0; k < kSamplesOfPixel; ++k) differing += near.seen(p, k) != all.seen(p, k);
      }
      EXPECT_GT(listed, 100U) << name;
      EXPECT_EQ(differing, 0U) << name << ' ' << sizePx.x;
    }
}

TEST_F(MultisampleNeighbours, CentresGiveSamplesTheirTriangleWhereACentreNearbySeesIt) {
  for (const char* name : {"two_boxes", "sphere_grid", "columns_hall", "foliage", "street_light"})
    for (const glm::ivec2 sizePx : {glm::ivec2(61, 43), glm::ivec2(320, 200)}) {
      const scene::Scene scene = makeScene(name);
      const frame::GpuScene gpuScene(scene);
      frame::Frame frame(context(), scene, gpuScene, sizePx);
      const Listing all = listingOf(frame, frame::SampleSearch::Triangles),
                    near = listingOf(frame, frame::SampleSearch::Neighbours),
                    centres = listingOf(frame, frame::SampleSearch::Centres);
      EXPECT_EQ(near.marks, centres.marks) << name;
      size_t seenNearby = 0, wrong = 0, strange = 0;
      for (int y = 0; y < sizePx.y; ++y)
        for (int x = 0; x < sizePx.x; ++x) {
          const size_t p = size_t(y) * size_t(sizePx.x) + size_t(x);
          if (!centres.marks[p]) continue;
          std::vector<uint32_t> around;
          for (int py = std::max(y - 1, 0); py <= std::min(y + 1, sizePx.y - 1); ++py)
            for (int px = std::max(x - 1, 0); px <= std::min(x + 1, sizePx.x - 1); ++px)
              around.push_back(all.centres[size_t(py) * size_t(sizePx.x) + size_t(px)]);
          const auto among = [&](uint32_t id) {
            return std::find(around.begin(), around.end(), id) != around.end();
          };
          for (size_t k = 0; k < kSamplesOfPixel; ++k) {
            strange += !among(centres.seen(p, k));
            if (!among(all.seen(p, k))) continue;
            ++seenNearby;
            wrong += centres.seen(p, k) != all.seen(p, k);
          }
        }
      EXPECT_GT(seenNearby, 300U) << name;
      EXPECT_EQ(wrong, 0U) << name << ' ' << sizePx.x;
      EXPECT_EQ(strange, 0U) << name << ' ' << sizePx.x;
    }
}

/// A card before a plane. At its edges a circle of sqrt(2) pixels fits in card and plane wherever a sample
/// is, except near the card's corners.
TEST_F(MultisampleNeighbours, NoSampleBeyondAnEdgeIsMissed) {
  scene::Scene scene;
  const auto add = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
    const auto first = static_cast<uint32_t>(scene.mesh.positions.size());
    scene.mesh.positions.insert(scene.mesh.positions.end(), {a, b, c, d});
    scene.mesh.triangles.emplace_back(first, first + 1, first + 2);
    scene.mesh.triangles.emplace_back(first, first + 2, first + 3);
  };
  add({-9.0, -9.0, -2.0}, {9.0, -9.0, -2.0}, {9.0, 9.0, -2.0}, {-9.0, 9.0, -2.0});
  const glm::dvec3 corners[4] = {{-0.9, -0.7, 1.0}, {0.8, -0.6, 1.0}, {0.9, 0.7, 1.0}, {-0.8, 0.6, 1.0}};
  add(corners[0], corners[1], corners[2], corners[3]);
  scene.parts.push_back({"all", 0, 4});
  scene.materials.emplace_back();
  scene::AreaLight light;
  light.centre = {0.5, 0.3, 9.0};
  light.axisY = {0.0, -1.0, 0.0};  // looks along -z
  light.size = {1.0, 1.0};
  scene.lights.push_back(light);
  scene::Camera camera;
  camera.eye = {0.0, 0.0, 5.0};
  scene.camera.keys = {{0.0, camera}};
  const frame::GpuScene gpuScene(scene);
  const glm::ivec2 sizePx(97, 71);
  frame::Frame frame(context(), scene, gpuScene, sizePx);
  const Listing all = listingOf(frame, frame::SampleSearch::Triangles),
                near = listingOf(frame, frame::SampleSearch::Neighbours);
  const auto pixelOf = [&](glm::dvec3 corner) {
    const glm::dvec3 p(frame.anchorToCamera() * glm::dvec4(corner - gpuScene.anchor(), 1.0));
    const glm::dvec2 ndc =
        glm::dvec2(p) / -p.z / glm::dvec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov());
    return (ndc * glm::dvec2(0.5, -0.5) + 0.5) * glm::dvec2(sizePx);
  };
  size_t complex = 0;
  for (int y = 0; y < sizePx.y; ++y)
    for (int x = 0; x < sizePx.x; ++x) {
      const size_t p = size_t(y) * size_t(sizePx.x) + size_t(x);
      bool beyond = false;
      for (size_t k = 0; k < kSamplesOfPixel; ++k)
        beyond = beyond || (all.seen(p, k) < 2) != (all.centres[p] < 2);
      if (!beyond) continue;
      bool atCorner = false;
      for (const glm::dvec3& corner : corners)
        atCorner = atCorner || glm::length(pixelOf(corner) - (glm::dvec2(x, y) + 0.5)) < 2.0;
      if (atCorner) continue;
      ++complex;
      EXPECT_EQ(near.marks[p], 1U) << x << ' ' << y;
    }
  EXPECT_GT(complex, 40U);
}

TEST_F(MultisampleNeighbours, OnlyTheComputeRasteriserHasThem) {
  for (const char* search : {"neighbours", "centres"}) {
    const auto given = [&](const char* raster) {
      return Given{{"raster", std::string(raster)}, {"method.search", std::string(search)}};
    };
    EXPECT_FALSE(refusal("soft_shadows/multisample", given("compute")));
    for (const char* raster : {"auto", "hardware"}) {
      const std::optional<Error> error = refusal("soft_shadows/multisample", given(raster));
      ASSERT_TRUE(error);
      EXPECT_EQ(error->where(), "method.search");
    }
  }
}

}  // namespace
}  // namespace limen::techniques
