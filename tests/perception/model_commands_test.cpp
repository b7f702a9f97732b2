// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "experiments/base/error.h"
#include "perception/command/commands.h"
#include "tests/experiments/cli_fixture.h"

namespace limen::perception {
namespace {

/// Runs the commands in a child without starting the program, which takes a fifth of a second to load the
/// image libraries that other commands need.
class Perceive : public experiments::SweepCli {
 protected:
  Perceive() { program_ = std::string(LIMEN_BIN_DIR) + "/limen-perceive"; }
  experiments::CallResult call(std::vector<std::string> arguments) const {
    const pid_t child = fork();
    if (child == 0) {
      const auto redirect = [&](const char* name, int target) {
        dup2(open(path(name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), target);
      };
      redirect("call.out", STDOUT_FILENO);
      redirect("call.err", STDERR_FILENO);
      const int exitCode = run(std::move(arguments));
      std::fflush(nullptr);
      _exit(exitCode);
    }
    return wait(child);
  }
  static int run(std::vector<std::string> arguments) {
    CLI::App app;
    int exitCode = 0;
    addModelCommands(app, exitCode);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    try {
      app.parse(arguments);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? 0 : kExitBadInput;
    } catch (const Error& error) {
      std::fprintf(stderr, "%s\n", error.what());
      return kExitBadInput;
    }
    return exitCode;
  }
  nlohmann::json json(const std::vector<std::string>& arguments) const {
    const experiments::CallResult result = call(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    const auto lines = jsonLines(result.out);
    EXPECT_EQ(lines.size(), 1u) << "one object on one line";
    return lines.empty() ? nlohmann::json() : lines[0];
  }
  void refuses(const std::vector<std::string>& arguments, const std::string& part) const {
    const experiments::CallResult result = call(arguments);
    EXPECT_EQ(result.exitCode, 2) << result.out;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_TRUE(result.out.empty()) << result.out;
  }
};

TEST_F(Perceive, TheProgramDoesTheSame) {
  const auto program = SweepCli::call({"csf", "daly98", "--frequency", "4", "--json"});
  EXPECT_EQ(program.exitCode, 0);
  EXPECT_EQ(program.out, call({"csf", "daly98", "--frequency", "4", "--json"}).out);
  const auto refused = SweepCli::call({"csf", "dali98"});
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.err.find("did you mean 'daly98'?"), std::string::npos) << refused.err;
}

// (9.4) at 4 cpd and 0.15 deg/s: (6.1 + 7.3 |lg 0.085|^3) 1.14 x 0.255 (16.8389)^2 e^-1.654487 = 237.28.
TEST_F(Perceive, OnePointIsOneObject) {
  const auto out =
      json({"csf", "daly98", "--frequency", "4", "--velocity", "0.15", "--luminance", "100", "--json"});
  EXPECT_NEAR(out["value"].get<double>(), 237.28, 0.01);
  EXPECT_EQ(out["model"], "daly98");
  EXPECT_EQ(out["arguments"]["frequency_cpd"], 4.0);
  EXPECT_EQ(out["arguments"]["luminance_cd_m2"], 100.0);
  EXPECT_EQ(out["constants"]["c0"], 1.14);
  EXPECT_TRUE(out["outside_valid_range"].empty());
  for (const char* key : {"unit", "source", "version", "model_version"})
    EXPECT_TRUE(out.contains(key)) << key;
}

TEST_F(Perceive, ConstantsInEitherSpelling) {
  const double once = json({"csf", "daly98", "--frequency", "4", "--json"})["value"];
  const double twice = json({"csf", "daly98", "--frequency", "4", "--c0", "2.28", "--json"})["value"];
  const double set = json({"csf", "daly98", "--frequency=4", "--set", "c0=2.28", "--json"})["value"];
  EXPECT_NEAR(twice, 2.0 * once, 1e-9);
  EXPECT_EQ(set, twice);
  EXPECT_NE(
      json({"csf", "daly98", "--frequency", "4", "--luminance", "1", "--adapt", "false", "--json"})["value"],
      json({"csf", "daly98", "--frequency", "4", "--luminance", "1", "--json"})["value"]);
}

TEST_F(Perceive, OutsideTheRangeIsSaid) {
  const auto out = json({"csf", "martin92", "--frequency", "0.01", "--luminance", "1e5", "--json"});
  EXPECT_EQ(out["outside_valid_range"], (nlohmann::json{"frequency_cpd", "luminance_cd_m2"}));
  EXPECT_TRUE(std::isfinite(out["value"].get<double>()));
  EXPECT_EQ(json({"csf", "barten89", "--frequency", "1", "--velocity", "3", "--json"})["ignored_arguments"],
            nlohmann::json{"velocity_deg_s"});
}

TEST_F(Perceive, EveryModelPrintsItsTable) {
  const auto models = json({"csf", "--list", "--json"})["models"];
  EXPECT_GE(models.size(), 14u);
  // All at once: the program takes a fifth of a second to start.
  std::vector<std::string> command = {"csf", "--luminance", "1,100"};
  for (const auto& model : models) command.push_back(model["model"]);
  EXPECT_EQ(call(command).exitCode, 0);
  command.emplace_back("--json");
  std::set<std::string> names;
  const auto curves = json(command)["curves"];
  for (const auto& curve : curves) {
    names.insert(curve["model"]);
    EXPECT_EQ(curve["rows"].size(), 25u) << curve["model"];
  }
  EXPECT_EQ(names.size(), models.size());
}

TEST_F(Perceive, TablesAsCsv) {
  const experiments::CallResult result =
      call({"csf", "barten89", "--frequency", "1:4:3", "--luminance", "1,100", "--csv"});
  std::istringstream lines(result.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "model,frequency_cpd,velocity_deg_s,luminance_cd_m2,area_deg2,width_deg,orientation_deg,"
            "eccentricity_deg,distance_m,sensitivity,outside_valid_range");
  std::getline(lines, line);
  EXPECT_EQ(line.rfind("barten89,1,,1,,,,,,228.84", 0), 0u) << line;  // csf_B89(1, 1) = 228.84093...
  int rows = 1;
  while (std::getline(lines, line)) ++rows;
  EXPECT_EQ(rows, 6);
}

TEST_F(Perceive, Plots) {
  const std::string svg = path("a 'b.svg");
  ASSERT_EQ(call({"csf", "daly98", "martin92", "--velocity", "0.15,8", "--plot", svg}).exitCode, 0);
  EXPECT_NE(read("a 'b.svg").find("<svg"), std::string::npos);
  EXPECT_TRUE(exists("a 'b.gp") && exists("a 'b.dat"));
  ASSERT_EQ(call({"tvi", "ward", "--plot", path("tvi.png")}).exitCode, 0);
  EXPECT_EQ(read("tvi.png").substr(1, 3), "PNG");
  ASSERT_EQ(call({"masking", "daly", "--plot", path("m.pdf")}).exitCode, 0);
  EXPECT_EQ(read("m.pdf").substr(0, 4), "%PDF");
  refuses({"csf", "daly98", "--plot", path("x.bmp")}, "let the name end in .svg");
  refuses({"csf", "daly98", "--plot", path("no/such/x.svg")}, "cannot be written");
}

TEST_F(Perceive, Tvi) {
  const auto out = json({"tvi", "ward", "--luminance", "10", "--json"});
  EXPECT_NEAR(out["value"].get<double>(), 1.07190, 5e-6);
  EXPECT_NEAR(out["cvi"].get<double>(), 0.107190, 5e-7);
  EXPECT_EQ(out["unit"], "cd/m2");
  EXPECT_NEAR(json({"tvi", "ward", "--cvi", "--luminance", "10", "--json"})["value"].get<double>(), 0.107190,
              5e-7);
  EXPECT_NEAR(
      json({"tvi", "from_csf", "--csf", "barten89", "--luminance", "10", "--json"})["value"].get<double>(),
      0.0248908, 5e-8);
  EXPECT_NEAR(json({"tvi", "from_csf", "--scaled", "--luminance", "100", "--json"})["value"].get<double>(),
              5.55904, 5e-6);
  refuses({"tvi", "ward", "--scaled", "--luminance", "1"}, "only a TVI from a CSF");
  refuses({"tvi", "ward", "--luminance", "0"}, "--luminance");
  refuses({"tvi", "wart"}, "ward");
}

TEST_F(Perceive, MaskingModels) {
  const auto out = json({"masking", "daly", "--contrast", "5", "--json"});
  EXPECT_NEAR(out["value"].get<double>(), 1.6148255800, 5e-10);
  EXPECT_NEAR(out["elevation"].get<double>(), 3.0963096336, 5e-10);
  EXPECT_NEAR(json({"masking", "schwarz", "--contrast", "-3.7", "--json"})["value"].get<double>(),
              -2.493975421, 5e-10);
  EXPECT_NEAR(json({"masking", "extended", "--contrast", "3", "--neighbour-mean", "1.2", "--json"})["value"]
                  .get<double>(),
              0.98075876362, 5e-11);
  refuses({"masking", "extended", "--contrast", "3"}, "--neighbour-mean is missing");
  refuses({"masking", "daly", "--contrast", "3", "--neighbour-mean", "1"}, "does not use neighbours");
  refuses({"masking", "dali"}, "did you mean 'daly'?");
  refuses({"masking", "daly", "--b", "0"}, "allowed: number from 0.1");
}

// 60 Hz x 3 px / 41.2293 px/deg = 4.36583 deg/s at the centre; 0.18 v - 0.15 = 0.635849 remain.
TEST_F(Perceive, Displays) {
  const auto out = json({"display", "schwarz_2009", "--velocity", "3", "--json"});
  EXPECT_NEAR(out["pixels_per_degree"].get<double>(), 41.229, 5e-4);
  EXPECT_NEAR(out["nyquist_cpd"].get<double>(), 20.61, 5e-3);
  EXPECT_NEAR(out["motion"]["screen_deg_s"].get<double>(), 4.36583, 5e-6);
  EXPECT_NEAR(out["motion"]["retinal_deg_s"]["monotone"].get<double>(), 0.635849, 5e-6);
  EXPECT_EQ(out["hash"].get<std::string>().size(), 64u);
  EXPECT_GE(json({"display", "--json"})["displays"].size(), 7u);
  write("mine.yaml", call({"display", "laptop_14", "--yaml"}).out);
  EXPECT_EQ(json({"display", path("mine.yaml"), "--json"})["hash"],
            json({"display", "laptop_14", "--json"})["hash"]);
  refuses({"display", "laptop_41"}, "did you mean 'laptop_14'?");
  write("bad.yaml", "resolution: 3\n");
  refuses({"display", path("bad.yaml")}, "bad.yaml:1:1");
  refuses({"display", "laptop_14", "--at", "-3"}, "--at");
}

TEST_F(Perceive, CsfErrorOfAModelAgainstItselfIsZero) {
  // barten89 at 100 cd/m2, twice as sensitive: a gain of 6.0206 dB and nothing else.
  write("data.csv",
        "dataset,luminance,s_frequency,sensitivity\na,100,0.5,384.97471619\nb,100,3,1047.3018036\n"
        "b,100,8,668.72802828\n");
  const auto results = json({"csf-error", path("data.csv"), "--model", "barten89", "--json"})["results"];
  ASSERT_EQ(results.size(), 3u);
  EXPECT_EQ(results[2]["dataset"], "all");
  EXPECT_NEAR(results[2]["gain_db"].get<double>(), 6.0206, 1e-4);
  EXPECT_NEAR(results[2]["rms_db"].get<double>(), 0.0, 1e-6);
  EXPECT_EQ(call({"csf-error", path("data.csv")}).exitCode, 0);
  refuses({"csf-error", path("none.csv")}, "none.csv");
  refuses({"csf-error", path("data.csv"), "--model", "barten98"}, "did you mean 'barten89'?");
}

TEST_F(Perceive, SlipsAreRefusedWithAnAnswer) {
  refuses({"csf", "dali98"}, "did you mean 'daly98'?");
  refuses({"csf", "daly98", "--velocty", "3"}, "did you mean --velocity?");
  refuses({"csf", "barten89", "--c0", "3"}, "'c0' is not a constant of barten89");
  refuses({"csf", "daly98", "--c0", "x"}, "allowed: number from 0 to 100");
  refuses({"csf", "daly98", "--set", "c0"}, "name=value");
  refuses({"csf", "daly98", "--frequency", "1:0:3"}, "--frequency");
  refuses({"csf", "daly98", "--frequency", "1,,2"}, "is not a number");
  refuses({"csf", "daly98", "--frequency", "nan"}, "is not a number");
  refuses({"csf", "daly98", "--json", "--csv"}, "exclude");
  refuses({"csf", "daly98", "--frequency", "1:2:100000"}, "10000");
  refuses({"csf", "daly98", "--luminance", "1:2:200", "--velocity", "1:2:200"}, "too many");
}

}  // namespace
}  // namespace limen::perception
