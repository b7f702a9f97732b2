// SPDX-License-Identifier: BSD-3-Clause
// Sequences: what patterns stand for, and sums over frames.
#include "tests/perception/command/perceive_fixture.h"

namespace limen::perception {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SequenceCli : public PerceiveCli {
 protected:
  /// Frame n is flat and n grey levels above 100 of 255.
  void saveFrame(const std::string& name, int n) const {
    save(name, flat(8, 8, {static_cast<float>(100 + n) / 255.0F}));
  }
  std::vector<nlohmann::json> lines(std::vector<std::string> words) const {
    words.emplace_back("--json");
    words.emplace_back("--metrics");
    words.emplace_back("rmse,psnr");
    const experiments::CallResult answer = call(words);
    EXPECT_EQ(answer.exitCode, 0) << answer.err;
    return jsonLines(answer.out);
  }
};

TEST_F(SequenceCli, SummaryIsThatOfTheFrames) {
  for (int n = 1; n <= 12; ++n) {
    saveFrame("a_" + std::to_string(n) + ".png", (n * 5) % 13);
    saveFrame("b_" + std::to_string(n) + ".png", 0);
  }
  const std::vector<nlohmann::json> found = lines({"compare", "a_%d.png", "b_%d.png"});
  ASSERT_EQ(found.size(), 13U);
  double sum = 0.0;
  std::vector<double> values;
  for (int n = 1; n <= 12; ++n) {
    const nlohmann::json& frame = found[static_cast<size_t>(n - 1)];
    EXPECT_EQ(frame.at("event"), "frame");
    EXPECT_EQ(frame.at("number"), n);  // by number: 2 before 10
    EXPECT_NEAR(figure(frame, "rmse_coded"), (n * 5) % 13 / 255.0, 1e-7);
    if (n % 4 == 1) {
      const std::string number = std::to_string(n);
      const nlohmann::json alone =
          result({"compare", "a_" + number + ".png", "b_" + number + ".png", "--metrics", "rmse,psnr"});
      EXPECT_EQ(frame.at("figures"), alone.at("figures"));
    }
    values.push_back(figure(frame, "rmse_coded"));
    sum += values.back();
  }
  const nlohmann::json& summary = found.back();
  EXPECT_EQ(summary.at("event"), "summary");
  EXPECT_EQ(summary.at("frames"), 12);
  const nlohmann::json& rmse = summary.at("figures").at("rmse_coded");
  EXPECT_NEAR(rmse.at("mean").get<double>(), sum / 12, 1e-12);
  EXPECT_EQ(rmse.at("max").get<double>(), *std::max_element(values.begin(), values.end()));
  EXPECT_EQ(rmse.at("min").get<double>(), *std::min_element(values.begin(), values.end()));
  // 5 n mod 13 is 12 for n = 5 (25 = 13 + 12) and 1 for n = 8 (40 = 39 + 1).
  EXPECT_EQ(rmse.at("max_frame"), "frame 5");
  EXPECT_EQ(rmse.at("min_frame"), "frame 8");
  EXPECT_EQ(summary.at("worst_frame"), "frame 5");
  std::sort(values.begin(), values.end());
  EXPECT_EQ(rmse.at("median").get<double>(), values[5]);  // nearest rank
  EXPECT_THAT(summary.at("statement").get<std::string>(), HasSubstr("desktop_24"));
}

TEST_F(SequenceCli, PatternsStandForTheSameFrames) {
  for (int n = 8; n <= 11; ++n) {
    const std::string number = std::string(n < 10 ? "000" : "00") + std::to_string(n);
    saveFrame("f_" + number + ".png", n);
    saveFrame("g_" + number + ".png", 0);
  }
  write("f_12.png", "not padded: no frame of f_%04d");
  saveFrame("ref.png", 0);
  const std::vector<nlohmann::json> printf = lines({"compare", "f_%04d.png", "g_%04d.png"});
  ASSERT_EQ(printf.size(), 5U);
  for (const auto& words : {std::vector<std::string>{"compare", "f_####.png", "g_####.png"},
                            std::vector<std::string>{"compare", "f_0*.png", "g_*.png"},
                            std::vector<std::string>{"compare", "f_%04d.png", "ref.png"}}) {
    const std::vector<nlohmann::json> other = lines(words);
    ASSERT_EQ(other.size(), 5U) << words[1];
    for (size_t i = 0; i < 4; ++i) EXPECT_EQ(other[i].at("figures"), printf[i].at("figures")) << words[1];
  }
}

TEST_F(SequenceCli, GlobsReadDigitsAsNumbers) {
  for (const int n : {2, 10, 1, 20}) saveFrame("x" + std::to_string(n) + ".png", n);
  saveFrame("ref.png", 0);
  std::vector<std::string> order;
  for (const nlohmann::json& line : lines({"compare", "x*.png", "ref.png"}))
    if (line.at("event") == "frame") order.push_back(line.at("frame"));
  EXPECT_THAT(order, ElementsAre("x1.png", "x2.png", "x10.png", "x20.png"));
}

TEST_F(SequenceCli, AFileThatIsReallyCalledSoComesFirst) {
  saveFrame("odd#1.png", 3);
  saveFrame("odd[1]%d.png", 3);
  EXPECT_EQ(figure(result({"compare", "odd#1.png", "odd[1]%d.png", "--metrics", "rmse"}), "rmse"), 0.0);
}

TEST_F(SequenceCli, MapsOfFramesKeepApart) {
  for (int n = 1; n <= 2; ++n) saveFrame("a_" + std::to_string(n) + ".png", n);
  saveFrame("ref.png", 0);
  lines({"compare", "a_#.png", "ref.png", "--map", "maps"});
  EXPECT_TRUE(exists("maps/frame_0001/absolute_error.exr"));
  EXPECT_TRUE(exists("maps/frame_0002/absolute_error.exr"));
}

TEST_F(SequenceCli, ALimitNamesItsFrame) {
  for (int n = 1; n <= 3; ++n) saveFrame("a_" + std::to_string(n) + ".png", n == 2 ? 50 : 0);
  saveFrame("ref.png", 0);
  const experiments::CallResult answer =
      call({"compare", "a_#.png", "ref.png", "--metrics", "rmse", "--fail-above", "rmse_coded=0.1"});
  EXPECT_EQ(answer.exitCode, 1);
  EXPECT_THAT(answer.err, HasSubstr("frame 2: rmse_coded is 0.196078, above 0.1"));
  EXPECT_THAT(answer.err, testing::Not(HasSubstr("frame 3")));
  EXPECT_THAT(answer.out, HasSubstr("worst frame by rmse: frame 2"));
}

TEST_F(SequenceCli, RefusesSequencesThatDoNotBelongTogether) {
  for (int n = 1; n <= 3; ++n) saveFrame("a_" + std::to_string(n) + ".png", n);
  for (int n = 2; n <= 3; ++n) saveFrame("b_" + std::to_string(n) + ".png", n);
  expectRefused({"compare", "a_%d.png", "b_%d.png"}, {"lacks the frames 1"});
  expectRefused({"compare", "b_%d.png", "a_%d.png"}, {"lacks the frames 1"});
  expectRefused({"compare", "a_*.png", "b_*.png"}, {"3 frames", "2"});
  expectRefused({"compare", "c_%d.png", "a_%d.png"}, {"no file matches 'c_%d.png'"});
  expectRefused({"compare", "c_*.png", "a_%d.png"}, {"no file matches"});
  expectRefused({"compare", "a_%d_%d.png", "a_%d.png"}, {"two numbers"});
}

}  // namespace
}  // namespace limen::perception
