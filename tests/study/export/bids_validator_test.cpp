// SPDX-License-Identifier: BSD-3-Clause
// Exports as the bids-validator of the BIDS standard reads them. It comes from npm once, into the build
// folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "experiments/base/hash.h"
#include "tests/study/export/exported_study.h"

namespace limen {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

// The command line of this version is one file. Versions from 1.14 on install 700 MB besides.
const std::string kVersion = "1.11.0";
const std::string kSha256 = "2df7426ff0ddeb8fe9fee4bf8784041d6a35d3a85413fdaae38afee9346e9b00";

/// The validator's script; "" with the reason why there is none.
std::string validator(std::string& why) {
  const fs::path folder = fs::path(LIMEN_BIN_DIR).parent_path() / ("bids-validator-" + kVersion);
  const fs::path script = folder / "package/bin/bids-validator";
  if (test::run("node --version").status != 0) return why = "node is not installed", "";
  if (fs::exists(script)) return script;
  if (test::run("npm --version").status != 0) return why = "npm is not installed", "";
  const fs::path part = folder.string() + "." + std::to_string(getpid());
  fs::create_directories(part);
  const test::Said packed = test::run("cd '" + part.string() + "' && npm pack bids-validator@" + kVersion +
                                      " --fetch-retries=0 --fetch-timeout=30000");
  const fs::path archive = part / ("bids-validator-" + kVersion + ".tgz");
  if (packed.status != 0 || !fs::exists(archive)) {
    fs::remove_all(part);
    return why = "npm cannot get the bids-validator: " + packed.text, "";
  }
  EXPECT_EQ(sha256(test::contentOf(archive)), kSha256) << "not the package that was looked at";
  if (testing::Test::HasFailure()) return why = "another package", "";
  const test::Said unpacked = test::run("cd '" + part.string() + "' && tar xzf *.tgz && rm *.tgz");
  EXPECT_EQ(unpacked.status, 0) << unpacked.text;
  std::error_code taken;  // by another test at the same time
  fs::rename(part, folder, taken);
  if (taken) fs::remove_all(part);
  return script;
}

/// Issues of a severity, "errors" or "warnings", by key, with the files that have them.
std::map<std::string, std::vector<std::string>> issues(const json& report, const std::string& severity) {
  std::map<std::string, std::vector<std::string>> out;
  for (const json& issue : report.at("issues").at(severity)) {
    std::vector<std::string>& files = out[issue.at("key")];
    for (const json& file : issue.at("files")) {
      const json about = file.is_object() ? file.value("file", json()) : json();
      files.push_back((about.is_object() ? about.value("relativePath", "") : std::string()) + ": " +
                      (file.is_object() && file.contains("evidence") ? file["evidence"].dump() : ""));
    }
  }
  return out;
}

class BidsValidator : public testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    script_ = validator(why);
    if (script_.empty()) GTEST_SKIP() << "the export is not validated: " << why;
  }
  json validate(const fs::path& folder) const {
    const test::Said said = test::run("node '" + script_ + "' --json '" + folder.string() + "'");
    const size_t begin = said.text.find('{');
    EXPECT_NE(begin, std::string::npos) << said.text;
    return json::parse(said.text.substr(begin == std::string::npos ? 0 : begin), nullptr, false);
  }
  std::string script_;
};

TEST_F(BidsValidator, FindsNoErrorInExports) {
  for (const char* protocol : {"quick", "threshold_2ifc"}) {
    const test::ExportedStudy study(protocol);
    const json report = validate(study.folder("bids"));
    ASSERT_TRUE(report.is_object());
    const auto errors = issues(report, "errors");
    EXPECT_THAT(errors, testing::IsEmpty()) << protocol;
    // Of warnings those stay that only a lab can settle: authors, and whether there are as many subjects as
    // meant.
    for (const auto& [key, files] : issues(report, "warnings"))
      EXPECT_THAT(key, testing::AnyOf("NO_AUTHORS", "README_FILE_SMALL")) << testing::PrintToString(files);
  }
}

TEST_F(BidsValidator, FindsAPlantedMistake) {
  const test::ExportedStudy study("quick");
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(study.folder("bids"))) {
    const std::string name = entry.path().filename();
    if (name.size() < 12 || name.substr(name.size() - 12) != "_events.json") continue;
    json sidecar = json::parse(test::contentOf(entry.path()));
    sidecar["TaskName"] = "quick";
    std::ofstream(entry.path()) << sidecar;
  }
  EXPECT_THAT(issues(validate(study.folder("bids")), "errors"), testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace limen
