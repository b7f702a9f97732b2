// SPDX-License-Identifier: BSD-3-Clause
// Techniques with microquads and microtris against a brute-force twin in double precision: every cell of the
// same shadow map is backprojected for every receiver, with no search area, no pyramid and no early exit.
// Masks are taken sample by sample from the convex hull of the corners, which stay where they are.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr double kQuadBias = 1e-4, kQuadSlopeBias = 2.0, kMaxSlope = 10.0;

using Corners = std::vector<glm::dvec2>;

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

glm::dvec2 toLight(glm::dvec2 s) { return glm::clamp(s, 0.0, 1.0); }

/// Convex hull by gift wrapping, counter-clockwise; empty if the corners lie on a line.
Corners wrap(const Corners& points) {
  size_t start = 0;
  for (size_t i = 1; i < points.size(); ++i)
    if (points[i].y < points[start].y || (points[i].y == points[start].y && points[i].x < points[start].x))
      start = i;
  Corners hull;
  glm::dvec2 here = points[start];
  do {
    hull.push_back(here);
    glm::dvec2 next = here;
    for (const glm::dvec2& point : points) {
      if (point == here) continue;
      const double turn = next == here ? -1.0 : cross(next - here, point - here);
      if (turn < 0.0 || (turn == 0.0 && glm::distance(here, point) > glm::distance(here, next))) next = point;
    }
    here = next;
  } while (here != hull[0] && hull.size() <= points.size());
  return hull.size() < 3 ? Corners{} : hull;
}

struct MeshTwin {
  Image map;  ///< a level of the minimum pyramid
  const frame::LightFrustum& frustum;
  glm::dvec2 lightSize;
  int level = 0, resolution = 64;
  bool triangles = false;

