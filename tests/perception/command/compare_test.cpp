// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive compare: figures, maps, limits, and what a result says about itself.
#include <sys/stat.h>

#include "tests/perception/command/perceive_fixture.h"

namespace limen::perception {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using CompareCli = PerceiveCli;

TEST_F(CompareCli, IdenticalImagesHaveNoError) {
  save("a.png", noise(48, 40, 3, 1));
  const nlohmann::json found = result({"compare", "a.png", "a.png", "--all", "--regions"});
  for (const char* name : {"rmse", "mae", "signed_error", "largest_error", "p99_error", "de94", "de94_p99",
                           "de94_max", "non_finite", "rmse_coded", "mae_coded", "largest_error_coded"})
    EXPECT_EQ(figure(found, name), 0.0) << name;
  EXPECT_EQ(figure(found, "ssim"), 1.0);
  EXPECT_EQ(figure(found, "psnr"), 200.0);  // what the metric declares for equal images
  EXPECT_EQ(figure(found, "largest_jnd"), 0.0);
  EXPECT_EQ(figure(found, "region_count"), 0.0);
  EXPECT_THAT(found.at("regions"), IsEmpty());
  EXPECT_GE(found.at("metric_versions").at("ssim").get<int>(), 1);
  EXPECT_GE(found.at("jnd_model").at("contrast_levels").get<int>(), 1);
  EXPECT_THAT(found.at("warnings"), IsEmpty());
}

// Two pictures have no time around them, so a switch is predicted of single frames.
TEST_F(CompareCli, JndIsThePoppingPredictorWithNothingMoving) {
  Image image = noise(48, 40, 3, 1);
  save("b.png", image);
  for (int y = 10; y < 22; ++y)
    for (int x = 10; x < 22; ++x) image.at(x, y, 1) = (x / 3 + y / 3) % 2 ? 0.9F : 0.1F;
  save("a.png", image);
  const nlohmann::json compared = result(
                           {"compare", "a.png", "b.png", "--metrics", "jnd", "--map", "maps", "--regions"}),
                       popped = result({"pop", "b.png", "a.png", "--display", "desktop_24", "--set",
                                        "temporal=single_frame"});
  EXPECT_GT(figure(compared, "largest_jnd"), 2.0);
  for (const auto& [name, value] : compared.at("figures").items())
    EXPECT_EQ(value, popped.at("figures").at(name)) << name;
  EXPECT_EQ(compared.at("regions"), popped.at("regions"));
  const std::vector<float> map = readImageFile(path("maps/jnd.exr")).image.data;
  EXPECT_FLOAT_EQ(*std::max_element(map.begin(), map.end()),
                  static_cast<float>(figure(compared, "largest_jnd")));
  EXPECT_EQ(call({"compare", "a.png", "b.png", "--fail-above", "largest_jnd=1"}).exitCode, 1);
  const nlohmann::json other =
      result({"compare", "a.png", "b.png", "--metrics", "jnd", "--set", "jnd.minkowski_exponent=4"});
  EXPECT_EQ(other.at("settings").at("jnd").at("minkowski_exponent"), 4.0);
  EXPECT_NE(figure(other, "largest_jnd"), figure(compared, "largest_jnd"));
}

TEST_F(CompareCli, FiguresOfFlatImagesAreThoseOfArithmetic) {
  // One grey level apart everywhere: 100 and 110 of 255.
  save("a.png", flat(24, 24, {110 / 255.0F, 110 / 255.0F, 110 / 255.0F}));
  save("b.png", flat(24, 24, {100 / 255.0F, 100 / 255.0F, 100 / 255.0F}));
  const nlohmann::json found = result({"compare", "a.png", "b.png", "--all"});
  const double coded = 10.0 / 255, lit = light(110.0 / 255) - light(100.0 / 255);
  EXPECT_NEAR(figure(found, "rmse_coded"), coded, 1e-6);
  EXPECT_NEAR(figure(found, "psnr_coded"), -20.0 * std::log10(coded), 1e-4);
  EXPECT_NEAR(figure(found, "rmse"), lit, 1e-6);
  EXPECT_NEAR(figure(found, "signed_error"), lit, 1e-6);
  // Greys differ in lightness alone: dE94 = dL*, with L* = 116 Y^(1/3) - 16.
  const auto lightness = [](double y) { return 116.0 * std::cbrt(y) - 16.0; };
  EXPECT_NEAR(figure(found, "de94_max"), lightness(light(110.0 / 255)) - lightness(light(100.0 / 255)), 1e-4);
  // Without structure SSIM is its luminance term (Wang et al. 2004, equation 6).
  const double a = 110.0 / 255, b = 100.0 / 255, c1 = 1e-4;
  EXPECT_NEAR(figure(found, "ssim"), (2 * a * b + c1) / (a * a + b * b + c1), 1e-4);
}

TEST_F(CompareCli, ResultSaysWhoHowAndOnWhat) {
  save("a.png", noise(16, 16, 3, 1));
  save("b.png", noise(16, 16, 3, 2));
  const nlohmann::json found =
      result({"compare", "a.png", "b.png", "--metrics", "rmse,de94", "--set", "de94.statistic=max"});
  EXPECT_THAT(found.at("statement").get<std::string>(),
              AllOf(HasSubstr("Limen 0."), HasSubstr("commit"), HasSubstr("de94.statistic max"),
                    HasSubstr("display desktop_24"), HasSubstr("1920"), Not(HasSubstr("\n"))));
  EXPECT_EQ(found.at("settings").at("de94").at("statistic"), "max");
  EXPECT_EQ(found.at("settings").at("input").at("alpha"), "over_black");
  EXPECT_EQ(found.at("call").at(1), "compare");
  EXPECT_EQ(found.at("inputs").at("image").at("sha256").get<std::string>().size(), 64U);
  // 24 in 16:9 at 1920 pixels and 0.6 m: 2 * 0.6 tan(0.5 deg) / 0.27673 mm.
  EXPECT_NEAR(found.at("display").at("pixels_per_degree").get<double>(), 37.843, 5e-3);
  const experiments::CallResult text = call({"compare", "a.png", "b.png", "--metrics", "rmse"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("\nLimen "), HasSubstr("display desktop_24"), HasSubstr("8-bit png"),
                              HasSubstr("rmse")));
}

/// First line, then the names in the table of figures.
std::pair<std::string, std::vector<std::string>> sentenceAndFigures(const std::string& text) {
  std::istringstream lines(text);
  std::string sentence, line;
  std::getline(lines, sentence);
  std::vector<std::string> names;
  while (std::getline(lines, line))
    if (line.rfind("  ", 0) == 0) names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return {sentence, names};
}

TEST_F(CompareCli, ASentenceComesFirstThenTheUsualFigures) {
  Image image = noise(64, 48, 3, 1);
  save("b.png", image);
  for (int y = 10; y < 30; ++y)
    for (int x = 10; x < 30; ++x) image.at(x, y, 1) = (x / 3 + y / 3) % 2 ? 0.95F : 0.05F;
  save("a.png", image);
  const auto [plain, names] = sentenceAndFigures(call({"compare", "a.png", "b.png"}).out);
  EXPECT_THAT(plain, AllOf(HasSubstr("A viewer can see the difference"), HasSubstr("desktop_24")));
  EXPECT_THAT(names, testing::AnyOf(
                         testing::ElementsAre("rmse", "psnr", "ssim", "flip", "largest_jnd", "visible_share"),
                         testing::Contains("not")));  // flip not available
  const auto [all, allNames] = sentenceAndFigures(call({"compare", "a.png", "b.png", "--all"}).out);
  EXPECT_EQ(all, plain);
  EXPECT_GT(allNames.size(), 15U);
  EXPECT_THAT(call({"compare", "a.png", "b.png", "--all"}).out, Not(HasSubstr("Sigma JND")));
  EXPECT_THAT(call({"compare", "a.png", "b.png", "--regions"}).out, HasSubstr("Sigma JND"));
  EXPECT_EQ(sentenceAndFigures(call({"compare", "a.png", "a.png"}).out).first, "The images are identical.");
  EXPECT_EQ(result({"compare", "a.png", "b.png"}).at("sentence"), plain);
  EXPECT_FALSE(result({"compare", "a.png", "b.png"}).contains("regions"));

  // One code in one pixel is below any threshold.
  image = noise(64, 48, 3, 1);
  image.at(20, 20, 1) += 1.0F / 255.0F;
  save("c.png", image);
  EXPECT_THAT(sentenceAndFigures(call({"compare", "c.png", "b.png"}).out).first,
              HasSubstr("not expected to see the difference"));
}

// The predictor sees contrasts alone; the sentence must not call that invisible.
TEST_F(CompareCli, AnEvenChangeOfBrightnessIsNotCalledInvisible) {
  save("a.png", flat(48, 48, {0.8F, 0.8F, 0.8F}));
  save("b.png", flat(48, 48, {0.2F, 0.2F, 0.2F}));
  const nlohmann::json found = result({"compare", "a.png", "b.png"});
  EXPECT_EQ(figure(found, "visible_share"), 0.0);
  if (found.at("figures").at("flip").is_null()) GTEST_SKIP() << "no FLIP without OpenGL";
  EXPECT_THAT(found.at("sentence").get<std::string>(),
              AllOf(HasSubstr("differ plainly"), Not(HasSubstr("not expected"))));
}

TEST_F(CompareCli, LimitsOnOtherFiguresComputeThem) {
  save("a.png", flat(8, 8, {110 / 255.0F}));
  save("b.png", flat(8, 8, {100 / 255.0F}));
  EXPECT_EQ(call({"compare", "a.png", "b.png", "--fail-above", "largest_error_coded=0.0392"}).exitCode, 1);
  EXPECT_EQ(call({"compare", "a.png", "b.png", "--fail-above", "largest_error_coded=0.0393"}).exitCode, 0);
}

TEST_F(CompareCli, LimitsDecideTheExitCode) {
  save("a.png", flat(8, 8, {110 / 255.0F}));
  save("b.png", flat(8, 8, {100 / 255.0F}));
  const std::vector<std::string> compare = {"compare", "a.png", "b.png", "--metrics",
                                            "largest_error,psnr,ssim"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), compare.begin(), compare.end());
    return more;
  };
  // 10 / 255 = 0.0392, 28.13 dB.
  EXPECT_EQ(call(with({"--fail-above", "largest_error_coded=0.0393"})).exitCode, 0);
  const experiments::CallResult over = call(with({"--fail-above", "largest_error_coded=0.0392"}));
  EXPECT_EQ(over.exitCode, 1);
  EXPECT_THAT(over.err, AllOf(HasSubstr("largest_error_coded is 0.0392157"), HasSubstr("above 0.0392")));
  EXPECT_EQ(call(with({"--fail-below", "psnr_coded=28.1"})).exitCode, 0);
  EXPECT_EQ(call(with({"--fail-below", "psnr_coded=28.2"})).exitCode, 1);
  EXPECT_EQ(call(with({"--fail-below", "psnr_coded=28.1", "--fail-above", "largest_error=0.001"})).exitCode,
            1);
  expectRefused(with({"--fail-above", "psnr=30"}), {"--fail-below psnr=30"});
  expectRefused(with({"--fail-above", "largest=1"}), {"largest_error"});
  expectRefused(with({"--fail-above", "largest_error=x"}), {"'x' is not a number"});
  expectRefused(with({"--fail-above", "0.5"}), {"FIGURE=VALUE", "0.5"});
}

