// SPDX-License-Identifier: BSD-3-Clause
// The real program on the descriptors that come with the bench, and one sweep from descriptor to report.
#include <signal.h>

#include <chrono>
#include <map>
#include <set>
#include <thread>

#include "experiments/base/hash.h"
#include "experiments/store/store.h"
#include "tests/experiments/cli_fixture.h"

namespace limen::experiments {
namespace {

namespace fs = std::filesystem;

class ShippedDescriptors : public SweepCli {
 protected:
  void SetUp() override {
    SweepCli::SetUp();
    program_ = std::string(LIMEN_BIN_DIR) + "/limen-sweep";
    setenv("LIMEN_ROOT", LIMEN_SOURCE_DIR, 1);
  }

  static std::vector<std::string> shipped() {
    std::vector<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(LIMEN_SOURCE_DIR "/experiments/descriptors"))
      if (entry.path().extension() == ".yaml") out.push_back(entry.path().string());
    return out;
  }

  /// Two scenes of boxes, two techniques, an exact reference: six runs of milliseconds each.
  static std::string tiny(const std::string& timing = "{warmup: 0, frames: 2, rounds: 2, batch: 1}") {
    return "title: Tiny\nquestion: Does everything hold together?\nfeatures: [SS-12]\n"
           "scenes: [{name: parallel_rectangle, height: [0.5, 1]}]\n"
           "techniques:\n  - {name: soft_shadows/hard, resolution: 128}\n"
           "  - {name: soft_shadows/bitmask, resolution: 128, pattern: [regular_8, jittered_16]}\n"
           "reference: {name: soft_shadows/exact_union}\nimage: {width: 48, height: 36}\n"
           "artefacts: {exr: true}\nmetrics: [rmse, largest_error]\ntiming: " +
           timing + "\nexpect: [{metric: non_finite_count, equals: 0}]\n";
  }

