// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "study/procedures/procedure.h"
#include "tests/study/procedures/example_settings.h"

namespace limen::study {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(const json& settings) {
  try {
    readProcedure(settings, "protocol.yaml: procedure");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

// Settings of a type, the patch merged in (null takes a key away).
std::string refusal(const std::string& type, const char* patch) {
  for (json settings : exampleSettings()) {
    if (settings["type"] != type) continue;
    settings.merge_patch(json::parse(patch));
    return refusal(settings);
  }
  return "no such example";
}

TEST(ProcedureSettings, SlipsNameTheKeyAndTheMend) {
  EXPECT_THAT(refusal(json::object()), HasSubstr("'type' is missing"));
  EXPECT_THAT(refusal({{"type", "quest+"}}),
              AllOf(StartsWith("protocol.yaml: procedure.type: "), HasSubstr("did you mean 'quest'")));
  EXPECT_THAT(refusal(json::array()), HasSubstr("give keys with values"));
  EXPECT_THAT(refusal("constant", R"({"repetition": 3})"), HasSubstr("did you mean 'repetitions'"));
  EXPECT_THAT(refusal("constant", R"({"repetitions": 0})"), HasSubstr("procedure.repetitions: found 0"));
  EXPECT_THAT(refusal("constant", R"({"order": "random"})"), HasSubstr("known: shuffled, listed"));
  EXPECT_THAT(refusal("constant", R"({"stimulus": null})"), HasSubstr("'stimulus' is missing"));
  EXPECT_THAT(
      refusal("constant", R"({"stimulus": [{"name": "x", "values": [1]}, {"name": "x", "values": [1]}]})"),
      HasSubstr("two dimensions are named 'x'"));
  EXPECT_THAT(refusal("staircase", R"({"steps": [2, 0]})"), HasSubstr("procedure.steps: found 0"));
  EXPECT_THAT(refusal("staircase", R"({"stop": {"trails": 5}})"), HasSubstr("did you mean 'trials'"));
  EXPECT_THAT(refusal("staircase", R"({"stop": {"trials": null, "reversals": null}})"),
              HasSubstr("no stopping rule"));
  EXPECT_THAT(refusal("staircase", R"({"estimate_reversals": 7})"), HasSubstr("even number"));
  EXPECT_THAT(refusal("staircase", R"({"stimulus": {"start": 2}})"),
              HasSubstr("between minimum and maximum"));
  EXPECT_THAT(refusal("staircase", R"({"stimulus": {"minimum": 0}})"), HasSubstr("above 0"));
  EXPECT_THAT(refusal("quest", R"({"threshold_guess": null})"), HasSubstr("'threshold_guess' is missing"));
  EXPECT_THAT(refusal("quest", R"({"threshold_probability": 0.4})"), HasSubstr("above 0.5 and below 0.995"));
  EXPECT_THAT(refusal("quest", R"({"range": 0.01})"), HasSubstr("procedure.range"));
  EXPECT_THAT(refusal("quest", R"({"beta": "steep"})"), HasSubstr("above 0"));
  EXPECT_THAT(refusal("psi", R"({"parameters": {"threshhold": 1}})"), HasSubstr("did you mean 'threshold'"));
  EXPECT_THAT(refusal("psi", R"({"parameters": {"threshold": null}})"),
              HasSubstr("procedure.parameters: 'threshold' is missing"));
  EXPECT_THAT(refusal("psi", R"({"parameters": {"slope": [-1, 1]}})"),
              HasSubstr("-1 is not a value of 'slope'"));
  EXPECT_THAT(refusal("psi", R"({"parameters": {"guess": 0.97}})"), HasSubstr("sum to 1.02"));
  EXPECT_THAT(refusal("psi", R"({"nuisance": ["lapses"]})"), HasSubstr("did you mean 'lapse'"));
  EXPECT_THAT(refusal("psi", R"({"nuisance": ["threshold", "slope", "lapse"]})"), HasSubstr("leave one"));
  EXPECT_THAT(refusal("psi", R"({"model": "csf"})"),
              HasSubstr("the model has 2: contrast, spatial_frequency"));
  EXPECT_THAT(refusal("quest_plus", R"({"model": "weibul_db"})"), HasSubstr("did you mean 'weibull_db'"));
  EXPECT_THAT(refusal("quest_plus", R"({"parameters": {"threshold": {"prior": [1, 2]}}})"),
              HasSubstr("procedure.parameters.threshold.prior: the prior has 2 weights for 21 values"));
  EXPECT_THAT(
      refusal("quest_plus", R"({"parameters": {"threshold": {"step": 0.0001}, "lapse": {"from": 0, "to": 0.1,
                                        "step": 0.001}}})"),
      AllOf(StartsWith("protocol.yaml: procedure: "), HasSubstr("1024 MiB")));
  EXPECT_THAT(refusal("interleaved", R"({"procedures": [{"type": "constant"}]})"),
              HasSubstr("procedure.procedures[0]: 'stimulus' is missing"));
  EXPECT_THAT(refusal("quest_plus", R"({"asymptotes": "equal", "parameters": {"lapse": 0.5}})"),
              HasSubstr("0.5 is not a value of 'lapse'"));
  EXPECT_THAT(refusal("quest_plus", R"({"candidates": 22})"), HasSubstr("22 candidates of 21 stimuli"));
  EXPECT_THAT(refusal("psi", R"({"stimulus": {"from": -1, "spacing": "linear"}})"),
              HasSubstr("does not cover stimulus -1"));
  EXPECT_THAT(refusal("interleaved", R"({"procedures": []})"), HasSubstr("at least one"));
}

