// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/camera_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "experiments/base/error.h"

namespace limen::scene {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Equality of all bits: tells 0 from -0.
bool sameBits(const Camera& a, const Camera& b) {
  static_assert(sizeof(Camera) == 10 * sizeof(double), "cameras are compared without padding");
  return std::memcmp(&a, &b, sizeof(Camera)) == 0;
}

std::string cameraRefusal(const std::string& text) {
  try {
    parseCamera(text, "here");
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

TEST(CameraText, ReadsItsForm) {
  const Camera camera = parseCamera("eye 1 2.5 -3e2 target 0 .5 +4 up 0 0 1 fov 32.5");
  EXPECT_EQ(camera.eye, glm::dvec3(1.0, 2.5, -300.0));
  EXPECT_EQ(camera.target, glm::dvec3(0.0, 0.5, 4.0));
  EXPECT_EQ(camera.up, glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(camera.verticalFovDeg, 32.5);
}

TEST(CameraText, UpAndFieldOfViewMayBeLeftOut) {
  EXPECT_TRUE(sameBits(parseCamera("eye 0 0 5 target 0 0 0"), Camera{}));
  EXPECT_TRUE(sameBits(parseCamera("  fov 45\ttarget 0 0 0  eye 0 0 5 "), Camera{}));
}

TEST(CameraText, ReadsBackToTheSameDoubles) {
  constexpr double kDenormal = std::numeric_limits<double>::denorm_min();
  const std::vector<Camera> cameras = {
      Camera{},
      {{0.1, 1.0 / 3.0, -2.0 / 3.0}, {1e-17, -0.0, 0.0}, {-0.0, 1.0, -0.0}, 0.01},
      // A picometre beside 1e15: neighbouring doubles far from the origin.
      {{1e6 + 1e-10, 2e6, 3e6}, {1e6, std::nextafter(2e6, 0.0), 3e6}, {0.0, 0.0, 1.0}, 179.0},
      {{1e15, 1e15 + 1.0, 123456789012345678.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 1.0 / 3.0},
      {{kDenormal, -kDenormal, 1.0}, {0.0, 4.9e-310, 0.0}, {2.5e-320, 1.0, 0.0}, 45.0},
      {{1e149, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 1e-149, 0.0}, 45.0},
  };
  for (const Camera& camera : cameras)
    EXPECT_TRUE(sameBits(parseCamera(toText(camera)), camera)) << toText(camera);
}

TEST(CameraText, ReadsBackToTheSameDoublesWhateverTheirBits) {
  std::mt19937_64 random(7);
  // Any finite double up to 1e100, sign and denormals included.
  const auto any = [&] {
    for (;;) {
      const uint64_t bits = random();
      double value = 0.0;
      std::memcpy(&value, &bits, sizeof value);
      if (std::abs(value) <= 1e100) return value;
    }
  };
  for (int i = 0; i < 10000; ++i) {
    // The target's z keeps it from the eye and `up` across the view.
    const Camera camera = {{any(), any(), any()}, {any(), any(), 1e120}, {1.0, any() * 1e-101, 0.0}, 45.0};
    ASSERT_TRUE(sameBits(parseCamera(toText(camera)), camera)) << toText(camera);
  }
}

TEST(CameraText, RefusesOtherTextWithWhatWasFoundAndTheForm) {
  const auto form = HasSubstr("write 'eye X Y Z target X Y Z'");
  EXPECT_THAT(cameraRefusal("walk"),
              AllOf(HasSubstr("here: camera 'walk'"), HasSubstr("'walk' where eye"), form));
  EXPECT_THAT(cameraRefusal(""), AllOf(HasSubstr("'eye' is missing"), form));
  EXPECT_THAT(cameraRefusal("eye 0 0 5"), HasSubstr("'target' is missing"));
  EXPECT_THAT(cameraRefusal("eye 0 0"), HasSubstr("a number of 'eye' is missing"));
  EXPECT_THAT(cameraRefusal("eye 0 0 target 0 0 0"), HasSubstr("'target' of 'eye' is not a number"));
  EXPECT_THAT(cameraRefusal("eye 0, 0, 5 target 0 0 0"), HasSubstr("no commas"));
  EXPECT_THAT(cameraRefusal("eye 0 0 5 target 0 0 0 eye 0 0 6"), HasSubstr("'eye' is given twice"));
  EXPECT_THAT(cameraRefusal("eye 0 0 5 target 0 0 0 0"), HasSubstr("'0' where eye"));
  EXPECT_THAT(cameraRefusal("eye 0 0 0x5 target 0 0 0"), HasSubstr("not a number"));
  EXPECT_THAT(cameraRefusal("eye 0 0 +-5 target 0 0 0"), HasSubstr("not a number"));
  EXPECT_THAT(cameraRefusal("eye 0 0 1e999 target 0 0 0"), HasSubstr("beyond the range"));
}

TEST(CameraText, RefusesCamerasThatTakeNoPicture) {
  EXPECT_THAT(cameraRefusal("eye nan 0 5 target 0 0 0"), HasSubstr("not finite"));
  EXPECT_THAT(cameraRefusal("eye 0 0 5 target 0 inf 0"), HasSubstr("not finite"));
  EXPECT_THAT(cameraRefusal("eye 1 2 3 target 1 2 3"), HasSubstr("same point"));
  // The same double, though written differently.
  EXPECT_THAT(cameraRefusal("eye 1e17 0 0 target 100000000000000001 0 0"), HasSubstr("same point"));
  EXPECT_THAT(cameraRefusal("eye 1e-200 0 0 target 0 0 0"), HasSubstr("too near or too far"));
  EXPECT_THAT(cameraRefusal("eye 1e200 0 0 target 0 0 0"), HasSubstr("too near or too far"));
  EXPECT_THAT(cameraRefusal("eye 0 5 0 target 0 0 0"), HasSubstr("parallel to the view"));
  EXPECT_THAT(cameraRefusal("eye 0 0 5 target 0 0 0 up 0 0 -2"), HasSubstr("parallel to the view"));
  EXPECT_THAT(cameraRefusal("eye 0 0 5 target 0 0 0 up 0 0 0"), HasSubstr("no usable length"));
  for (const char* fov : {"0", "-45", "0.009", "179.5", "360", "nan"})
    EXPECT_THAT(cameraRefusal(std::string("eye 0 0 5 target 0 0 0 fov ") + fov), HasSubstr("here: camera '"))
        << fov;
  EXPECT_THAT(cameraRefusal("eye 0 0 5 target 0 0 0 fov 180"), HasSubstr("allowed: 0.01 to 179"));
  // Almost straight down still has an up.
  EXPECT_EQ(cameraRefusal("eye 0 5 0.001 target 0 0 0"), "taken");
}

}  // namespace
}  // namespace limen::scene