TEST_F(CompareCli, ALimitOnWhatCannotBeToldIsNoPass) {
  save("a.exr", flat(8, 8, {0.5F}), {OIIO::TypeDesc::FLOAT, {}, {}});
  expectRefused({"compare", "a.exr", "a.exr", "--metrics", "rmse", "--fail-above", "rmse_coded=1"},
                {"cannot be evaluated", "coded values"});
}

TEST_F(CompareCli, FlipIsAFigureOrHasAReason) {
  save("a.png", noise(24, 24, 3, 1));
  save("b.png", noise(24, 24, 3, 2));
  const nlohmann::json found =
      result({"compare", "a.png", "b.png", "--metrics", "flip,rmse", "--display", "schwarz_2009"});
  // 20 in 4:3 at 1600 pixels and 0.6 m: 2 * 0.6 tan(0.5 deg) / 0.254 mm.
  EXPECT_NEAR(found.at("settings").at("flip").at("pixels_per_degree").get<double>(), 41.229, 1e-3);
  if (found.at("figures").at("flip").is_null()) {
    EXPECT_FALSE(found.at("unavailable").at("flip").get<std::string>().empty());
  } else {
    EXPECT_GT(figure(found, "flip"), 0.0);
  }
  // No device of this number exists anywhere: no context, and the rest goes on.
  setenv("LIMEN_EGL_DEVICE", "9999", 1);
  const nlohmann::json without = result({"compare", "a.png", "b.png", "--metrics", "flip,rmse"});
  expectRefused({"compare", "a.png", "b.png", "--fail-above", "flip=0.5"}, {"flip", "OpenGL"});
  unsetenv("LIMEN_EGL_DEVICE");
  EXPECT_TRUE(without.at("figures").at("flip").is_null());
  EXPECT_THAT(without.at("unavailable").at("flip").get<std::string>(), HasSubstr("no OpenGL context"));
  EXPECT_EQ(figure(without, "rmse"), figure(found, "rmse"));
}