  /// SHA-256 as stored of each run's product, checked against the file itself.
  std::map<std::string, std::string> productHashes(const std::string& folder) const {
    const store::Store results(path(folder + "/d.sqlite"), store::Access::ReadOnly);
    std::map<std::string, std::string> out;
    for (const store::Run& run : results.allRuns())
      for (const store::Artefact& artefact : run.artefacts) {
        if (artefact.kind != "product_exr") continue;
        EXPECT_EQ(artefact.sha256, sha256File(path(folder + "/" + artefact.path)));
        out[run.key] = artefact.sha256;
      }
    return out;
  }
};

TEST_F(ShippedDescriptors, AreValidAndPlan) {
  const std::vector<std::string> descriptors = shipped();
  ASSERT_GT(descriptors.size(), 3U);
  for (const std::string& descriptor : descriptors) {
    const CallResult result = call({descriptor, "--dry-run"});
    EXPECT_EQ(result.exitCode, 0) << descriptor << ": " << result.err;
    EXPECT_FALSE(exists("results")) << "a dry run left something behind";
  }
}

TEST_F(ShippedDescriptors, NameEveryTechnique) {
  std::string texts;
  for (const std::string& descriptor : shipped()) {
    std::ifstream stream(descriptor);
    for (std::string line; std::getline(stream, line);)
      texts += line.substr(0, line.find('#')) + "\n";  // a name in a comment is not a run
  }
  const CallResult listed = call({"--list", "techniques", "--json"});
  ASSERT_EQ(listed.exitCode, 0) << listed.err;
  size_t techniques = 0;
  for (const nlohmann::json& technique : jsonLines(listed.out)) {
    ++techniques;
    const auto name = technique["name"].get<std::string>();
    EXPECT_TRUE(texts.find("name: " + name + "}") != std::string::npos ||
                texts.find("name: " + name + ",") != std::string::npos)
        << name << " is in no descriptor";
  }
  EXPECT_GT(techniques, 5U);
}

// An error of fields against rays means little without the rays: what a run is keyed and stored by says how
// many they are and where they lie in their cells.
TEST_F(ShippedDescriptors, ErrorsOfFieldsNameTheRaySetOfTheirReference) {
  size_t runs = 0;
  for (const std::string& descriptor : shipped()) {
    if (descriptor.find("visibility_field") == std::string::npos) continue;
    const CallResult planned = call({descriptor, "--dry-run", "--json"});
    for (const nlohmann::json& line : jsonLines(planned.out)) {
      if (!line.contains("parameters") || !line["parameters"].contains("reference")) continue;
      const nlohmann::json& reference = line["parameters"]["reference"];
      const std::string name = reference.value("name", "");
      if (!name.starts_with("visibility_fields/")) continue;
      ++runs;
      EXPECT_GE(reference.value("rays", 0), 1) << descriptor << ": " << reference;
      // All vertices have the same rays.
      EXPECT_TRUE(name.ends_with("vertex_occlusion") || reference.contains("pattern") ||
                  reference.contains("turned"))
          << descriptor << ": " << reference;
    }
  }
  EXPECT_GT(runs, 300U);
}

TEST_F(ShippedDescriptors, CoverTheSoftShadowFeaturesThatAreBuilt) {
  const CallResult result = call({"--features", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  std::set<std::string> covered;
  for (const nlohmann::json& feature : jsonLines(result.out))
    if (feature.contains("id") && !feature["descriptors"].empty())
      covered.insert(feature["id"].get<std::string>());
  for (const char* id : {"SS-01", "SS-02", "SS-04", "SS-05", "SS-10", "SS-11", "SS-12", "SS-13", "SS-14",
                         "SS-21", "SS-22", "SS-23", "SS-24", "SS-25", "SS-35", "SS-36", "SS-39", "SS-44"})
    EXPECT_TRUE(covered.count(id)) << id;
}

TEST_F(ShippedDescriptors, NothingHasMoreThanSixteenParametersOnItsOwnLevel) {
  const CallResult result = call({"--list", "--json"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  size_t entries = 0;
  for (const nlohmann::json& entry : jsonLines(result.out)) {
    EXPECT_LE(entry.at("parameters").size(), 16U) << entry.at("name");
    ++entries;
  }
  EXPECT_GT(entries, 80U);  // scenes, techniques and metrics
}

TEST_F(ShippedDescriptors, SweepRunsFromDescriptorToReportAndTheSameBytesTwice) {
  write("d.yaml", tiny());
  const CallResult first = call({"d.yaml", "--json"});
  ASSERT_EQ(first.exitCode, 0) << first.out << first.err;
  const auto lines = jsonLines(first.out);
  ASSERT_EQ(lines.size(), 7U);
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(lines[i]["status"], "done");
    EXPECT_EQ(lines[i]["measurements"]["non_finite_count"], 0.0);
    EXPECT_GT(lines[i]["measurements"]["gpu_ms"].get<double>(), 0.0);
  }
  EXPECT_EQ(lines[6]["done"], 6);
  EXPECT_TRUE(lines[6]["broken"].empty());
  EXPECT_TRUE(exists("results/d_report/report.html"));

  const CallResult again = call({"d.yaml", "--json", "--no-report"});
  EXPECT_EQ(again.exitCode, 0);
  EXPECT_EQ(jsonLines(again.out).back()["skipped"], 6);
  EXPECT_EQ(jsonLines(again.out).back()["done"], 0);

  ASSERT_EQ(call({"d.yaml", "--no-report", "--store", "other/d.sqlite"}).exitCode, 0);
  const auto hashes = productHashes("results");
  EXPECT_EQ(hashes.size(), 6U);
  EXPECT_EQ(hashes, productHashes("other"));
  std::set<std::string> distinct;
  for (const auto& [key, hash] : hashes) distinct.insert(hash);
  EXPECT_EQ(distinct.size(), 6U) << "different runs have the same picture";
}

TEST_F(ShippedDescriptors, KilledSweepLosesNothingThatItAnnounced) {
  // Each run is timed for about as long as it takes to see its line, so that the kill falls among them.
  write("d.yaml", tiny("{warmup: 0, frames: 100, rounds: 2, batch: 1}"));
  const pid_t child = start({"d.yaml", "--json", "--no-report"});
  for (int i = 0; i < 1000 && read("call.out").find('\n') == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(child, SIGKILL);
  const CallResult killed = wait(child);
  ASSERT_EQ(killed.exitCode, -SIGKILL) << "ended before it could be killed: " << killed.out;
  std::set<std::string> announced;
  std::istringstream stream(killed.out);
  for (std::string line; std::getline(stream, line) && !stream.eof();)
    announced.insert(nlohmann::json::parse(line)["key"].get<std::string>());
  ASSERT_FALSE(announced.empty()) << killed.err;
  ASSERT_LT(announced.size(), 6U);

  const CallResult resumed = call({"d.yaml", "--json", "--no-report"});
  ASSERT_EQ(resumed.exitCode, 0) << resumed.err;
  const auto lines = jsonLines(resumed.out);
  for (size_t i = 0; i + 1 < lines.size(); ++i)
    EXPECT_FALSE(announced.count(lines[i]["key"].get<std::string>())) << "measured twice";
  EXPECT_GE(lines.back()["skipped"].get<size_t>(), announced.size());
  EXPECT_EQ(lines.back()["skipped"].get<size_t>() + lines.back()["done"].get<size_t>(), 6U);
}

}  // namespace
}  // namespace limen::experiments
