// SPDX-License-Identifier: BSD-3-Clause
// The example runs of QUEST+ (Watson 2017, Journal of Vision 17(3):10): stimuli trial by trial, given the
// answers, and the most probable parameters at the end. The numbers are those that the author's program
// gives; public implementations of QUEST+ keep them as their tests too.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "study/procedures/procedure.h"

namespace limen::study {
namespace {

using nlohmann::json;
using Stimuli = std::vector<std::vector<double>>;

Stimuli oneDimensional(const std::vector<double>& values) {
  Stimuli out;
  for (double value : values) out.push_back({value});
  return out;
}

// Runs the answers ('1' and '0') and compares stimuli; returns the modes by name.
std::map<std::string, double> expectRun(const json& settings, const std::string& answers,
                                        const Stimuli& stimuli) {
  const auto procedure = makeProcedure(readProcedure(settings, "run"), 1);
  EXPECT_EQ(answers.size(), stimuli.size());
  for (size_t i = 0; i < answers.size(); ++i) {
    const auto next = procedure->next();
    EXPECT_EQ(next, stimuli[i]) << "trial " << i + 1;
    procedure->update(stimuli[i], answers[i] - '0');
  }
  EXPECT_FALSE(procedure->next());
  std::map<std::string, double> modes;
  for (const ParameterEstimate& p : procedure->estimate().parameters) modes[p.name] = p.mode;
  return modes;
}

json decibels(int from, int to, int step) {
  return {{"name", "contrast"}, {"from", from}, {"to", to}, {"step", step}, {"unit", "dB"}};
}

const json kLapses = {{"from", 0}, {"to", 0.04}, {"step", 0.01}};

json weibull(const json& slope, const json& lapse, size_t trials) {
  json threshold = decibels(-40, 0, 1);
  threshold.erase("name");
  return {{"type", "quest_plus"},
          {"model", "weibull_db"},
          {"stimulus", decibels(-40, 0, 1)},
          {"parameters", {{"threshold", threshold}, {"slope", slope}, {"guess", 0.5}, {"lapse", lapse}}},
          {"stop", {{"trials", trials}}}};
}

TEST(PublishedRuns, Threshold) {
  const std::string answers = "11110011111111011011011111111111";
  const auto modes = expectRun(
      weibull(3.5, 0.02, answers.size()), answers,
      oneDimensional({-18, -22, -25, -28, -30, -22, -13, -15, -16, -18, -19, -20, -21, -22, -23, -19,
                      -20, -20, -18, -18, -19, -17, -17, -18, -18, -18, -19, -19, -19, -19, -19, -19}));
  EXPECT_EQ(modes.at("threshold"), -20);
}

TEST(PublishedRuns, ThresholdAndSlope) {
  const std::string answers = "1011111111111011011101111011111111111011001111010111011111111111";
  const auto modes = expectRun(
      weibull({2, 3, 4, 5}, 0.02, answers.size()), answers,
      oneDimensional({-18, -22, -12, -13, -15, -16, -17, -18, -19, -21, -24, -25, -26, -27, -21, -22,
                      -23, -20, -20, -20, -21, -19, -19, -20, -20, -20, -19, -19, -19, -19, -19, -20,
                      -20, -20, -20, -20, -21, -21, -20, -20, -20, -19, -18, -18, -19, -19, -19, -18,
                      -18, -17, -18, -18, -18, -17, -17, -17, -17, -17, -17, -17, -18, -18, -18, -18}));
  EXPECT_EQ(modes.at("threshold"), -20);
  EXPECT_EQ(modes.at("slope"), 3);
}

TEST(PublishedRuns, ThresholdSlopeAndLapse) {
  const std::string answers =
      "111100111111110101111111011111111011111111101110111111110111111011111111111110101111011011111110111111"
      "11111111101"
      "110100111101111";
  // In trials 95 and 96 the expected entropies from -3 to 0 dB differ by 2e-12 nats of 3.5, those of -1 and 0
  // dB by 7e-15: by default they count as equal and the first is shown. The published program takes the plain
  // minimum.
  json settings = weibull({2, 3, 4, 5}, kLapses, answers.size());
  settings["tie_tolerance"] = 0;
  const auto modes = expectRun(
      settings, answers,
      oneDimensional({-18, -22, -25, -28, -30, -21, -12, -14, -15, -16, -18, -19, -20, -22, -23, -18,
                      -19, -16, -17, -17, -18, -18, -18, -19, -19, -17, -17, -18, -18, -18, -18, -19,
                      -19, -20, -18, -18, -18, -18, -18, -19, -19, -19, -19, -20, -18, -18, -18, -18,
                      -18, -18, -18, -18, -18, -19, -19, -19, -20, -18, -18, -18, -18, -19, -19, -19,
                      -18, -18, -18, -18, -19, -19, -19, -19, -19, -19, -19, -19, -20, -21, -19, -19,
                      -19, -19, -19, -19, -19, -18, -19, -19, -16, -16, -16, -16, -16, -16, 0,   0,
                      -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -21, -21,
                      -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19}));
  EXPECT_EQ(modes.at("threshold"), -20);
  EXPECT_EQ(modes.at("slope"), 5);
  EXPECT_NEAR(modes.at("lapse"), 0.04, 1e-15);
}

TEST(PublishedRuns, MeanStandardDeviationAndLapse) {
  const std::string answers =
      "100111111101000011011000101001001010010111011100000100001000100100011100110100011000001001101101011011"
      "010000111101"
      "00010000111110";
  const json settings = {{"type", "quest_plus"},
                         {"model", "normal"},
                         {"asymptotes", "equal"},
                         {"stimulus", {{"name", "orientation"}, {"from", -10}, {"to", 10}, {"step", 1}}},
                         {"parameters",
                          {{"mean", {{"from", -5}, {"to", 5}, {"step", 1}}},
                           {"sd", {{"from", 1}, {"to", 10}, {"step", 1}}},
                           {"lapse", kLapses}}},
                         {"stop", {{"trials", answers.size()}}}};
  const auto modes = expectRun(
      settings, answers,
      oneDimensional({0,  -1, 2,  -2, 2,  3,  3,  -5, 3,  3,  3,  3,  -7, -7, -7, -7, 4,  -7, 4,  4,  4,  -8,
                      -8, -8, 4,  -8, 4,  -8, -7, 4,  -7, -7, 4,  -7, 4,  -7, -6, 3,  -4, -5, 3,  3,  -7, 2,
                      2,  1,  0,  -7, -6, -6, -6, 2,  -5, 2,  -6, -5, 3,  -5, -5, 3,  4,  -5, -5, 4,  -4, -4,
                      -4, -4, 4,  3,  3,  4,  5,  5,  -5, 5,  -5, -5, 4,  5,  5,  -5, -4, -4, -4, -4, 5,  -4,
                      -4, -3, 4,  4,  5,  5,  -4, 5,  -4, -4, 5,  4,  5,  5,  -5, 5,  -4, -4, -4, -4, 5,  -4,
                      5,  4,  -4, 4,  -4, -4, -4, 4,  -4, -4, -4, 4,  4,  -4, 4,  4,  4,  -4}));
  EXPECT_EQ(modes.at("mean"), 0);
  EXPECT_EQ(modes.at("sd"), 4);
  EXPECT_NEAR(modes.at("lapse"), 0.01, 1e-15);
}

void expectContrastSensitivityRun(const json& patch) {
  const std::string answers = "10111101111101111100111111100111";
  json settings = {{"type", "quest_plus"},
                   {"model", "csf"},
                   {"stimulus",
                    {decibels(-50, 0, 2),
                     {{"name", "spatial_frequency"}, {"from", 0}, {"to", 40}, {"step", 2}, {"unit", "cpd"}}}},
                   {"parameters",
                    {{"minimum_threshold", {{"from", -50}, {"to", -30}, {"step", 2}}},
                     {"c0", {{"from", -60}, {"to", -40}, {"step", 2}}},
                     {"cf", {{"from", 0.8}, {"to", 1.6}, {"step", 0.2}}},
                     {"slope", 3},
                     {"guess", 0.5},
                     {"lapse", 0.01}}},
                   {"stop", {{"trials", answers.size()}}}};
  settings.merge_patch(patch);
  Stimuli stimuli = {{0, 40},   {-4, 40},  {0, 34},  {0, 36},   {-38, 0}, {0, 38},   {-40, 0},  {0, 38},
                     {-26, 18}, {-26, 18}, {0, 40},  {-36, 0},  {-36, 0}, {0, 40},   {-26, 20}, {-26, 20},
                     {-2, 40},  {-26, 22}, {-6, 40}, {-26, 20}, {0, 40},  {-26, 18}, {0, 40},   {-26, 18},
                     {-32, 0},  {-32, 0},  {-34, 0}, {-34, 0},  {0, 40},  {-26, 18}, {0, 38},   {-26, 18}};
  if (settings["model"] == "csf_spatiotemporal") {
    settings["stimulus"].push_back({{"name", "temporal_frequency"}, {"values", 0}, {"unit", "Hz"}});
    for (std::vector<double>& stimulus : stimuli) stimulus.push_back(0);
  }
  const auto modes = expectRun(settings, answers, stimuli);
  EXPECT_EQ(modes.at("minimum_threshold"), -32);
  EXPECT_EQ(modes.at("c0"), -56);
  EXPECT_NEAR(modes.at("cf"), 1.4, 1e-12);
}

TEST(PublishedRuns, ContrastSensitivityOverSpatialFrequency) { expectContrastSensitivityRun(json::object()); }

// The example has a temporal frequency of 0 throughout, so that any one value of its slope gives the same.
TEST(PublishedRuns, ContrastSensitivityWithTemporalFrequency) {
  expectContrastSensitivityRun({{"model", "csf_spatiotemporal"}, {"parameters", {{"cw", 0.5}}}});
}

}  // namespace
}  // namespace limen::study
