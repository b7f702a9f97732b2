// SPDX-License-Identifier: BSD-3-Clause
#include <sqlite3.h>

#include <cstdlib>

#include "experiments/base/child_process.h"
#include "tests/experiments/cli_fixture.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

using testing::HasSubstr;

class Recipes : public SweepCli {
 protected:
  void SetUp() override {
    SweepCli::SetUp();
    write("d.yaml", validDescriptor());
    ASSERT_EQ(call({"d.yaml", "--store", "quick.sqlite", "--no-report"}).exitCode, 0);
    setenv("STORE", path("quick.sqlite").c_str(), 1);
  }

  ProgramOutput exported(std::vector<std::string> words) const {
    words.insert(words.begin(), {std::string(LIMEN_BIN_DIR) + "/limen-export", path("quick.sqlite")});
    return runAndRead(words);
  }

  /// The fenced blocks of docs/recipes.md in one language.
  static std::vector<std::string> blocks(const std::string& language) {
    std::ifstream file(std::string(LIMEN_SOURCE_DIR) + "/docs/recipes.md");
    std::vector<std::string> out;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
      if (line == "```" + language) {
        inside = true;
        out.emplace_back();
      } else if (line == "```") {
        inside = false;
      } else if (inside) {
        out.back() += line + "\n";
      }
    }
    return out;
  }

  /// What a query of one value gives, as text.
  std::string ask(const std::string& sql) const {
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open_v2(path("quick.sqlite").c_str(), &database, SQLITE_OPEN_READONLY, nullptr),
              SQLITE_OK);
    std::string out;
    char* error = nullptr;
    sqlite3_exec(
        database, sql.c_str(),
        [](void* to, int, char** values, char**) {
          *static_cast<std::string*>(to) += std::string(values[0] ? values[0] : "null") + ";";
          return 0;
        },
        &out, &error);
    if (error) out += error;
    sqlite3_free(error);
    sqlite3_close(database);
    return out;
  }
};

TEST_F(Recipes, TheViewHasARowForEachRunWithItsParametersAndMeasurements) {
  // rmse of the fake bitmask is 1 / samples, on two light sizes.
  EXPECT_EQ(ask("SELECT count(*) FROM runs"), "10;");
  EXPECT_EQ(ask("SELECT DISTINCT rmse * \"technique.samples\" FROM runs WHERE technique = 'soft/bitmask'"),
            "1.0;");
  EXPECT_EQ(ask("SELECT DISTINCT \"scene.light_size\" FROM runs ORDER BY 1"), "0.5;1.0;");
  EXPECT_EQ(ask("SELECT DISTINCT typeof(rmse) || typeof(\"technique.samples\") || \"image.width\" FROM runs "
                "WHERE technique = 'soft/bitmask'"),
            "realinteger64;");
  EXPECT_EQ(ask("SELECT count(*) FROM runs WHERE \"technique.radius\" IS NULL"), "6;")
      << "what a technique does not have is empty";
  EXPECT_EQ(ask("SELECT count(*) FROM runs r JOIN run ON run.id = r.run AND run.key = r.key"), "10;");
}

TEST_F(Recipes, TheViewGrowsWithWhatTheStoreHolds) {
  std::string other = validDescriptor();
  other.replace(other.find("metrics: [rmse, crack_count]"), 28, "metrics: [rmse, largest_error]");
  write("e.yaml", other);
  EXPECT_THAT(ask("SELECT largest_error FROM runs LIMIT 1"), HasSubstr("no such column"));
  ASSERT_EQ(call({"e.yaml", "--store", "quick.sqlite", "--no-report"}).exitCode, 0);
  EXPECT_EQ(ask("SELECT count(*) FROM runs WHERE largest_error IS NULL"), "20;");
}

