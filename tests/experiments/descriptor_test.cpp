// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/descriptor.h"

#include <gmock/gmock.h>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/describe_names.h"
#include "tests/experiments/base/declare.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

using testing::ElementsAre;

/// Of an axis along which one parameter varies.
std::vector<ParameterValue> valuesOf(const Axis& axis) {
  std::vector<ParameterValue> out;
  for (const AxisPoint& point : axis.points) out.push_back(point.at(axis.name));
  return out;
}

Descriptor parse(const std::string& text) { return parseDescriptor(text, "d.yaml", fakeCatalogue(), {}); }

TEST(Descriptor, ReadsEveryKey) {
  const Descriptor descriptor =
      parse(validDescriptor() +
            "features: [SS-12, SS-13]\nartefacts: {pictures: false, exr: true}\n"
            "expect:\n  - {metric: rmse, of: soft/bitmask, where: {samples: 8}, below: 0.2}\n");
  EXPECT_EQ(descriptor.title, "Bitmask against a filtered map");
  EXPECT_EQ(descriptor.question, "Which is nearer to the sampled light?");
  EXPECT_EQ(descriptor.source, "Test 2024, section 1");
  EXPECT_EQ(descriptor.hash, sha256(descriptor.text));
  EXPECT_EQ(descriptor.features, (std::vector<std::string>{"SS-12", "SS-13"}));
  ASSERT_EQ(descriptor.techniques.size(), 2U);
  ASSERT_EQ(descriptor.techniques[0].axes.size(), 1U);
  EXPECT_THAT(valuesOf(descriptor.techniques[0].axes[0]),
              ElementsAre(int64_t{8}, int64_t{16}, ParameterValue(int64_t{32})));
  // A whole number stands for a real one where a real one is declared.
  EXPECT_EQ(valuesOf(descriptor.scenes[0].axes[0])[1], ParameterValue(1.0));
  ASSERT_TRUE(descriptor.reference);
  EXPECT_EQ(descriptor.reference->name, "soft/sampled");
  EXPECT_EQ(descriptor.timing.frames, 4);
  EXPECT_EQ(descriptor.timing.batch, Timing{}.batch);
  EXPECT_FALSE(descriptor.artefacts.pictures);
  EXPECT_TRUE(descriptor.artefacts.exr);
  ASSERT_EQ(descriptor.expectations.size(), 1U);
  EXPECT_EQ(descriptor.expectations[0].text, "rmse of soft/bitmask where samples=8 below 0.2");
  EXPECT_EQ(descriptor.report["panels"], "scene");
}

TEST(Descriptor, NeedsNoReferenceForMetricsThatEvaluateOneImage) {
  const Descriptor descriptor = parse(
      "title: a\nquestion: b\nscenes: [{name: grid}]\ntechniques: [{name: colour/lambert}, {name: "
      "soft/pcss}]\n"
      "metrics: [crack_count]\n");
  EXPECT_FALSE(descriptor.reference);
  EXPECT_EQ(descriptor.images.size(), 1U);
}

TEST(Descriptor, RefusesMetricsOfTessellationsForTechniquesThatMakeNone) {
  const std::string text =
      "title: a\nquestion: b\nscenes: [{name: grid}]\ntechniques: [{name: soft/pcss}]\nmetrics: "
      "[crack_count]\n";
  Catalogue catalogue = fakeCatalogue();
  catalogue.metrics["crack_count"].needsTessellation = true;
  EXPECT_THROW(parseDescriptor(text, "d.yaml", catalogue, {}), Error);
  catalogue.techniques["soft/pcss"].tessellates = true;
  EXPECT_NO_THROW(parseDescriptor(text, "d.yaml", catalogue, {}));
}

TEST(Descriptor, ReportAxesMayNameWhatATechniqueCounts) {
  EXPECT_EQ(parse("title: a\nquestion: b\nscenes: [{name: grid}]\ntechniques: [{name: soft/pcss}]\n"
                  "report: {x: fetches_per_px, y: gpu_ms}\n")
                .report["x"],
            "fetches_per_px");
}

TEST(Descriptor, AReportFitsOverParameters) {
  const std::string text =
      "title: a\nquestion: b\nscenes: [{name: grid}]\ntechniques: [{name: soft/sampled, samples: [4, 16]}]\n";
  EXPECT_EQ(parse(text).report.count("fit"), 0U);
  EXPECT_EQ(parse(text + "report: {fit: samples}\n").report["fit"], "samples");
  EXPECT_EQ(parse(text + "report: {x: samples, fit: [samples, width]}\n").report["fit"], "samples, width");
  for (const char* wrong : {"sample", "[samples, gpu_ms]", "[]", "{a: 1}", "technique"})
    EXPECT_THROW(parse(text + "report: {fit: " + wrong + "}\n"), Error) << wrong;
}

TEST(Descriptor, OneMetricWithSeveralValuesGivesSeveralMeasurements) {
  const Descriptor descriptor = parse(
      "title: a\nquestion: b\nscenes: [{name: grid}]\ntechniques: [{name: soft/pcss}]\n"
      "reference: {name: soft/sampled}\n"
      "metrics: [rmse, flip, {name: flip, ppd: 30}]\n"
      "expect: [{metric: flip_30, below: 0.1}]\nreport: {y: flip_30}\n");
  EXPECT_EQ(descriptor.metricNames, (std::vector<std::string>{"rmse", "flip", "flip_30"}));
  // Alone, a metric has its plain name whatever its values.
  EXPECT_EQ(parse("title: a\nquestion: b\nscenes: [{name: grid}]\ntechniques: [{name: soft/pcss}]\n"
                  "reference: {name: soft/sampled}\nmetrics: [{name: flip, ppd: 30}]\n")
                .metricNames,
            std::vector<std::string>{"flip"});
}