TEST_F(CompareCli, MapsHoldTheFiguresPixelByPixel) {
  Image image = flat(10, 6, {100 / 255.0F, 100 / 255.0F, 100 / 255.0F});
  save("b.png", image);
  image.at(7, 2, 1) = 120 / 255.0F;
  save("a.png", image);
  const nlohmann::json found =
      result({"compare", "a.png", "b.png", "--map", "maps", "--metrics", "rmse,de94"});
  const ImageFile map = readImageFile(path("maps/absolute_error.exr"));
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 10; ++x)
      EXPECT_NEAR(map.image.at(x, y), x == 7 && y == 2 ? light(120.0 / 255) - light(100.0 / 255) : 0.0, 1e-6);
  EXPECT_TRUE(exists("maps/de94.exr"));
  EXPECT_TRUE(exists("maps/de94.png"));
  EXPECT_EQ(found.at("outputs").at("de94"), "maps/de94.exr");
}

TEST_F(CompareCli, InputsAreNeverOverwritten) {
  std::filesystem::create_directory(path("maps"));
  save("maps/rmse.exr", noise(8, 8, 3, 1), {OIIO::TypeDesc::FLOAT, {}, {}});
  expectRefused({"compare", "maps/rmse.exr", "maps/rmse.exr", "--map", "maps"}, {"never overwritten"});
  expectRefused({"compare", "maps/rmse.exr", "maps/rmse.exr", "--map", "maps/rmse.exr"}, {"not a folder"});
}

