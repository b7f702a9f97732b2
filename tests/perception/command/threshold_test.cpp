// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive threshold: the known threshold of a flat field, and the files that it writes.
#include "tests/perception/command/perceive_fixture.h"

namespace limen::perception {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using ThresholdCli = PerceiveCli;

// 0.2 tvi_W(100 cd/m2) = 0.2 * 10^(2 - 1.255), Ward's branch for lg L >= 1.9.
const double kThresholdAt100 = 0.2 * std::pow(10.0, 0.745);

TEST_F(ThresholdCli, FlatFieldHasThePublishedThreshold) {
  ASSERT_NEAR(kThresholdAt100, 1.11181, 5e-6);
  save("flat.exr", flat(64, 48, {100.0F, 100.0F, 100.0F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  const nlohmann::json found =
      result({"threshold", "flat.exr", "--map", "single", "--scene-luminance", "-o", "map.exr"});
  for (const char* name : {"min", "p1", "median", "p99", "max", "mean"})
    EXPECT_NEAR(figure(found, name), kThresholdAt100, 2e-5) << name;
  EXPECT_NEAR(figure(found, "mean_adaptation"), 100.0, 1e-4);
  EXPECT_EQ(found.at("units").at("median"), "cd/m2");
  const ImageFile map = readImageFile(path("map.exr"));
  ASSERT_EQ(map.image.width, 64);
  ASSERT_EQ(map.image.height, 48);
  EXPECT_FALSE(map.integer);
  for (const float value : map.image.data) EXPECT_NEAR(value, kThresholdAt100, 2e-5);
}

TEST_F(ThresholdCli, SameFieldInAnyFormHasTheSameThreshold) {
  // 100 cd/m2 on a display of 0.5 to 250: light (100 - 0.5) / 249.5. A 16-bit code is right to 1 / 131070, of
  // which the curve and the threshold (proportional to luminance here) make less than 1e-4 of the value.
  const float lit = 99.5F / 249.5F, coded = static_cast<float>(code(lit));
  save("lit.exr", flat(32, 32, {lit, lit, lit}), {OIIO::TypeDesc::FLOAT, {}, {}});
  save("grey.exr", flat(32, 32, {lit}), {OIIO::TypeDesc::FLOAT, {}, {}});
  save("coded.png", flat(32, 32, {coded, coded, coded}), {OIIO::TypeDesc::UINT16, {}, {}});
  save("coded8.tif", flat(32, 32, {coded}));
  EXPECT_NEAR(figure(result({"threshold", "lit.exr", "--map", "single"}), "median"), kThresholdAt100, 2e-5);
  EXPECT_NEAR(figure(result({"threshold", "grey.exr", "--map", "single"}), "median"), kThresholdAt100, 2e-5);
  EXPECT_NEAR(figure(result({"threshold", "coded.png", "--map", "single"}), "median"), kThresholdAt100,
              1e-4 * kThresholdAt100);
  // 8 bits: half a step of code in light.
  const double step = light(coded + 0.5 / 255) - light(coded);
  EXPECT_NEAR(figure(result({"threshold", "coded8.tif", "--map", "single"}), "median"), kThresholdAt100,
              1.01 * kThresholdAt100 * step * 249.5 / 100.0);
}

TEST_F(ThresholdCli, StatisticsAreThoseOfTheMap) {
  save("a.png", noise(40, 30, 3, 1));
  const nlohmann::json found =
      result({"threshold", "a.png", "-o", "map.exr", "-o", "map.png", "--scale", "50"});
  std::vector<float> values = readImageFile(path("map.exr")).image.data;
  double sum = 0.0;
  for (const float value : values) sum += value;
  std::sort(values.begin(), values.end());
  EXPECT_NEAR(figure(found, "min"), values.front(), 1e-5);
  EXPECT_NEAR(figure(found, "max"), values.back(), 1e-4);
  EXPECT_NEAR(figure(found, "mean"), sum / 1200.0, 1e-4);
  EXPECT_NEAR(figure(found, "median"), values[599], 1e-5);  // nearest rank: the 600th of 1200
  EXPECT_NEAR(figure(found, "p95"), values[1139], 1e-4);
  EXPECT_EQ(found.at("picture_scale_cd_m2"), 50.0);
  const ImageFile picture = readImageFile(path("map.png"));
  EXPECT_EQ(picture.image.width, 40);
  EXPECT_TRUE(picture.integer);
  // The picture says of itself what it shows.
  const auto in = OIIO::ImageInput::open(path("map.png"));
  const std::string words = in->spec().get_string_attribute("ImageDescription");
  EXPECT_THAT(words, AllOf(HasSubstr("50 cd/m2"), HasSubstr("threshold map"), HasSubstr("schwarz_2009")));
}

TEST_F(ThresholdCli, SettingsReachTheModelAndTheStatement) {
  save("flat.exr", flat(32, 32, {100.0F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  const nlohmann::json found =
      result({"threshold", "flat.exr", "--map", "single", "--scene-luminance", "--set", "tvi_factor=0.4"});
  EXPECT_NEAR(figure(found, "median"), 2.0 * kThresholdAt100, 4e-5);
  EXPECT_EQ(found.at("settings").at("tvi_factor"), 0.4);
  EXPECT_THAT(found.at("statement").get<std::string>(),
              AllOf(HasSubstr("Limen 0."), HasSubstr("threshold map"), HasSubstr("tvi_factor 0.4"),
                    HasSubstr("display schwarz_2009"), Not(HasSubstr("\n"))));
  expectRefused({"threshold", "flat.exr", "--map", "single", "--set", "tvi_facter=0.4"}, {"tvi_factor"});
  EXPECT_THAT(call({"threshold", "--map", "single", "--list"}).out, HasSubstr("tvi_factor=0.2"));
  EXPECT_THAT(call({"threshold", "--help"}).out, HasSubstr("predictor.minkowski_exponent="));
}

TEST_F(ThresholdCli, SettingsOfAResultRepeatIt) {
  save("a.png", noise(40, 30, 3, 1));
  const nlohmann::json first = result({"threshold", "a.png", "--map", "single", "--set", "tvi_factor=0.31",
                                       "--set", "masking=lubin", "--set", "levels=5"});
  std::vector<std::string> again = {"threshold", "a.png", "--map", "single"};
  for (const auto& [name, value] : first.at("settings").items()) {
    if (name == "input") continue;
    again.emplace_back("--set");
    again.push_back(name + "=" + (value.is_string() ? value.get<std::string>() : value.dump()));
  }
  const nlohmann::json second = result(again);
  EXPECT_EQ(second.at("figures"), first.at("figures"));
  EXPECT_EQ(second.at("settings"), first.at("settings"));
  EXPECT_EQ(second.at("statement"), first.at("statement"));
}

TEST_F(ThresholdCli, RefusesToOverwriteAndToMixUpFiles) {
  save("a.exr", flat(8, 8, {0.5F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  const std::string before = read("a.exr");
  expectRefused({"threshold", "a.exr", "-o", "a.exr"}, {"never overwritten"});
  expectRefused({"threshold", "a.exr", "-o", "./x/../a.exr"}, {"never overwritten"});
  std::filesystem::create_symlink(path("a.exr"), path("link.exr"));
  std::filesystem::create_hard_link(path("a.exr"), path("twin.exr"));
  expectRefused({"threshold", "a.exr", "-o", "link.exr"}, {"never overwritten"});
  expectRefused({"threshold", "a.exr", "-o", "twin.exr"}, {"never overwritten"});
  expectRefused({"threshold", "a.exr", "-o", "m.exr", "-o", "m.exr"}, {"written twice"});
  expectRefused({"threshold", "a.exr", "-o", "m.jpg"}, {".exr or .png"});
  expectRefused({"threshold"}, {"an image is missing"});
  expectRefused({"threshold", "a.exr", "-o", "a.exr/m.exr"}, {"a.exr: the folder cannot be made"});
  expectRefused({"threshold", "a.exr", "-o", "/proc/m.exr"}, {"/proc/m.exr: cannot be written"});
  EXPECT_EQ(read("a.exr"), before);
}

TEST_F(ThresholdCli, SequencesWriteAMapForEachFrame) {
  for (int n = 1; n <= 3; ++n)
    save("f_00" + std::to_string(n) + ".exr", flat(16, 16, {100.0F * static_cast<float>(n) / 2.0F}),
         {OIIO::TypeDesc::FLOAT, {}, {}});
  const experiments::CallResult answer = call(
      {"threshold", "f_%03d.exr", "--map", "single", "--scene-luminance", "--json", "-o", "maps/t_###.exr"});
  ASSERT_EQ(answer.exitCode, 0) << answer.err;
  const std::vector<nlohmann::json> lines = jsonLines(answer.out);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_NEAR(figure(lines[1], "median"), kThresholdAt100, 2e-5);
  EXPECT_EQ(lines[3].at("figures").at("median").at("max_frame"), "frame 3");
  for (int n = 1; n <= 3; ++n) EXPECT_TRUE(exists("maps/t_00" + std::to_string(n) + ".exr"));
  expectRefused({"threshold", "f_%03d.exr", "--map", "single", "-o", "t.exr"}, {"%04d"});
}

TEST_F(ThresholdCli, OddImagesAreFinite) {
  save("one.png", flat(1, 1, {0.5F, 0.5F, 0.5F}));
  save("black.png", flat(33, 7, {0.0F, 0.0F, 0.0F}));
  save("row.exr", flat(50, 1, {1e30F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  for (const char* name : {"one.png", "black.png", "row.exr"})
    for (const char* kind : {"bands", "single"}) {
      const nlohmann::json found = result({"threshold", name, "--map", kind});
      expectFinite(found);
      EXPECT_GT(figure(found, "min"), 0.0) << name << ' ' << kind;
    }
}

TEST_F(ThresholdCli, BandsAreTheDefaultAndOneCanBeAskedFor) {
  save("flat.exr", flat(128, 96, {100.0F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  const nlohmann::json combined = result({"threshold", "flat.exr", "--scene-luminance"});
  EXPECT_THAT(combined.at("statement").get<std::string>(), HasSubstr("by frequency band"));
  ASSERT_GE(combined.at("bands").size(), 4U);
  // No band of a flat field is masked: the combined map is no larger than the most sensitive band's.
  double least = 1e9;
  for (size_t band = 0; band < combined.at("bands").size(); ++band) {
    const nlohmann::json one = result({"threshold", "flat.exr", "--scene-luminance", "--set", "output=band",
                                       "--set", "output.band=" + std::to_string(band)});
    EXPECT_NEAR(figure(one, "median"), combined.at("bands")[band].at("median_cd_m2").get<double>(), 1e-6);
    EXPECT_NEAR(figure(one, "min") / figure(one, "max"), 1.0, 1e-9);
    least = std::min(least, figure(one, "median"));
  }
  EXPECT_LT(figure(combined, "max"), least);
  EXPECT_GT(figure(combined, "min"), 0.2 * least);
  expectRefused({"threshold", "flat.exr", "--set", "output=band", "--set", "output.band=9"},
                {"frequency band"});
  expectRefused({"threshold", "flat.exr", "--map", "one"}, {"bands"});
}

}  // namespace
}  // namespace limen::perception
