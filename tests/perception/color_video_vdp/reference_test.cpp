// SPDX-License-Identifier: BSD-3-Clause
// ColorVideoVDP against what the authors' program gives in double precision (reference/README.md).
#include "perception/metrics/color_video_vdp/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "vectors.h"

namespace limen::perception::cvvdp {
namespace {

class CvvdpVectors : public testing::TestWithParam<std::string> {};

// 1e-9 JOD is what two programs in double precision can be expected to agree to; the table has 12 digits.
TEST_P(CvvdpVectors, ScoreIsTheAuthors) {
  const Vector& v = vectorOf(GetParam());
  // Printed to 17 digits; codes add up exactly, floating-point samples to a rounding in the last one.
  EXPECT_NEAR(v.sumOf(true), number(v.row, "sum_test"), 1e-12 * number(v.row, "sum_test"));
  EXPECT_NEAR(v.sumOf(false), number(v.row, "sum_ref"), 1e-12 * number(v.row, "sum_ref"));
  const Score score = evaluate(v.pair(), v.options).score;
  EXPECT_NEAR(score.jod, v.jod, 1e-9);
  EXPECT_NEAR(score.difference, v.difference, 1e-8 * v.difference);
  EXPECT_EQ(static_cast<double>(score.frequenciesCpd.size()), number(v.row, "bands"));
  if (v.jodFixed == v.jod) return;
  Options repaired = v.options;
  repaired.referenceBorders = false;
  EXPECT_NEAR(evaluate(v.pair(), repaired).score.jod, v.jodFixed, 1e-9);
}

// A17 and A22 are large: with the tests of the GPU's version.
INSTANTIATE_TEST_SUITE_P(All, CvvdpVectors, testing::ValuesIn(vectorIds({"A17", "A22"})),
                         [](const testing::TestParamInfo<std::string>& id) { return id.param; });

// Exchanging test and reference changes the score, as sensitivity is the reference's: published for two
// pairs.
TEST(CvvdpReference, TestAndReferenceAreNotInterchangeable) {
  for (const auto& [id, jod] : {std::pair{"A12", 9.181006}, {"A06", 7.318100}}) {
    const Vector& v = vectorOf(id);
    Pair exchanged = v.pair();
    std::swap(exchanged.test, exchanged.reference);
    EXPECT_NEAR(evaluate(exchanged, v.options).score.jod, jod, 1e-6) << id;
  }
}

TEST(CvvdpReference, PooledDifferencesOfEachChannelAndBand) {
  std::map<std::string, Score> scores;
  for (const Row& row : readRows("q_per_channel.csv")) {
    const std::string& id = row.at("id");
    if (id != "A10" && id != "A11" && id != "A15" && id != "A20" && id != "A23") continue;
    if (!scores.contains(id)) scores[id] = evaluate(vectorOf(id).pair(), vectorOf(id).options).score;
    const Score& score = scores[id];
    const auto frame = static_cast<size_t>(number(row, "frame")),
               band = static_cast<size_t>(number(row, "band"));
    const auto channel = static_cast<size_t>(
        std::find(kChannelNames.begin(), kChannelNames.end(), row.at("channel")) - kChannelNames.begin());
    const double q = number(row, "Q");
    // Ten digits are printed; below 1e-4 the offset of the powers cancels most of them.
    EXPECT_NEAR(score.frames[frame][band][channel], q, 1e-8 * q + 1e-10) << id << row.at("channel") << band;
    EXPECT_NEAR(score.frequenciesCpd[band], number(row, "rho_cpd"), 1e-7 * number(row, "rho_cpd"));
  }
  EXPECT_EQ(scores.size(), 5U);
}

// T, R, S and D of every masked band, and the map, at three pixels of three frames.
TEST(CvvdpReference, StagesAndMapAtSinglePixels) {
  std::ifstream in(LIMEN_SOURCE_DIR "/tests/perception/color_video_vdp/reference/intermediates.json");
  const nlohmann::json stages = nlohmann::json::parse(in);
  for (const auto& [id, published] : stages.items()) {
    const Vector& v = vectorOf(id);
    Options options = v.options;
    options.map = true;
    std::map<int, FrameStages> ours;
    const ReferenceResult result =
        evaluate(v.pair(), options, [&](const FrameStages& frame) { ours[frame.frame] = frame; });
    for (const nlohmann::json& frame : published.at("frames"))
      for (const nlohmann::json& band : frame.at("bands")) {
        const BandStages& here = ours.at(frame.at("frame").get<int>()).bands[band.at("band").get<size_t>()];
        for (const auto& [place, values] : band.at("pixels").items()) {
          const int x = std::stoi(place), y = std::stoi(place.substr(place.find(',') + 1));
          for (const auto& [stage, planes] : {std::pair{"T", &here.testContrast},
                                              {"R", &here.referenceContrast},
                                              {"S", &here.sensitivity},
                                              {"D", &here.difference}}) {
            const auto expected = values.at(stage).get<std::vector<double>>();
            for (size_t c = 0; c < expected.size(); ++c)
              EXPECT_NEAR((*planes)[c].at(x, y), expected[c], 1e-9 * std::abs(expected[c]) + 1e-10)
                  << id << " " << stage << " " << c;
          }
        }
      }
    for (const nlohmann::json& map : published.at("heatmap_raw_f64"))
      for (const auto& [place, value] : map.at("px").items()) {
        const int x = std::stoi(place), y = std::stoi(place.substr(place.find(',') + 1));
        EXPECT_NEAR(result.maps[map.at("frame").get<size_t>()].at(x, y), value.get<double>(), 1e-9) << id;
      }
  }
}

}  // namespace
}  // namespace limen::perception::cvvdp