  /// Calls `found(corners)` for each cell whose corners block: four in the mesh's order, or three.
  template <class Found>
  void cells(const Image& receivers, int px, int py, Found found) const {
    const glm::dvec3 p(receivers.at(px, py, 0), receivers.at(px, py, 1), receivers.at(px, py, 2));
    const glm::dvec2 tangents = frustum.high - frustum.low;
    const double slope = std::min(double(receivers.at(px, py, 3)), kMaxSlope * p.z);
    const double limit =
        p.z - kQuadBias * p.z -
        kQuadSlopeBias * slope * std::max(tangents.x, tangents.y) / resolution * double(1 << level);
    for (int y = 0; y + 1 < map.height; ++y)
      for (int x = 0; x + 1 < map.width; ++x) {
        Corners corners;
        for (const glm::ivec2 at : {glm::ivec2(x, y), {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}) {
          const double z = map.at(at.x, at.y);
          if (!(z < limit)) continue;
          const glm::dvec2 tangent =
              frustum.low + tangents * (glm::dvec2(at) + 0.5) / glm::dvec2(map.width, map.height);
          corners.push_back(z / (p.z - z) * (p.z * tangent - glm::dvec2(p)) / lightSize + 0.5);
        }
        if (corners.size() < (triangles ? 3U : 4U)) continue;
        // Wholly beyond one side of the light: nothing of it is on the light, clamped or not. Saves most of
        // the time.
        glm::dvec2 low = corners[0], high = corners[0];
        for (const glm::dvec2& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
        if (glm::all(glm::greaterThan(high, glm::dvec2(0.0))) &&
            glm::all(glm::lessThan(low, glm::dvec2(1.0))))
          found(corners);
      }
  }
};

/// What a cell does to the visibility.
using Gather = std::function<double(const MeshTwin&, const Image& receivers, int x, int y)>;

double areaVisibility(const MeshTwin& twin, const Image& receivers, int x, int y, bool isSigned) {
  double area = 0.0;
  twin.cells(receivers, x, y, [&](const Corners& corners) {
    // Fan of triangles around the first corner.
    double own = 0.0;
    for (size_t i = 1; i + 1 < corners.size(); ++i)
      own += 0.5 *
             cross(toLight(corners[i]) - toLight(corners[0]), toLight(corners[i + 1]) - toLight(corners[0]));
    area += isSigned ? own : std::abs(own);
  });
  return 1.0 - std::clamp(area, 0.0, 1.0);
}

/// Share of 16 x 16 samples that `covers(corners, sample)` says no cell covers.
template <class Covers>
double sampledVisibility(const MeshTwin& twin, const Image& receivers, int x, int y, Covers covers) {
  std::array<bool, 256> covered{};
  twin.cells(receivers, x, y, [&](const Corners& corners) { covers(corners, covered); });
  return 1.0 - static_cast<double>(std::count(covered.begin(), covered.end(), true)) / 256.0;
}

glm::dvec2 sampleAt(size_t bit, bool jittered) {
  const size_t i = bit % 16, j = bit / 16;
  const glm::dvec2 within = jittered ? glm::dvec2(j % 2 ? 0.75 : 0.25, i % 2 ? 0.25 : 0.75) : glm::dvec2(0.5);
  return (glm::dvec2(i, j) + within) / 16.0;
}

double hullVisibility(const MeshTwin& twin, const Image& receivers, int x, int y, bool jittered) {
  return sampledVisibility(
      twin, receivers, x, y, [&](const Corners& corners, std::array<bool, 256>& covered) {
        const Corners hull = wrap(corners);
        for (size_t bit = 0; bit < 256 && !hull.empty(); ++bit) {
          bool within = true;
          for (size_t k = 0; k < hull.size() && within; ++k)
            within = cross(hull[(k + 1) % hull.size()] - hull[k], sampleAt(bit, jittered) - hull[k]) > 0.0;
          covered[bit] = covered[bit] || within;
        }
      });
}

double rectangleVisibility(const MeshTwin& twin, const Image& receivers, int x, int y) {
  return sampledVisibility(
      twin, receivers, x, y, [&](const Corners& corners, std::array<bool, 256>& covered) {
        const auto middle = [&](size_t a, size_t b) {
          return 0.5 * (toLight(corners[a]) + toLight(corners[b]));
        };
        const double x0 = middle(0, 3).x, x1 = middle(1, 2).x, y0 = middle(0, 1).y, y1 = middle(2, 3).y;
        for (size_t bit = 0; bit < 256; ++bit) {
          const glm::dvec2 s = sampleAt(bit, false);
          if (std::min(x0, x1) < s.x && s.x <= std::max(x0, x1) && std::min(y0, y1) < s.y &&
              s.y <= std::max(y0, y1))
            covered[bit] = true;
        }
      });
}

struct Compared {
  double largest = 0.0;
  int differing = 0, compared = 0, partly = 0;
};

class Microquads : public TechniqueTest {
 protected:
  /// A receiver counts as differing if no level's mesh gives its visibility to within `tolerance`; of level 0
  /// alone unless the budget asks for coarser ones.
  static Compared compare(const scene::Scene& scene, const std::string& technique, Given given,
                          const Gather& visibility, double tolerance) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {40, 30});
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    given["resolution"] = int64_t{64};
    if (given.count("occluders") == 0) given["occluders"] = std::string("microquads");
    const bool coarse = given.count("budget.limit") != 0;
    if (!coarse) given["budget.limit"] = int64_t{0};
    const auto made = info.make(ParameterValues(info.parameters, inThesisForm(given)));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    const auto& pyramid = frame.get<frame::MinMaxPyramid>(frame::ShadowMapSettings{64});
    const frame::LightFrustum frustum = pyramid.frustum();
    std::vector<MeshTwin> twins;
    for (int level = 0; level < (coarse ? 6 : 1); ++level)
      twins.push_back({pyramid.minimum().read(level), frustum, scene.lights[0].size, level, 64,
                       given["occluders"] == ParameterValue(std::string("microquads_microtris"))});
    const Image receivers = frame.get<frame::Receivers>().texture().read();
    frame.end();
    const Image product = made->product().read();
    Compared out;
    for (int y = 0; y < product.height; ++y)
      for (int x = 0; x < product.width; ++x) {
        if (receivers.at(x, y, 3) < 0.0F) {
          EXPECT_EQ(product.at(x, y), 1.0F);
          continue;
        }
        double error = 1e300;
        for (const MeshTwin& twin : twins)
          error = std::min(error, std::abs(double(product.at(x, y)) - visibility(twin, receivers, x, y)));
        ++out.compared;
        out.partly += product.at(x, y) > 0.0F && product.at(x, y) < 1.0F;
        out.largest = std::max(out.largest, error);
        out.differing += error > tolerance;
      }
    return out;
  }

