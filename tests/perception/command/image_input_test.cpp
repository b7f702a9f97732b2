// SPDX-License-Identifier: BSD-3-Clause
// What files mean: the same picture in every format gives the same answer, and what was assumed is said.
#include <limits>

#include "tests/perception/command/perceive_fixture.h"

namespace limen::perception {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class ImageInputCli : public PerceiveCli {
 protected:
  nlohmann::json compared(const std::string& a, const std::string& b,
                          std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"compare", a, b, "--metrics", "rmse,largest_error,de94"};
    words.insert(words.end(), more.begin(), more.end());
    return result(words);
  }
};

TEST_F(ImageInputCli, EveryFormatShowsTheSamePicture) {
  const Image picture = noise(33, 21, 3, 1), lit = mapped(picture, light);
  save("a.png", picture);
  save("a16.png", picture, {OIIO::TypeDesc::UINT16, {}, {}});
  save("a.tif", picture);
  save("a16.tif", picture, {OIIO::TypeDesc::UINT16, {}, {}});
  save("a32.tif", lit, {OIIO::TypeDesc::FLOAT, {}, {}});
  save("a.exr", lit, {OIIO::TypeDesc::FLOAT, {}, {}});
  save("half.exr", lit, {OIIO::TypeDesc::HALF, {}, {}});
  save("a.hdr", lit, {OIIO::TypeDesc::FLOAT, {}, {}});
  // Largest errors in light: a half has 11 bits, so 2^-12 of values below 1; RGBE stores 8 bits of the
  // largest channel's power of two and cuts off: up to 2^-7 of values in [0.5, 1).
  const std::pair<const char*, double> cases[] = {
      {"a16.png", 1e-6}, {"a.tif", 1e-7},          {"a16.tif", 1e-6},   {"a32.tif", 1e-6},
      {"a.exr", 1e-6},   {"half.exr", 1.0 / 4096}, {"a.hdr", 1.0 / 128}};
  for (const auto& [name, bound] : cases)
    EXPECT_LE(figure(compared(name, "a.png"), "largest_error"), bound) << name;
}

TEST_F(ImageInputCli, JpegOfAFlatPictureIsThePicture) {
  // A flat grey has no frequencies to lose: only rounding to 8 bits remains.
  save("a.png", flat(32, 32, {100 / 255.0F, 100 / 255.0F, 100 / 255.0F}));
  save("a.jpg", flat(32, 32, {100 / 255.0F, 100 / 255.0F, 100 / 255.0F}),
       {OIIO::TypeDesc::UINT8, {}, {{"CompressionQuality", 95}}});
  const nlohmann::json found = compared("a.jpg", "a.png");
  EXPECT_LE(figure(found, "largest_error_coded"), 1.0 / 255 + 1e-6);
  EXPECT_THAT(found.at("inputs").at("image").at("kind"), "8-bit jpeg");
}

TEST_F(ImageInputCli, GreyEqualsColourOfEqualChannels) {
  const Image grey = noise(16, 12, 1, 2);
  Image colour(16, 12, 3);
  for (size_t i = 0; i < colour.data.size(); ++i) colour.data[i] = grey.data[i / 3];
  save("grey.png", grey);
  save("colour.png", colour);
  EXPECT_EQ(figure(compared("grey.png", "colour.png"), "largest_error"), 0.0);
}