TEST_F(CompareCli, SettingsAreListedAndChecked) {
  save("a.png", noise(8, 8, 3, 1));
  expectRefused({"compare", "a.png", "a.png", "--set", "de94.statistc=max"}, {"de94.statistic"});
  expectRefused({"compare", "a.png", "a.png", "--set", "de94.statistic=most"}, {"mean, max, p99"});
  expectRefused({"compare", "a.png", "a.png", "--set", "flip.pixels_per_degree=far"},
                {"far", "number from 1"});
  expectRefused({"compare", "a.png", "a.png", "--set", "de94.statistic"}, {"name=value"});
  expectRefused({"compare", "a.png", "a.png", "--set", "de94.statistic=max", "--set", "de94.statistic=p99"},
                {"twice"});
  expectRefused({"compare", "a.png", "a.png", "--metrics", "rsme"}, {"rmse"});
  expectRefused({"compare", "a.png", "a.png", "--metrics", "rmse,rmse"}, {"twice"});
  const experiments::CallResult help = call({"compare", "--help"});
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_THAT(help.out,
              AllOf(HasSubstr("de94.statistic=mean"), HasSubstr("--fail-above"), HasSubstr("schwarz_2009")));
  EXPECT_THAT(call({"compare", "--list"}).out, HasSubstr("flip.pixels_per_degree"));
  const experiments::CallResult list = call({"compare", "--list", "--json"});
  EXPECT_FALSE(nlohmann::json::parse(list.out).empty());
}

TEST_F(CompareCli, TheProgramItselfAnswersAlike) {
  save("a.png", noise(40, 30, 3, 1));
  save("b.png", noise(40, 30, 3, 2));
  const std::vector<std::string> words = {"compare", "a.png", "b.png", "--json"};
  const experiments::CallResult answer = call(words);
  EXPECT_EQ(answer.exitCode, 0) << answer.err;
  EXPECT_EQ(answer.out, call(words).out);
  EXPECT_EQ(call({"compare", "a.png", "none.png"}).exitCode, 2);
  EXPECT_EQ(call({"compare", "a.png", "b.png", "--fail-above", "rmse=0"}).exitCode, 1);
  EXPECT_THAT(call({"--version"}).out, AllOf(HasSubstr("limen-perceive 0."), HasSubstr("commit")));
}

TEST_F(CompareCli, SameCallGivesTheSameBytes) {
  save("a.png", noise(40, 30, 3, 1));
  save("b.png", noise(40, 30, 3, 2));
  const std::vector<std::string> words = {"compare", "a.png", "b.png", "--json", "--all", "--map", "maps"};
  const std::string first = call(words).out, map = read("maps/de94.exr");
  EXPECT_EQ(call(words).out, first);
  EXPECT_EQ(read("maps/de94.exr"), map);
}

}  // namespace
}  // namespace limen::perception