TEST(ProcedureSettings, PartsOfAnInterleavedProcedureShareTheirStimulus) {
  json settings = exampleSettings().back();
  settings["procedures"][1]["stimulus"]["name"] = "y";
  EXPECT_THAT(refusal(settings), HasSubstr("procedures[1]: its stimulus or outcomes differ"));
}

TEST(ProcedureSettings, WrittenSettingsReadBackTheSame) {
  for (const json& example : exampleSettings()) {
    const json written = toJson(readProcedure(example, ""));
    EXPECT_EQ(toJson(readProcedure(json::parse(written.dump()), "")), written) << written.dump(2);
  }
}

TEST(ProcedureSettings, ADimensionsNameAndUnitAreKept) {
  const ProcedureSettings settings = readProcedure(exampleSettings().at(4), "");
  ASSERT_EQ(settings.stimulus.size(), 1u);
  EXPECT_EQ(settings.stimulus[0].name, "contrast");
  EXPECT_EQ(settings.stimulus[0].unit, "dB");
  EXPECT_EQ(settings.stimulus[0].minimum, -40);
  EXPECT_EQ(settings.stimulus[0].maximum, 0);
  const auto procedure = makeProcedure(settings, 1);
  EXPECT_EQ(procedure->estimate().parameters.front().unit, "dB");  // the threshold's is the stimulus's
}

TEST(ProcedureSettings, TrialsThatCannotBeAreRefused) {
  for (const json& example : exampleSettings()) {
    const ProcedureSettings settings = readProcedure(example, "");
    const auto procedure = makeProcedure(settings, 1);
    const std::vector<double> stimulus = *procedure->next();
    const std::string before = procedure->state().dump();
    std::vector<double> longer = stimulus, infinite = stimulus;
    longer.push_back(1);
    infinite.back() = std::numeric_limits<double>::infinity();
    EXPECT_THROW(procedure->update(longer, 1), Error) << example;
    EXPECT_THROW(procedure->update(infinite, 1), Error) << example;
    EXPECT_THROW(procedure->update(stimulus, settings.outcomes), Error) << example;
    EXPECT_THROW(procedure->update(stimulus, -1), Error) << example;
    EXPECT_EQ(procedure->state().dump(), before) << example;
  }
}

TEST(ProcedureSettings, AnImpossibleAnswerIsRefused) {
  const json settings = {{"type", "quest_plus"},
                         {"model", "table"},
                         {"stimulus", {0}},
                         {"parameters", {{"state", {0, 1}}}},
                         {"probabilities", {{{1, 0}, {1, 0}}}},
                         {"stop", {{"trials", 5}}}};
  const auto procedure = makeProcedure(readProcedure(settings, ""), 1);
  EXPECT_THROW(procedure->update({0}, 1), Error);
  EXPECT_THROW(procedure->update({1}, 0), Error);  // not in the table
  EXPECT_EQ(procedure->trialsDone(), 0);
}

TEST(ProcedureSettings, TheDescriptionNamesEveryKeyThatIsWritten) {
  const std::string text = describeProcedures();
  for (const json& example : exampleSettings()) {
    const json written = toJson(readProcedure(example, ""));
    for (const auto& [key, value] : written.items()) {
      EXPECT_THAT(text, HasSubstr(key)) << example["type"];
    }
  }
}

}  // namespace
}  // namespace limen::study