TEST_F(ImageInputCli, SaysWhatWasAssumedAndObeysOptions) {
  save("a.png", flat(8, 8, {0.5F, 0.5F, 0.5F}));
  save("a.exr", flat(8, 8, {0.5F, 0.5F, 0.5F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  const nlohmann::json found = compared("a.png", "a.exr");
  EXPECT_THAT(found.at("inputs").at("image").at("assumed"), HasSubstr("display-coded, sRGB"));
  EXPECT_THAT(found.at("inputs").at("reference").at("assumed"), HasSubstr("linear light"));
  // 128/255 in code is not 0.5 in light: 0.2158605 is.
  EXPECT_NEAR(figure(found, "largest_error"), 0.5 - light(128.0 / 255), 1e-6);
  EXPECT_NEAR(figure(compared("a.png", "a.exr", {"--linear"}), "largest_error"), 128.0 / 255 - 0.5, 1e-6);
  EXPECT_NEAR(figure(compared("a.png", "a.exr", {"--coded"}), "largest_error"),
              light(128.0 / 255) - light(0.5), 1e-6);
}

TEST_F(ImageInputCli, AbsoluteLuminanceSpansTheDisplaysBlackToItsWhite) {
  // schwarz_2009 shows 0.5 to 250 cd/m2 in the dark: 125.25 lies half way.
  save("a.exr", flat(8, 8, {125.25F, 125.25F, 125.25F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  save("b.exr", flat(8, 8, {1e4F, 1e4F, 1e4F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  const nlohmann::json found = compared("a.exr", "b.exr", {"--scene-luminance", "--display", "schwarz_2009"});
  EXPECT_NEAR(figure(found, "largest_error"), 0.5, 1e-6);
  EXPECT_EQ(found.at("inputs").at("reference").at("clipped_px"), 64);
  EXPECT_THAT(found.at("warnings").dump(), HasSubstr("brighter than the display's white"));
}

TEST_F(ImageInputCli, AlphaIsInFrontOfBlackInLightUnlessIgnored) {
  // (200, 100, 50)/255 half covered: its light, halved.
  save("a.png", flat(4, 4, {200 / 255.0F, 100 / 255.0F, 50 / 255.0F, 128 / 255.0F}),
       {OIIO::TypeDesc::UINT8, {}, {{"oiio:UnassociatedAlpha", 1}}});
  save("opaque.png", flat(4, 4, {200 / 255.0F, 100 / 255.0F, 50 / 255.0F}));
  const double cover = 128.0 / 255;
  Image covered =
      flat(4, 4,
           {static_cast<float>(cover * light(200.0 / 255)), static_cast<float>(cover * light(100.0 / 255)),
            static_cast<float>(cover * light(50.0 / 255))});
  save("covered.exr", covered, {OIIO::TypeDesc::FLOAT, {}, {}});
  const nlohmann::json found = compared("a.png", "covered.exr");
  EXPECT_LE(figure(found, "largest_error"), 1e-6);
  EXPECT_EQ(found.at("inputs").at("image").at("alpha"), "composited over black");
  EXPECT_EQ(figure(compared("a.png", "opaque.png", {"--alpha", "ignore"}), "largest_error"), 0.0);
  EXPECT_TRUE(compared("a.png", "opaque.png").at("figures").at("rmse_coded").is_null());
}

TEST_F(ImageInputCli, NonFinitePixelsAreCountedWarnedOfAndLeaveFiniteFigures) {
  Image broken = flat(8, 8, {0.25F, 0.25F, 0.25F});
  broken.at(1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
  broken.at(2, 2, 1) = std::numeric_limits<float>::infinity();
  broken.at(3, 3, 2) = -std::numeric_limits<float>::infinity();
  save("broken.exr", broken, {OIIO::TypeDesc::FLOAT, {}, {}});
  save("sound.exr", flat(8, 8, {0.25F, 0.25F, 0.25F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  for (const auto& [a, b] : {std::pair{"broken.exr", "sound.exr"}, std::pair{"sound.exr", "broken.exr"}}) {
    const experiments::CallResult answer =
        call({"compare", a, b, "--json", "--metrics", "rmse,ssim,de94,non_finite"});
    EXPECT_EQ(answer.exitCode, 0);
    EXPECT_THAT(answer.err, HasSubstr("3 values are infinite or not a number"));
    const nlohmann::json found = jsonLines(answer.out).front();
    expectFinite(found);
    EXPECT_GT(figure(found, "rmse"), 0.0);
  }
  EXPECT_EQ(figure(result({"compare", "broken.exr", "sound.exr", "--metrics", "non_finite"}), "non_finite"),
            3.0);
}

TEST_F(ImageInputCli, FilesThatStateAnotherMeaningGetAWarning) {
  save("linear.png", noise(8, 8, 3, 3), {OIIO::TypeDesc::UINT8, {{"oiio:ColorSpace", "Linear"}}, {}});
  save("plain.png", noise(8, 8, 3, 3));
  EXPECT_THAT(compared("linear.png", "plain.png").at("warnings").dump(), HasSubstr("linear"));
  EXPECT_THAT(compared("plain.png", "plain.png").at("warnings"), IsEmpty());
}

TEST_F(ImageInputCli, OrientationIsThatOfAViewer) {
  // Orientation 6: the file's rows are the upright picture's columns, from the right.
  const Image upright = noise(5, 9, 3, 4);
  Image stored(9, 5, 3);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 5; ++x)
      for (int c = 0; c < 3; ++c) stored.at(y, 4 - x, c) = upright.at(x, y, c);
  save("upright.tif", upright);
  save("turned.tif", stored, {OIIO::TypeDesc::UINT8, {}, {{"Orientation", 6}}});
  EXPECT_EQ(figure(compared("turned.tif", "upright.tif"), "largest_error"), 0.0);
}

TEST_F(ImageInputCli, RefusesWhatIsNoPairOfImages) {
  save("a.png", noise(8, 8, 3, 5));
  save("wide.png", noise(9, 8, 3, 5));
  save("two.tif", noise(8, 8, 2, 5));
  write("text.png", "this is no image");
  write("empty.exr", "");
  std::filesystem::create_directory(path("folder"));
  std::filesystem::copy_file(path("a.png"), path("cut.png"));
  std::filesystem::resize_file(path("cut.png"), std::filesystem::file_size(path("a.png")) / 2);
  expectRefused({"compare", "a.png", "wide.png"}, {"8 x 8", "9 x 8", "same size"});
  expectRefused({"compare", "a.png", "none.png"}, {"no such image 'none.png'"});
  expectRefused({"compare", "a.png", "text.png"}, {"cannot read image 'text.png'"});
  expectRefused({"compare", "a.png", "empty.exr"}, {"cannot read image 'empty.exr'"});
  expectRefused({"compare", "a.png", "cut.png"}, {"cannot read image 'cut.png'", "complete"});
  expectRefused({"compare", "a.png", "two.tif"}, {"channels"});
  expectRefused({"compare", "a.png", "folder"}, {"folder"});
  expectRefused({"compare", "a.png"}, {"an image is missing"});
  expectRefused({"compare", "a.png", "a.png", "--display", "schwarz"}, {"schwarz_2009"});
  expectRefused({"compare", "a.png", "a.png", "--alpha", "blend"}, {"over_black"});
  expectRefused({"compare", "a.png", "a.png", "--scene-luminance"}, {"integers"});
  expectRefused({"compare", "a.png", "a.png", "--linear", "--coded"}, {"--linear", "--coded"});
  expectRefused({"compare", "a.png", "a.png", "a.png"}, {"unknown argument 'a.png'", "quote"});
  expectRefused({"compare", "a.png", "a.png", "--fail-abov", "rmse=1"}, {"--fail-above"});
}

TEST_F(ImageInputCli, CutJpegAndExrAreRefused) {
  save("a.jpg", noise(64, 64, 3, 6));
  save("a.exr", noise(64, 64, 3, 6), {OIIO::TypeDesc::FLOAT, {}, {}});
  for (const char* name : {"a.jpg", "a.exr"}) {
    std::filesystem::resize_file(path(name), std::filesystem::file_size(path(name)) / 2);
    expectRefused({"compare", name, name}, {"cannot read image"});
  }
}

TEST_F(ImageInputCli, OnePixelAndOneRowAreImages) {
  save("a.png", flat(1, 1, {0.5F, 0.5F, 0.5F}));
  save("b.png", flat(1, 1, {0.25F, 0.5F, 0.5F}));
  save("row.png", noise(40, 1, 1, 7));
  for (const auto& [a, b] : {std::pair{"a.png", "b.png"}, std::pair{"row.png", "row.png"}}) {
    const nlohmann::json found = result({"compare", a, b});
    expectFinite(found);
  }
}

}  // namespace
}  // namespace limen::perception
