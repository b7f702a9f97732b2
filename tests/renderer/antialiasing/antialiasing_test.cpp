// SPDX-License-Identifier: BSD-3-Clause
// Anti-aliasing against the area of a half-plane in each pixel, and ways to shade that must agree to the bit.
#include <cmath>
#include <vector>

#include "renderer/frame/shaded.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr glm::ivec2 kSizePx{64, 48};

/// A white triangle that covers the left of the picture up to a line of the given slope (columns a row), and
/// more than the picture to the other sides.
class HalfPlane {
 public:
  HalfPlane(double columnsPerRow, double middleColumn) : slope_(columnsPerRow), middle_(middleColumn) {
    // Camera at (0, 0, 1) looking along -z at the plane z = 0: pixel (x, y) sees ((2 x / w - 1) a t, (1 - 2 y
    // / h) t).
    const double t = std::tan(glm::radians(22.5)), pixel = 2.0 * t / kSizePx.y;
    const auto at = [&](double x, double y) {
      return glm::dvec3((x - 0.5 * kSizePx.x) * pixel, (0.5 * kSizePx.y - y) * pixel, 0.0);
    };
    scene::Mesh mesh;
    const double far = 2000.0;
    mesh.positions = {at(column(-far), -far), at(column(far), far), at(column(0.0) - 4.0 * far, 0.0)};
    mesh.triangles = {{0, 1, 2}};
    scene::addPart(scene_, "half plane", mesh, glm::vec3(1.0F));
    scene::setStillCamera(scene_, {{0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0});
  }
  const scene::Scene& scene() const { return scene_; }
  double column(double y) const { return middle_ + slope_ * (y - 0.5 * kSizePx.y); }
  /// Area of pixel (x, y) left of the line: the integral of clamp(column - x, 0, 1) over its rows, exact
  /// where the line crosses the pixel's sides at the breaks.
  double coverage(int x, int y) const {
    const double from = column(y) - x, to = column(y + 1.0) - x;
    const auto integral = [](double u) {  // of clamp(u, 0, 1)
      const double c = std::min(std::max(u, 0.0), 1.0);
      return 0.5 * c * c + std::max(u - 1.0, 0.0);
    };
    if (std::abs(to - from) < 1e-9) return std::min(std::max(from, 0.0), 1.0);
    return (integral(to) - integral(from)) / (to - from);
  }

 private:
  scene::Scene scene_;
  double slope_, middle_;
};

class Antialiasing : public TechniqueTest {
 protected:
  /// White surfaces are 1, the background 0: a pixel's value is what is covered of it.
  static Given white(Given more = {}) {
    more.insert({{"shading.ambient", 1.0}, {"shading.diffuse", 0.0}, {"shading.background", 0.0}});
    return more;
  }
  struct Errors {
    double largest = 0.0, rms = 0.0, mean = 0.0;  // of pixels that the line crosses
    int crossed = 0;
    double elsewhere = 0.0;
  };
  static Errors errorsOf(const HalfPlane& line, const std::string& technique, const Given& given) {
    const Rendered rendered = render(line.scene(), technique, white(given), kSizePx);
    Errors out;
    for (int y = 0; y < kSizePx.y; ++y)
      for (int x = 0; x < kSizePx.x; ++x) {
        const double covered = line.coverage(x, y), error = rendered.product.at(x, y, 1) - covered;
        if (covered <= 1e-6 || covered >= 1.0 - 1e-6) {
          out.elsewhere = std::max(out.elsewhere, std::abs(error));
          continue;
        }
        ++out.crossed;
        out.largest = std::max(out.largest, std::abs(error));
        out.rms += error * error;
        out.mean += error;
      }
    out.rms = std::sqrt(out.rms / out.crossed);
    out.mean /= out.crossed;
    return out;
  }
  static std::vector<HalfPlane> lines() { return {{0.37, 30.2}, {-1.3, 33.7}, {0.05, 20.4}, {2.9, 31.1}}; }
};

// A line crosses at most 2 m - 1 of a window's m x m cells. A cell counts as covered if its middle is, and
// then at least half of it is: each crossed cell is wrong by at most half its area.
TEST_F(Antialiasing, FullSupersamplingCoversAHalfPlaneToHalfOfTheCellsCrossed) {
  for (const HalfPlane& line : lines())
    for (int window = 1; window <= 4; ++window) {
      const Errors errors = errorsOf(line, "antialiasing/full", {{"window", int64_t{window}}});
      EXPECT_GT(errors.crossed, 40);
      EXPECT_LE(errors.largest, (2.0 * window - 1.0) / (2.0 * window * window) + 1e-5) << window;
      EXPECT_LE(errors.elsewhere, 1e-6) << window;
    }
}

// Of 16 x 16 cells with a random place each, at most 31 are crossed; each adds 1 / 256 or nothing, with a
// variance of at most a quarter of its square. The mean over the crossed pixels has a standard deviation
// smaller by their root.
TEST_F(Antialiasing, TheReferenceCoversAHalfPlaneToItsNoise) {
  const double deviation = std::sqrt(31.0 / 4.0) / 256.0;
  for (const HalfPlane& line : lines()) {
    const Errors errors = errorsOf(line, "antialiasing/ray_traced", {{"places", int64_t{256}}});
    EXPECT_LE(errors.rms, deviation);
    EXPECT_LE(std::abs(errors.mean), 4.0 * deviation / std::sqrt(double(errors.crossed)));
    EXPECT_LE(errors.elsewhere, 1e-6);
  }
}

// A window that a surface shares with the background asks for all samples, in whatever way they are shaded.
TEST_F(Antialiasing, AdaptiveIsFullAtSilhouettesForHalfTheSamples) {
  const HalfPlane line = lines()[0];
  for (int window = 2; window <= 4; ++window) {
    const Rendered full =
        render(line.scene(), "antialiasing/full", white({{"window", int64_t{window}}}), kSizePx);
    const Rendered adaptive =
        render(line.scene(), "antialiasing/adaptive",
               white({{"window", int64_t{window}}, {"lightness", std::string("none")}}), kSizePx, true);
    EXPECT_EQ(full.product.data, adaptive.product.data);
    // 48 rows cross 48 * 1.37 pixels, and each of these has all samples, all others one.
    const double pixels = kSizePx.x * kSizePx.y, crossed = kSizePx.y * 1.37 + 1.0;
    EXPECT_LE(adaptive.counter("samples_per_px"), 1.0 + crossed * (window * window - 1) / pixels);
    EXPECT_GT(adaptive.counter("samples_per_px"), 1.0);
  }
}

// Checks on a square across the view, 2.6 and 1.3 pixels a check: every pixel is a box on it, over which the
// filter is exact. The reference is a mean of 64 x 64 jittered rays: of 64 cells a side at most 4 x 64 have a
// check's edge in them, each a variance of a quarter or less, of checks 0.8 apart: 0.8 * sqrt(256 / 4) / 4096
// = 0.0016 a deviation, and of 432 pixels one may be 4 away. Point samples are off by half of 0.8 and more
// somewhere.
TEST_F(Antialiasing, GradientsAverageChecksOverThePixel) {
  for (const double pitch : {0.11, 0.055}) {
    scene::Scene scene;
    scene.mesh.positions = {{-2.0, -2.0, 0.0}, {2.0, -2.0, 0.0}, {2.0, 2.0, 0.0}, {-2.0, 2.0, 0.0}};
    scene.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.parts = {{"square", 0, 2, 0, false}};
    scene::Material material{"checker", glm::vec3(0.5F)};
    material.pattern = {scene::Pattern::Kind::Checker, pitch, 0.8, 1, {0.013, 0.021, -0.25}};
    scene.materials = {material};
    scene::setStillCamera(scene, {{0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 41.1});
    constexpr glm::ivec2 kSize(24, 18);
    const auto picture = [&](const char* technique, Given given) {
      given = white(std::move(given));
      return render(scene, technique, given, kSize).product;
    };
    const Image reference = picture("antialiasing/ray_traced", {{"places", int64_t{4096}}});
    const auto largest = [&](const Image& image) {
      double out = 0.0;
      for (size_t i = 0; i < image.data.size(); ++i)
        out = std::max(out, std::abs(double(image.data[i]) - reference.data[i]));
      return out;
    };
    for (const char* kind : {"plane", "neighbours"})
      EXPECT_LT(
          largest(picture("antialiasing/full", {{"window", int64_t{1}}, {"gradients", std::string(kind)}})),
          0.0064)
          << kind << ' ' << pitch;
    EXPECT_GT(largest(picture("antialiasing/full", {{"window", int64_t{1}}})), 0.2) << pitch;
    // One sample of sixteen is widened to the whole pixel; it stands in another place of it, by 3/8 of a
    // pixel or less.
    EXPECT_LT(meanDifference(picture("antialiasing/adaptive", {{"geometry", std::string("none")},
                                                               {"lightness", std::string("none")},
                                                               {"gradients", std::string("plane")}}),
                             reference),
              meanDifference(picture("antialiasing/adaptive",
                                     {{"geometry", std::string("none")}, {"lightness", std::string("none")}}),
                             reference))
        << pitch;
  }
}

// A plane across the view, 2^20 m away, has one depth: no variance. Depths are known to 1/16 m there and so
// the variance in the stable form to 1/256 m^2, far below the half that asks for a sample; in the printed
// form it is a difference of numbers near 2^40 m^2, of which floats know 2^17 m^2: above 0 for some
// distances, below for others.
TEST_F(Antialiasing, AFarPlaneAsksForSamplesInThePrintedFormAlone) {
  double most = 0.0;
  for (int i = 0; i < 8; ++i) {
    scene::Scene scene;
    scene::Mesh mesh;
    const double far = 1048576.0 + 7777.7 * i, wide = 2.0 * far;
    mesh.positions = {{-wide, -wide, -far}, {wide, -wide, -far}, {wide, wide, -far}, {-wide, wide, -far}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene::addPart(scene, "plane", mesh, glm::vec3(0.5F));
    scene::setStillCamera(scene, {{0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, 45.0});
    Given given = {{"geometry", std::string("depth_variance")},
                   {"geometry.depth", std::string("linear")},
                   {"geometry.depth_scale", 1.0},
                   {"lightness", std::string("none")}};
    EXPECT_EQ(render(scene, "antialiasing/adaptive", given, kSizePx, true).counter("samples_per_px"), 1.0);
    given["geometry.form"] = std::string("printed");
    most = std::max(most,
                    render(scene, "antialiasing/adaptive", given, kSizePx, true).counter("samples_per_px"));
  }
  EXPECT_GT(most, 1.5);
}

TEST_F(Antialiasing, AllExecutionsGiveTheSamePictureToTheBit) {
  for (const char* name : {"comb", "mirrors/ball"}) {
    const scene::Scene scene = makeScene(name);
    for (int window = 2; window <= 4; ++window) {
      const Given common = {
          {"window", int64_t{window}}, {"shading.shadow", true}, {"light_samples", int64_t{3}}};
      Given given = common;
      given["execution"] = std::string("loop");
      const Image loop = render(scene, "antialiasing/adaptive", given, {61, 43}).product;
      for (const char* execution : {"grouped", "sorted", "balanced"}) {
        given["execution"] = std::string(execution);
        EXPECT_EQ(render(scene, "antialiasing/adaptive", given, {61, 43}).product.data, loop.data)
            << execution << ", " << name << ", " << window;
      }
      // With every sample asked for, adaptive shading is full shading.
      given["execution"] = std::string("balanced");
      given["lightness"] = std::string("luminance_range");
      given["lightness.least_range"] = 0.0;
      given["lightness.edge_share"] = 0.0;
      given["lightness.scale"] = 1e6;
      given["geometry"] = std::string("min_max_depth");
      given["geometry.depth_scale"] = 1e12;
      const Image full = render(scene, "antialiasing/full", common, {61, 43}).product;
      const Image all = render(scene, "antialiasing/adaptive", given, {61, 43}).product;
      // Where neither depth nor light differs there is one sample in place of the mean of as many equal ones.
      for (size_t i = 0; i < all.data.size(); ++i)
        ASSERT_NEAR(all.data[i], full.data[i], 2e-6) << name << ", " << window;
    }
  }
}

TEST_F(Antialiasing, OneSampleIsTheShadedPicture) {
  const scene::Scene scene = makeScene("comb");
  const Image one = render(scene, "antialiasing/one_sample", {{"shading.shadow", true}}, kSizePx).product;
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, kSizePx);
  frame.begin();
  frame::ShadedSetting setting;
  setting.shadow = true;
  const Image shaded = frame.get<frame::Shaded>(setting).texture().read();
  frame.end();
  ASSERT_EQ(one.data.size(), shaded.data.size());
  for (size_t i = 0; i < one.data.size(); ++i) ASSERT_NEAR(one.data[i], shaded.data[i], 1e-6) << i;
}

// Without anti-aliasing a crossed pixel is off by up to a half. Filters of the finished picture know the line
// from its steps: far below the error of the picture that they start from. A window of 2 has 3 of 8 at most,
// a quarter typically.
TEST_F(Antialiasing, FiltersOfThePictureFindStraightEdges) {
  for (const double slope : {0.1, 0.2}) {
    const HalfPlane line(slope, 30.2);
    const double before = errorsOf(line, "antialiasing/one_sample", {}).rms;
    EXPECT_LT(errorsOf(line, "antialiasing/morphological", {}).rms, 0.45 * before);
    EXPECT_LT(errorsOf(line, "antialiasing/fxaa", {}).rms, 0.71 * before);
  }
}

TEST_F(Antialiasing, FiltersLeaveFlatPicturesAlone) {
  const HalfPlane everywhere(0.0, 500.0);
  for (const char* technique : {"antialiasing/fxaa", "antialiasing/morphological"})
    for (const float value : render(everywhere.scene(), technique, white(), kSizePx).product.data)
      ASSERT_EQ(value, 1.0F);
}

}  // namespace
}  // namespace limen::techniques