// Each figure can be an axis and an expectation, and is described in the store with its own unit.
TEST(Descriptor, AMetricWithSeveralFiguresGivesAMeasurementForEach) {
  Catalogue catalogue = fakeCatalogue();
  CatalogueEntry& metric = catalogue.metrics["seen"];
  metric.parameters = {integerParameter("steps", 4, 1, 9, "", "Steps")};
  metric.figures = {{"p95", "Seen, 95th percentile", "JND", Direction::LowerIsBetter},
                    {"step", "Step", "", Direction::Neither}};
  const auto read = [&](const std::string& metrics) {
    return parseDescriptor(
        "title: a\nquestion: b\nscenes: [{name: grid}]\ntechniques: [{name: soft/pcss}]\n"
        "reference: {name: soft/sampled}\nmetrics: " +
            metrics +
            "\nreport: {y: seen_p95}\n"
            "expect: [{metric: seen_p95, below: 1}]\n",
        "d.yaml", catalogue, {});
  };
  const Descriptor descriptor = read("[rmse, seen, {name: seen, steps: 9}]");
  EXPECT_EQ(descriptor.metricNames,
            (std::vector<std::string>{"rmse", "seen_p95", "seen_step", "seen_9_p95", "seen_9_step"}));
  EXPECT_THROW(read("[seen, seen]"), Error);
  const store::Descriptions described = describeNames(descriptor, catalogue);
  ASSERT_NE(described.quantity("seen_9_p95"), nullptr);
  EXPECT_EQ(described.quantity("seen_9_p95")->title, "Seen, 95th percentile, 9");
  EXPECT_EQ(described.quantity("seen_9_p95")->unit, "JND");
  EXPECT_EQ(described.quantity("seen_p95")->kind, "error");
  EXPECT_EQ(described.quantity("seen_step")->kind, "fact");
  EXPECT_EQ(described.quantity("seen"), nullptr) << "only its figures are stored";
}

TEST(Descriptor, NumbersInTheFormsOfYaml) {
  const Descriptor descriptor = parse(
      "title: a\nquestion: b\nscenes: [{name: grid, light_size: [+1, 2., .5, 1e1, 2.5E-1]}]\n"
      "techniques: [{name: soft/pcss}]\n");
  const std::vector<ParameterValue> expected = {1.0, 2.0, 0.5, 10.0, 0.25};
  EXPECT_EQ(valuesOf(descriptor.scenes[0].axes[0]), expected);
}

/// The catalogue with a free text and a file that may be given, as scenes have them for their camera.
Catalogue catalogueWithView() {
  Catalogue out = fakeCatalogue();
  out.scenes["grid"].parameters.push_back(textParameter("camera", "", "View"));
  out.scenes["grid"].parameters.push_back(optionalFileParameter("camera_path", "Path"));
  return out;
}

std::vector<ParameterValue> camerasOf(const std::string& written) {
  const std::string text = "title: a\nquestion: b\nscenes:\n  - {name: grid, camera: " + written +
                           "}\ntechniques: [{name: soft/pcss}]\n";
  return valuesOf(parseDescriptor(text, "d.yaml", catalogueWithView(), {}).scenes[0].axes[0]);
}

TEST(Descriptor, TextIsAScalarAndAListOfThemAnAxis) {
  const std::string near = "eye 0 0 1 target 0 0 0", far = "eye 0 0 9.5e-3 target 0 0 0 fov 30";
  EXPECT_EQ(camerasOf(near), std::vector<ParameterValue>{near});
  EXPECT_EQ(camerasOf("\"" + near + "\""), std::vector<ParameterValue>{near});
  EXPECT_EQ(camerasOf("[" + near + ", '" + far + "']"), (std::vector<ParameterValue>{near, far}));
  // The empty text is a value like others, but must be written.
  EXPECT_EQ(camerasOf("[\"\", " + near + "]"), (std::vector<ParameterValue>{std::string(), near}));
  EXPECT_THROW(camerasOf(""), Error);
  // A comma ends a value within braces: the rest is no key of the scene.
  try {
    camerasOf("eye 0, 0, 1 target 0 0 0");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("d.yaml:4:"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("no parameter '0'"), std::string::npos) << error.what();
  }
}

TEST(Descriptor, AFileThatMayBeGivenMustBeThereIfItIs) {
  const auto read = [](const std::string& extra) {
    return parseDescriptor(
        "title: a\nquestion: b\nscenes: [{name: grid" + extra + "}]\ntechniques: [{name: soft/pcss}]\n",
        "d.yaml", catalogueWithView(), {});
  };
  EXPECT_TRUE(read("").fileHashes.empty());
  EXPECT_THROW(read(", camera_path: absent.yaml"), Error);
  EXPECT_THROW(read(", camera_path: ''"), Error);
}

}  // namespace
}  // namespace limen::experiments