TEST_F(Recipes, CsvHasARowForEachRunAndVegaTheMarksOfTheReport) {
  const ProgramOutput csv = exported({});
  EXPECT_EQ(csv.status, 0) << csv.err;
  EXPECT_EQ(std::count(csv.out.begin(), csv.out.end(), '\n'), 11);
  EXPECT_THAT(csv.out, HasSubstr("technique.samples"));

  const ProgramOutput vega = exported({"--format", "vega"});
  ASSERT_EQ(vega.status, 0) << vega.err;
  const nlohmann::json spec = nlohmann::json::parse(vega.out);
  EXPECT_EQ(spec.at("$schema"), "https://vega.github.io/schema/vega-lite/v5.json");
  const nlohmann::json& values = spec.at("data").at("values");
  EXPECT_EQ(values.size(), 10U);
  std::set<std::string> panels, series;
  for (const nlohmann::json& row : values) {
    panels.insert(row.at("panel"));
    series.insert(row.at("series"));
    EXPECT_GT(row.at("x").get<double>(), 0.0);
  }
  EXPECT_EQ(panels.size(), 2U) << "a panel for each light size";
  EXPECT_EQ(series.size(), 2U);
  // Every field that an encoding names is in the data.
  for (const nlohmann::json& layer : spec.at("spec").at("layer"))
    for (const auto& [name, encoding] : layer.at("encoding").items()) {
      if (!encoding.is_object() || !encoding.contains("field")) continue;
      EXPECT_TRUE(values.at(0).contains(encoding.at("field").get<std::string>())) << name;
    }
  EXPECT_THAT(spec.at("spec").at("layer").back().at("encoding").at("x").at("title").get<std::string>(),
              HasSubstr("(ms)"));
}

TEST_F(Recipes, LatexHasUnitsAndARowForEachMark) {
  const ProgramOutput latex = exported({"--format", "latex"});
  ASSERT_EQ(latex.status, 0) << latex.err;
  EXPECT_THAT(latex.out, HasSubstr("(ms)"));
  EXPECT_THAT(latex.out, HasSubstr("\\begin{tabular}{lrrr}"));
  size_t rows = 0;
  for (size_t at = 0; (at = latex.out.find(" \\\\\n", at)) != std::string::npos; ++at) ++rows;
  EXPECT_EQ(rows, 10U + 1 + 2) << "runs, head, panels";
}

TEST_F(Recipes, AnIncompleteSweepIsExportedOnlyIfForcedAndSaysSo) {
  ASSERT_EQ(call({"d.yaml", "--shard", "1/2", "--store", "half.sqlite"}).exitCode, 0);
  const std::string program = std::string(LIMEN_BIN_DIR) + "/limen-export";
  const ProgramOutput refused = runAndRead({program, path("half.sqlite"), "--format", "latex"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("missing"));
  const ProgramOutput forced = runAndRead({program, path("half.sqlite"), "--format", "latex", "--force"});
  EXPECT_THAT(forced.out, HasSubstr("% Not complete"));
}

TEST_F(Recipes, PythonRunsAsPrinted) {
  if (findProgram("python3").empty()) GTEST_SKIP() << "no python3";
  size_t ran = 0;
  for (const std::string& block : blocks("python")) {
    for (const char* library : {"pandas", "duckdb"})
      if (block.find(std::string("import ") + library) != std::string::npos &&
          runAndRead({"python3", "-c", std::string("import ") + library}).status != 0)
        goto next;
    {
      const ProgramOutput result = runAndRead({"python3", "-c", block});
      EXPECT_EQ(result.status, 0) << block << result.err;
      EXPECT_THAT(result.out, HasSubstr("soft/bitmask"));
      ++ran;
    }
  next:;
  }
  EXPECT_GE(ran, 1U) << "the first needs nothing but Python";
}

TEST_F(Recipes, RRunsAsPrinted) {
  if (findProgram("Rscript").empty()) GTEST_SKIP() << "no R";
  ASSERT_EQ(exported({"-o", path("runs.csv")}).status, 0);
  setenv("RUNS", path("runs.csv").c_str(), 1);
  for (const std::string& block : blocks("r")) {
    if (block.find("RSQLite") != std::string::npos &&
        runAndRead({"Rscript", "-e", "library(RSQLite)"}).status != 0)
      continue;
    const ProgramOutput result = runAndRead({"Rscript", "-e", block});
    EXPECT_EQ(result.status, 0) << block << result.err;
    EXPECT_THAT(result.out, HasSubstr("soft/bitmask"));
  }
}

}  // namespace
}  // namespace limen::experiments