  /// A card that stands askew over the ground, so that its depth changes along both axes of the map.
  static scene::Scene tiltedCard() {
    scene::Scene scene = makeScene("parallel_rectangle");
    scene::Mesh& mesh = scene.mesh;
    for (glm::dvec3& position : mesh.positions)
      if (position.y > 0.1) position.y += 0.8 * position.x + 0.5 * position.z;
    return scene;
  }

  static std::map<std::string, scene::Scene> scenes() {
    std::map<std::string, scene::Scene> out;
    for (const char* name : {"sphere_grid", "box_under_light"}) out[name] = makeScene(name);
    out["two_boxes"] = makeScene("two_boxes", {{"light_size", 3.0}});
    out["tilted_card"] = tiltedCard();
    return out;
  }
};

TEST_F(Microquads, AreaIsTheSumOfTheQuadsAreas) {
  for (const auto& [name, scene] : scenes())
    for (const char* occluders : {"microquads", "microquads_microtris"})
      for (const bool isSigned : {false, true}) {
        // Light-space positions carry the rounding of the G-buffer; near contact k = z / (p_z - z) magnifies
        // it.
        const Compared result = compare(
            scene, "soft_shadows/backprojection",
            {{"occluders", std::string(occluders)},
             {"occluders.area", std::string(isSigned ? "signed" : "absolute")}},
            [&](const MeshTwin& twin, const Image& receivers, int x, int y) {
              return areaVisibility(twin, receivers, x, y, isSigned);
            },
            1e-3);
        EXPECT_GT(result.partly, 50) << name;
        EXPECT_LE(result.differing, result.compared / 100)
            << name << " " << occluders << (isSigned ? " signed: " : ": ") << result.differing << " of "
            << result.compared << ", largest " << result.largest;
      }
}

TEST_F(Microquads, ExactMaskSetsTheSamplesWithinTheHulls) {
  for (const auto& [name, scene] : scenes())
    for (const char* occluders : {"microquads", "microquads_microtris"})
      for (const bool jittered : {false, true}) {
        const Compared result = compare(
            scene, "soft_shadows/bitmask",
            {{"occluders", std::string(occluders)},
             {"occluders.mask", std::string("arithmetic")},
             {"pattern", std::string(jittered ? "jittered_16" : "regular_16")}},
            [&](const MeshTwin& twin, const Image& receivers, int x, int y) {
              return hullVisibility(twin, receivers, x, y, jittered);
            },
            1e-6);
        EXPECT_GT(result.partly, 50) << name;
        // A sample within float rounding of an edge may fall on either side, and where an edge follows a row,
        // all of it.
        EXPECT_LE(result.largest, 16.0 / 256.0 + 1e-6) << name << " " << occluders;
        EXPECT_LE(result.differing, result.compared / 50)
            << name << " " << occluders << ": " << result.differing << " of " << result.compared;
      }
}

TEST_F(Microquads, ApproximateMaskSetsTheSamplesOfTheRectangles) {
  for (const auto& [name, scene] : scenes()) {
    const Compared result = compare(scene, "soft_shadows/bitmask", {{"pattern", std::string("regular_16")}},
                                    rectangleVisibility, 1e-6);
    EXPECT_GT(result.partly, 50) << name;
    EXPECT_LE(result.largest, 16.0 / 256.0 + 1e-6) << name;
    EXPECT_LE(result.differing, result.compared / 50)
        << name << ": " << result.differing << " of " << result.compared;
  }
}

