// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive pop: regions, ratings, maps and limits. The model itself has tests of its own; here its
// answers are held to what the written files say.
#include <map>

#include "tests/perception/command/perceive_fixture.h"

namespace limen::perception {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class PopCli : public PerceiveCli {
 protected:
  /// A noisy picture, and the same with two patches that pop.
  void savePair(const std::string& before, const std::string& after) const {
    Image image = noise(96, 80, 3, 1);
    save(before, image);
    for (int y = 20; y < 36; ++y)
      for (int x = 16; x < 32; ++x)
        for (int c = 0; c < 3; ++c) image.at(x, y, c) = (x / 4 + y / 4) % 2 ? 220 / 255.0F : 30 / 255.0F;
    for (int y = 56; y < 64; ++y)
      for (int x = 70; x < 78; ++x) image.at(x, y, 0) = 230 / 255.0F;
    save(after, image);
  }
};

TEST_F(PopCli, IdenticalFramesDoNotPop) {
  save("a.png", noise(64, 48, 3, 1));
  const nlohmann::json found = result({"pop", "a.png", "a.png", "--jnd", "jnd.exr"});
  EXPECT_EQ(figure(found, "region_count"), 0.0);
  EXPECT_EQ(figure(found, "largest_jnd"), 0.0);
  EXPECT_EQ(figure(found, "max_de94"), 0.0);
  EXPECT_TRUE(found.at("figures").at("rating").is_null());
  EXPECT_FALSE(found.contains("unavailable"));
  EXPECT_THAT(found.at("regions"), IsEmpty());
  for (const float value : readImageFile(path("jnd.exr")).image.data) EXPECT_EQ(value, 0.0F);
  // Nothing popped: no limit is exceeded.
  EXPECT_EQ(call({"pop", "a.png", "a.png", "--fail-above", "-5"}).exitCode, 0);
  EXPECT_THAT(call({"pop", "a.png", "a.png"}).out, HasSubstr("no popping region"));
}

TEST_F(PopCli, RegionsAreThoseOfTheWrittenMaps) {
  savePair("old.png", "new.png");
  const nlohmann::json found =
      result({"pop", "old.png", "new.png", "--jnd", "jnd.exr", "--stages", "stages"});
  const Image jnd = readImageFile(path("jnd.exr")).image,
              labels = readImageFile(path("stages/labels.exr")).image;
  struct Region {
    int size = 0, left = 1000, top = 1000, right = -1, bottom = -1;
    double power = 0.0, largest = 0.0;
  };
  std::map<int, Region> regions;
  for (int y = 0; y < jnd.height; ++y)
    for (int x = 0; x < jnd.width; ++x) {
      if (labels.at(x, y) == 0.0F) continue;
      Region& r = regions[static_cast<int>(labels.at(x, y))];
      EXPECT_GE(jnd.at(x, y), 2.0F);
      r.size += 1;
      r.left = std::min(r.left, x), r.right = std::max(r.right, x);
      r.top = std::min(r.top, y), r.bottom = std::max(r.bottom, y);
      r.power += std::pow(double{jnd.at(x, y)}, 2.4);
      r.largest = std::max(r.largest, double{jnd.at(x, y)});
    }
  ASSERT_FALSE(regions.empty());
  ASSERT_EQ(found.at("regions").size(), regions.size());
  EXPECT_EQ(figure(found, "region_count"), static_cast<double>(regions.size()));
  double highest = -1e9, last = 1e9;
  for (const nlohmann::json& told : found.at("regions")) {
    const Region& r = regions.at(told.at("label").get<int>());
    EXPECT_EQ(told.at("size_px"), r.size);
    EXPECT_EQ(told.at("x_px"), r.left);
    EXPECT_EQ(told.at("y_px"), r.top);
    EXPECT_EQ(told.at("width_px"), r.right - r.left + 1);
    EXPECT_EQ(told.at("height_px"), r.bottom - r.top + 1);
    EXPECT_NEAR(told.at("largest_jnd").get<double>(), r.largest, 1e-5 * r.largest);
    const double sigma = std::pow(r.power, 1.0 / 2.4), rating = std::log(0.375 * sigma) / std::log(2.25);
    EXPECT_NEAR(told.at("sigma_jnd").get<double>(), sigma, 1e-5 * sigma);
    EXPECT_NEAR(told.at("rating").get<double>(), rating, 1e-5);
    EXPECT_LE(told.at("rating").get<double>(), last);  // highest first
    last = told.at("rating").get<double>();
    highest = std::max(highest, rating);
  }
  EXPECT_NEAR(figure(found, "rating"), highest, 1e-5);
  // The logistic of the declared detection model.
  const nlohmann::json& set = found.at("settings");
  const double guess = set.at("detection.guess_rate"), lapse = set.at("detection.lapse_rate");
  const double odds = std::exp(-(highest - set.at("detection.midpoint").get<double>()) /
                               set.at("detection.scale").get<double>());
  EXPECT_NEAR(figure(found, "detection_probability"), guess + (1.0 - guess - lapse) / (1.0 + odds), 1e-5);
  std::vector<float> values = jnd.data;
  std::sort(values.begin(), values.end());
  EXPECT_NEAR(figure(found, "largest_jnd"), values.back(), 1e-5 * values.back());
  EXPECT_NEAR(figure(found, "median_jnd"), values[values.size() / 2 - 1], 1e-5);
}

TEST_F(PopCli, OverlayColoursRegionsOnGrey) {
  savePair("old.png", "new.png");
  const nlohmann::json found = result({"pop", "old.png", "new.png", "--overlay", "over.png"});
  const Image picture = readImageFile(path("over.png")).image;
  ASSERT_EQ(picture.width, 96);
  ASSERT_GE(picture.height, 80);
  const auto spread = [&](int x, int y) {
    const float r = picture.at(x, y, 0), g = picture.at(x, y, 1), b = picture.at(x, y, 2);
    return std::max({r, g, b}) - std::min({r, g, b});
  };
  for (const nlohmann::json& region : found.at("regions")) {
    double most = 0.0;
    for (int y = 0; y < region.at("height_px").get<int>(); ++y)
      for (int x = 0; x < region.at("width_px").get<int>(); ++x)
        most = std::max(most,
                        double{spread(region.at("x_px").get<int>() + x, region.at("y_px").get<int>() + y)});
    EXPECT_GT(most, 0.1);
  }
  EXPECT_LT(spread(95, 0), 0.01);  // far from what pops
  expectRefused({"pop", "old.png", "new.png", "--overlay", "new.png"}, {"never overwritten"});
}

TEST_F(PopCli, FormatsAndSwappingLeaveTheDifferenceAlone) {
  savePair("old.png", "new.png");
  for (const char* name : {"old", "new"})
    save(std::string(name) + ".exr", mapped(readImageFile(path(std::string(name) + ".png")).image, light),
         {OIIO::TypeDesc::FLOAT, {}, {}});
  const nlohmann::json coded = result({"pop", "old.png", "new.png"});
  for (const auto& words : {std::vector<std::string>{"pop", "old.exr", "new.exr"},
                            std::vector<std::string>{"pop", "old.png", "new.exr"},
                            std::vector<std::string>{"pop", "new.png", "old.png"}}) {
    const nlohmann::json other = result(words);
    for (const char* name : {"rating", "region_count", "largest_jnd", "mean_jnd", "coverage"})
      EXPECT_NEAR(figure(other, name), figure(coded, name), 1e-4 * (1.0 + figure(coded, name)))
          << words[1] << name;
  }
}

TEST_F(PopCli, LimitsAreAboutTheRatingUnlessNamed) {
  savePair("old.png", "new.png");
  const std::vector<std::string> words = {"pop", "old.png", "new.png", "--fail-above"};
  const auto with = [&](const char* limit) {
    std::vector<std::string> all = words;
    all.emplace_back(limit);
    return call(all);
  };
  const experiments::CallResult over = with("1");
  EXPECT_EQ(over.exitCode, 1);
  EXPECT_THAT(over.err, AllOf(HasSubstr("rating is"), HasSubstr("above 1")));
  EXPECT_EQ(with("20").exitCode, 0);
  EXPECT_EQ(with("detection_probability=0.5").exitCode, 1);
  EXPECT_EQ(with("region_count=100").exitCode, 0);
  expectRefused({"pop", "old.png", "new.png", "--fail-above", "ratng=1"}, {"rating"});
}

TEST_F(PopCli, WeightsScaleTheDifference) {
  savePair("old.png", "new.png");
  save("half.exr", flat(96, 80, {0.5F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  save("none.png", flat(96, 80, {0.0F}));
  save("small.exr", flat(9, 8, {0.5F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  const double whole = figure(result({"pop", "old.png", "new.png"}), "largest_jnd");
  const std::vector<std::string> pop = {"pop", "old.png", "new.png", "--weight", "half.exr"};
  EXPECT_NEAR(figure(result(pop), "largest_jnd"), whole / 2, 1e-6 * whole);
  std::vector<std::string> twice = pop;
  twice.insert(twice.end(), {"--weight", "half.exr"});
  EXPECT_NEAR(figure(result(twice), "largest_jnd"), whole / 4, 1e-6 * whole);
  EXPECT_EQ(figure(result({"pop", "old.png", "new.png", "--weight", "none.png"}), "largest_jnd"), 0.0);
  expectRefused({"pop", "old.png", "new.png", "--weight", "small.exr"}, {"--weight", "9 x 8"});
}

TEST_F(PopCli, MotionBecomesRetinalVelocity) {
  savePair("old.png", "new.png");
  save("flow.exr", flat(96, 80, {8.0F, 0.0F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  save("grey.exr", flat(96, 80, {8.0F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  const nlohmann::json found =
      result({"pop", "old.png", "new.png", "--motion", "flow.exr", "--stages", "moving"});
  // 8 px a frame at 60 Hz; the display has 2 * 0.6 tan(0.5 deg) / 0.254 mm = 41.2293 px/deg: 11.6422 deg/s on
  // the screen, of which the default eye leaves 0.18 v - 0.15 = 1.94559.
  const Image velocity = readImageFile(path("moving/velocity_actual_0.exr")).image;
  EXPECT_NEAR(velocity.at(48, 40), 1.94559, 1e-4);
  EXPECT_NEAR(readImageFile(path("moving/velocity_predicted_0.exr")).image.at(48, 40), 1.94559, 1e-4);
  EXPECT_EQ(found.at("maps").at("motion"), "flow.exr");
  // What pops is fine detail, which motion blurs.
  EXPECT_LT(figure(found, "largest_jnd"), figure(result({"pop", "old.png", "new.png"}), "largest_jnd"));
  expectRefused({"pop", "old.png", "new.png", "--motion", "grey.exr"}, {"--motion", "it takes 2"});
  expectRefused({"pop", "old.png", "new.png", "--motion", "none.exr"}, {"none.exr"});
}

TEST_F(PopCli, ResultsStateModelDisplayAndVersion) {
  savePair("old.png", "new.png");
  const nlohmann::json found = result({"pop", "old.png", "new.png", "--display", "desktop_24", "--set",
                                       "model=schwarz_2009", "--set", "minkowski_exponent=3"});
  EXPECT_THAT(found.at("statement").get<std::string>(),
              AllOf(HasSubstr("Limen 0."),
                    HasSubstr("popping predictor (model schwarz_2009; daly98+kelly83, T (9.9)"),
                    Not(HasSubstr("peak")), HasSubstr("minkowski_exponent 3"),
                    HasSubstr("display desktop_24"), HasSubstr("px/deg"), Not(HasSubstr("\n"))));
  EXPECT_EQ(found.at("settings").at("minkowski_exponent"), 3.0);
  EXPECT_GE(found.at("model").at("peak_cpd").size(), 1U);
  EXPECT_THAT(call({"pop", "--help"}).out, HasSubstr("minkowski_exponent=2.4"));
}

TEST_F(PopCli, AlternativesAreSetByPath) {
  savePair("old.png", "new.png");
  const auto with = [](const std::vector<std::string>& settings) {
    std::vector<std::string> words = {"pop", "old.png", "new.png"};
    for (const std::string& setting : settings) {
      words.emplace_back("--set");
      words.push_back(setting);
    }
    return words;
  };
  const nlohmann::json found = result(with({"adaptation.kind=fixed", "adaptation.luminance_cd_m2=50"}));
  EXPECT_EQ(found.at("settings").at("adaptation"), "fixed");
  EXPECT_EQ(found.at("settings").at("adaptation.luminance_cd_m2"), 50.0);
  EXPECT_EQ(result(with({"adaptation=fixed", "adaptation.luminance_cd_m2=50"})).at("figures"),
            found.at("figures"));
  expectRefused(with({"adaptation.luminance_cd_m2=50"}), {"adaptation: fixed"});
  expectRefused(with({"fixed_luminance_cd_m2=50"}), {"adaptation.luminance_cd_m2"});
  expectRefused(with({"adaptation=fixd"}), {"'fixed'"});
  EXPECT_THAT(call({"pop", "--help"}).out, HasSubstr("adaptation.luminance_cd_m2=100"));
}

TEST_F(PopCli, ASequenceAloneIsEachFrameAgainstTheNext) {
  savePair("s_1.png", "s_2.png");
  std::filesystem::copy_file(path("s_2.png"), path("s_3.png"));
  for (int n = 1; n <= 3; ++n)
    save("flow_" + std::to_string(n) + ".exr", flat(96, 80, {1.0F, 0.0F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  const experiments::CallResult answer = call({"pop", "s_%d.png", "--motion", "flow_%d.exr", "--json"});
  ASSERT_EQ(answer.exitCode, 0) << answer.err;
  const std::vector<nlohmann::json> lines = jsonLines(answer.out);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].at("inputs").at("old").at("path"), "s_1.png");
  EXPECT_EQ(lines[0].at("inputs").at("new").at("path"), "s_2.png");
  EXPECT_EQ(lines[0].at("maps").at("motion"), "flow_2.exr");
  EXPECT_GT(figure(lines[0], "region_count"), 0.0);
  EXPECT_EQ(figure(lines[1], "region_count"), 0.0);
  const nlohmann::json& summary = lines[2];
  EXPECT_EQ(summary.at("worst_frame"), "frame 2");
  EXPECT_EQ(summary.at("figures").at("rating").at("frames"), 1);
  EXPECT_EQ(summary.at("figures").at("rating").at("max"), lines[0].at("figures").at("rating"));
  EXPECT_NEAR(summary.at("figures").at("mean_jnd").at("mean").get<double>(), figure(lines[0], "mean_jnd") / 2,
              1e-12);
  expectRefused({"pop", "s_1.png"}, {"OLD NEW"});
  std::filesystem::remove(path("s_2.png"));
  expectRefused({"pop", "s_%d.png"}, {"lacks frame 2"});
}

TEST_F(PopCli, OddImagesAreFinite) {
  save("one.png", flat(1, 1, {0.5F, 0.5F, 0.5F}));
  save("two.png", flat(1, 1, {0.9F, 0.1F, 0.5F}));
  save("row.png", noise(40, 1, 3, 1));
  save("other.png", noise(40, 1, 3, 2));
  Image wild = flat(24, 16, {0.3F, 0.3F, 0.3F});
  wild.at(3, 3, 0) = std::nanf("");
  wild.at(9, 9, 1) = HUGE_VALF;
  save("wild.exr", wild, {OIIO::TypeDesc::FLOAT, {}, {}});
  save("tame.exr", flat(24, 16, {0.0F, 0.0F, 0.0F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  for (const auto& [a, b] : {std::pair{"one.png", "two.png"}, std::pair{"row.png", "other.png"},
                             std::pair{"wild.exr", "tame.exr"}})
    expectFinite(result({"pop", a, b}));
}

}  // namespace
}  // namespace limen::perception
