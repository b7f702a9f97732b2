// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <sstream>

#include "experiments/base/error.h"
#include "experiments/base/yaml_tree.h"
#include "renderer/catalogue.h"
#include "study/example/example.h"

namespace limen::study {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kGood =
    "title: t\n"
    "question: q\n"
    "studies:\n"
    "  - protocol: quick\n"
    "    observer: {kind: lapsing, lapse: {kind: own, value: 0.1}}\n"
    "    observers: 3\n"
    "    seed: 7\n"
    "    window: {width_px: 64, height_px: 48}\n"
    "analyses: [validate, rates]\n";

std::string messageOf(const std::string& text) {
  try {
    parseExample(text, "e.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string with(const std::string& from, const std::string& to) {
  std::string out = kGood;
  const size_t place = out.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return out.replace(place, from.size(), to);
}

TEST(ExampleReader, ReadsWhatIsThere) {
  const Example example = parseExample(kGood, "folder/mine.yaml");
  EXPECT_EQ(example.name, "mine");
  ASSERT_EQ(example.studies.size(), 1U);
  const ExampleStudy& study = example.studies[0];
  EXPECT_EQ(study.name, "quick");
  EXPECT_EQ(study.observer.name, "lapsing");
  EXPECT_EQ(study.observer.behaviour.lapse, 0.1);
  EXPECT_EQ(study.observer.behaviour.lapse, 0.1);
  EXPECT_EQ(study.observers, 3);
  EXPECT_EQ(study.seed, 7U);
  EXPECT_TRUE(study.predictions);
  EXPECT_EQ(study.windowPx, (std::pair{64, 48}));
  // In the order in which they are made, whatever the order of writing.
  EXPECT_THAT(example.analyses, ElementsAre("rates", "validate"));
  EXPECT_EQ(parseExample(with("analyses: [validate, rates]\n", ""), "e").analyses, exampleAnalyses());
}

TEST(ExampleReader, NamesLineAndNearestName) {
  EXPECT_THAT(messageOf(with("question", "qeustion")),
              AllOf(HasSubstr("e.yaml:2:"), HasSubstr("'question'")));
  EXPECT_THAT(messageOf(with("observers", "obsevers")),
              AllOf(HasSubstr("e.yaml:6:"), HasSubstr("'observers'")));
  EXPECT_THAT(messageOf(with("quick", "qick")), AllOf(HasSubstr("e.yaml:4:"), HasSubstr("'quick'")));
  EXPECT_THAT(messageOf(with("kind: lapsing", "kind: lapsin")),
              AllOf(HasSubstr("e.yaml:5:"), HasSubstr("'lapsing'")));
  EXPECT_THAT(messageOf(with("lapse: {kind: own, value: 0.1}", "laps: {kind: own, value: 0.1}")),
              AllOf(HasSubstr("e.yaml:5:"), HasSubstr("'lapse'")));
  EXPECT_THAT(messageOf(with("width_px", "widht_px")),
              AllOf(HasSubstr("e.yaml:8:"), HasSubstr("'width_px'")));
  EXPECT_THAT(messageOf(with("validate", "validat")), AllOf(HasSubstr("e.yaml:9:"), HasSubstr("'validate'")));
  EXPECT_THAT(messageOf(with("    seed: 7", "    display: schwarz_209")),
              AllOf(HasSubstr("e.yaml:7:"), HasSubstr("schwarz_2009")));
}

TEST(ExampleReader, RefusesWhatDoesNotFit) {
  EXPECT_THAT(messageOf(with("lapse: {kind: own, value: 0.1}", "lapse: {kind: own, value: 2}")),
              HasSubstr("e.yaml:5:"));
  EXPECT_THAT(messageOf(with("lapse: {kind: own, value: 0.1}",
                             "lapse: {kind: own, value: 0.6}, guess: {kind: own, value: 0.6}")),
              HasSubstr("sum to 1"));
  EXPECT_THAT(messageOf(with("observers: 3", "observers: 0")), HasSubstr("e.yaml:6:"));
  EXPECT_THAT(messageOf(with("observers: 3", "observers: many")), HasSubstr("e.yaml:6:"));
  EXPECT_THAT(messageOf(with(", height_px: 48", "")), HasSubstr("'height_px' of window is missing"));
  EXPECT_THAT(messageOf(with("title: t\n", "")), HasSubstr("'title' is missing"));
  EXPECT_THAT(messageOf(with("    observer: {kind: lapsing, lapse: {kind: own, value: 0.1}}\n", "")),
              HasSubstr("'observer' is missing"));
  EXPECT_THAT(messageOf(with("    seed: 7", "    name: ../other")), HasSubstr("not a name for a study"));
  EXPECT_THAT(messageOf(with("analyses:", "  - {protocol: quick, observer: {kind: ideal}}\nanalyses:")),
              AllOf(HasSubstr("e.yaml:9:"), HasSubstr("two studies are called 'quick'")));
  EXPECT_THAT(messageOf("title: t\nquestion: q\nstudies: []\n"), HasSubstr("e.yaml:3:"));
  EXPECT_THAT(messageOf("title: t\nquestion: q\n"), HasSubstr("'studies' is missing"));
  EXPECT_THAT(messageOf(""), HasSubstr("e.yaml:1:"));
  // All at once.
  EXPECT_THAT(messageOf(with("title: t\nquestion: q", "titel: t\nqestion: q")),
              AllOf(HasSubstr("e.yaml:1:"), HasSubstr("e.yaml:2:")));
  EXPECT_THROW(readExample("schwarz_209"), Error);
}

TEST(ExampleReader, AnotherWindowIsInTheTextThatIsStored) {
  ExampleStudy study = parseExample(kGood, "e.yaml").studies[0];
  const auto catalogue = catalogueFromRegistries();
  const Protocol small = protocolOf(study, catalogue);
  EXPECT_EQ(small.window.widthPx, 64);
  EXPECT_EQ(small.window.heightPx, 48);
  study.windowPx.reset();
  const Protocol own = protocolOf(study, catalogue);
  EXPECT_EQ(own.window.widthPx, 320);
  EXPECT_EQ(small.name, own.name);
  EXPECT_NE(small.hash, own.hash);
  EXPECT_EQ(small.window.background, own.window.background);
  // Nothing but that one line differs.
  std::istringstream a(small.text), b(own.text);
  std::string first, second;
  int lines = 0;
  while (std::getline(a, first) && std::getline(b, second)) lines += first != second ? 1 : 0;
  EXPECT_EQ(lines, 1);
  EXPECT_FALSE(std::getline(b, second));
  EXPECT_EQ(parseYaml(small.text, "p").find("window")->find("width_px")->text, "64");
}

TEST(ExampleReader, ShippedExamplesAreGood) {
  const std::string features = readTextFile(LIMEN_SOURCE_DIR "/experiments/features.yaml");
  EXPECT_GE(shippedExamples().size(), 2U);
  const auto catalogue = catalogueFromRegistries();
  for (const auto& [name, title] : shippedExamples()) {
    const Example example = readExample(name);
    EXPECT_EQ(example.title, title);
    for (const std::string& feature : example.features)
      EXPECT_THAT(features, HasSubstr("id: " + feature + ",")) << name;
    // As many observers as the thesis had, so that degrees of freedom are its own.
    for (const ExampleStudy& study : example.studies) {
      EXPECT_EQ(study.observers, study.protocol == "experiment_2" ? 12 : 8) << name;
      EXPECT_NO_THROW(protocolOf(study, catalogue)) << name;
    }
  }
}

}  // namespace
}  // namespace limen::study