TEST_F(Microquads, TableTendsToTheExactMask) {
  // The finer the table, the less it differs from the twin; how little is asked of the masks themselves.
  for (const auto& [name, scene] : scenes()) {
    int last = 1 << 30;
    for (const int64_t size : {64, 256, 1024}) {
      const Compared result = compare(
          scene, "soft_shadows/bitmask",
          {{"occluders", std::string("microquads_microtris")},
           {"occluders.mask", std::string("half_space_table")},
           {"occluders.mask.size", size},
           {"pattern", std::string("jittered_16")}},
          [&](const MeshTwin& twin, const Image& receivers, int x, int y) {
            return hullVisibility(twin, receivers, x, y, true);
          },
          2.5 / 256.0);
      std::printf("%s, table of %d: %d of %d pixels differ by 3 samples or more, largest difference %f\n",
                  name.c_str(), int(size), result.differing, result.compared, result.largest);
      EXPECT_LE(result.differing, last) << name;
      last = result.differing;
    }
    EXPECT_LE(last, 1200 / 50) << name;
  }
}

TEST_F(Microquads, CoarseLevelsMakeQuadsOfTheirOwnTexels) {
  for (const auto& [name, scene] : scenes()) {
    const Compared result = compare(
        scene, "soft_shadows/backprojection", {{"budget.limit", int64_t{25}}},
        [](const MeshTwin& twin, const Image& receivers, int x, int y) {
          return areaVisibility(twin, receivers, x, y, false);
        },
        1e-3);
    // Umbra and lit are told by the finest level, whose texels a coarser mesh may gather otherwise.
    EXPECT_GT(result.partly, 50) << name;
    EXPECT_LE(result.differing, result.compared / 50)
        << name << ": " << result.differing << " of " << result.compared;
  }
}

TEST_F(Microquads, FlatRectangleIsTheClosedFormOfOneHalfATexelSmaller) {
  // The map is fitted to the rectangle with a margin of one texel, so its texels' edges are the rectangle's;
  // the mesh ends at the centres of the outermost texels. Share of the light that [-a, a] x [-b, b] at height
  // h hides from the ground at (x, z), the light's extents w at height H: the overlap of two intervals on
  // either axis.
  const scene::Scene scene = makeScene("parallel_rectangle", {{"height", 0.7}});
  constexpr double kHeight = 0.7, kLight = 2.0;
  constexpr int kResolution = 64;
  const glm::dvec2 half = glm::dvec2(0.3, 0.2) * (1.0 - 1.0 / (kResolution - 2));
  for (const char* mask : {"area", "approximate", "arithmetic"}) {
    const std::string technique =
        mask == std::string("area") ? "soft_shadows/backprojection" : "soft_shadows/bitmask";
    Given given = {{"resolution", int64_t{kResolution}},
                   {"budget.limit", int64_t{0}},
                   {"occluders", std::string("microquads")}};
    if (mask != std::string("area")) given["occluders.mask"] = std::string(mask);
    const Rendered rendered = render(scene, technique, given, {64, 48});
    const glm::dmat4 fromLight = glm::inverse(scene.lights[0].toLightSpace());
    const glm::dvec2 w = scene.lights[0].size;
    int partly = 0;
    for (size_t i = 0; i < rendered.product.pixels(); ++i) {
      const float* receiver = rendered.receivers.data.data() + 4 * i;
      if (receiver[3] < 0.0F) continue;
      const glm::dvec3 world = fromLight * glm::dvec4(receiver[0], receiver[1], receiver[2], 1.0);
      if (world.y > 0.01) continue;
      const double k = kLight / kHeight;
      const auto hidden = [&](double at, double halfSize, double width) {
        const double low = at + (-halfSize - at) * k, high = at + (halfSize - at) * k;
        return std::max(0.0, std::min(high, 0.5 * width) - std::max(low, -0.5 * width)) / width;
      };
      // The light's x axis lies along the world's x or z; the scene says which.
      const bool alongX = std::abs(scene.lights[0].axisX.x) > 0.5;
      const double expected =
          1.0 - hidden(world.x, half.x, alongX ? w.x : w.y) * hidden(world.z, half.y, alongX ? w.y : w.x);
      partly += expected > 0.0 && expected < 1.0;
      // Half a step between two of jittered_16's 32 rows on each of four edges.
      const double bound = mask == std::string("area") ? 1e-3 : 4.0 / 64.0 + 1e-3;
      ASSERT_NEAR(rendered.product.data[i], expected, bound) << mask << " at " << world.x << " " << world.z;
    }
    EXPECT_GT(partly, 200) << mask;
  }
}

}  // namespace
}  // namespace limen::techniques
