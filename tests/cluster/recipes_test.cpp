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

  /// The one block of a language that holds these words.
  static std::string block(const std::string& language, const std::string& words) {
    std::vector<std::string> found;
    for (const std::string& text : blocks(language))
      if (text.find(words) != std::string::npos) found.push_back(text);
    EXPECT_EQ(found.size(), 1U) << language << " with " << words;
    return found.empty() ? "" : found[0];
  }

  /// The first of these programs that ends well with these words; "" if none does.
  static std::string interpreter(const std::vector<std::string>& names, std::vector<std::string> words) {
    words.insert(words.begin(), "");
    for (const std::string& name : names) {
      words[0] = name;
      if ((name[0] == '/' || !findProgram(name).empty()) && runAndRead(words).status == 0) return name;
    }
    return "";
  }

  /// A line with the least RMSE of the fake bitmask, 1 over 32 samples, and one of the other technique.
  static void expectLeastErrors(const ProgramOutput& result) {
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, testing::ContainsRegex("soft/bitmask[^\n]*0\\.03125"));
    EXPECT_THAT(result.out, HasSubstr("soft/pcss"));
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

TEST_F(Recipes, ThePageHasNoOthersThanThoseRunHere) {
  EXPECT_EQ(blocks("python").size(), 2U);
  EXPECT_EQ(blocks("sql").size(), 2U);
  EXPECT_EQ(blocks("r").size(), 2U);
}

TEST_F(Recipes, PlainPythonRunsAsPrinted) {
  const std::string python = interpreter({"python3"}, {"-c", "import sqlite3"});
  if (python.empty()) GTEST_SKIP() << "left out: no python3";
  expectLeastErrors(runAndRead({python, "-c", block("python", "sqlite3.Row")}));
}

TEST_F(Recipes, PandasRunsAsPrinted) {
  // A python3 that comes first on PATH may not be Debian's, which alone has Debian's pandas.
  const std::string python = interpreter({"python3", "/usr/bin/python3"}, {"-c", "import pandas"});
  if (python.empty()) GTEST_SKIP() << "left out: no pandas (Debian: python3-pandas)";
  expectLeastErrors(runAndRead({python, "-c", block("python", "import pandas")}));
}

TEST_F(Recipes, RSqliteRunsAsPrinted) {
  const std::string r = interpreter({"Rscript"}, {"-e", "library(RSQLite)"});
  if (r.empty()) GTEST_SKIP() << "left out: no RSQLite (Debian: r-cran-rsqlite)";
  expectLeastErrors(runAndRead({r, "-e", block("r", "RSQLite")}));
}

TEST_F(Recipes, RRunsAsPrintedOnAnExport) {
  const std::string r = interpreter({"Rscript"}, {"-e", "0"});
  if (r.empty()) GTEST_SKIP() << "left out: no R (Debian: r-base-core)";
  ASSERT_EQ(exported({"-o", path("runs.csv")}).status, 0);
  setenv("RUNS", path("runs.csv").c_str(), 1);
  expectLeastErrors(runAndRead({r, "-e", block("r", "read.csv")}));
}

TEST_F(Recipes, DuckDbRunsAsPrintedOnExports) {
  // Of DuckDB's clients whichever is there; the last two get the query as their last argument.
  std::vector<std::string> client;
  if (!findProgram("duckdb").empty()) client = {"duckdb", "-c"};
  const std::string python = interpreter({"python3", "/usr/bin/python3"}, {"-c", "import duckdb"});
  if (!python.empty()) client = {python, "-c", "import duckdb, sys; print(duckdb.sql(sys.argv[1]))"};
  const std::string node = interpreter({"node"}, {"-e", "require('@duckdb/node-api')"});
  if (!node.empty())
    client = {node, "-e",
              "require('@duckdb/node-api').DuckDBInstance.create().then(i => i.connect())"
              ".then(c => c.runAndReadAll(process.argv[1])).then(r => console.log(r.getRowsJson()))"};
  if (client.empty())
    GTEST_SKIP() << "left out: no DuckDB (duckdb, Python's duckdb, or @duckdb/node-api by NODE_PATH)";
  std::filesystem::current_path(folder_);
  ASSERT_EQ(exported({"-o", path("runs.csv")}).status, 0);
  client.push_back(block("sql", "min(rmse)"));
  expectLeastErrors(runAndRead(client));

  std::string other = validDescriptor();
  other.replace(other.find("metrics: [rmse, crack_count]"), 28, "metrics: [rmse, largest_error]");
  write("e.yaml", other);
  ASSERT_EQ(call({"e.yaml", "--store", "other.sqlite", "--no-report"}).exitCode, 0);
  ASSERT_EQ(runAndRead(
                {std::string(LIMEN_BIN_DIR) + "/limen-export", path("other.sqlite"), "-o", path("other.csv")})
                .status,
            0);
  client.back() = block("sql", "union_by_name");
  const ProgramOutput both = runAndRead(client);
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(both.out,
              testing::AllOf(HasSubstr("runs.csv"), HasSubstr("other.csv"), HasSubstr("soft/bitmask")));
}

}  // namespace
}  // namespace limen::experiments
