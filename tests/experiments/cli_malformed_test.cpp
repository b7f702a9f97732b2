// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "tests/experiments/cli_fixture.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

using testing::HasSubstr;

/// A descriptor with one mistake, where the mistake is, and words that the message must hold.
struct Malformed {
  const char* name;
  std::string text;
  std::string location;  ///< "line:" or "line:column:"
  std::vector<std::string> words;
};

void PrintTo(const Malformed& row, std::ostream* out) { *out << row.name; }

/// The valid descriptor with line `line` (from 1) replaced.
std::string withLine(int line, const std::string& replacement) {
  std::istringstream stream(validDescriptor());
  std::string out;
  int number = 0;
  for (std::string text; std::getline(stream, text);) out += (++number == line ? replacement : text) + "\n";
  return out;
}

std::string withExtra(const std::string& extra) { return validDescriptor() + extra + "\n"; }

std::string numbers(int count) {
  std::string out = "[";
  for (int i = 1; i <= count; ++i) out += (i == 1 ? "" : ", ") + std::to_string(i);
  return out + "]";
}

std::string reals(int count) {
  std::string out = "[";
  for (int i = 0; i < count; ++i) out += (i == 0 ? "" : ", ") + std::to_string(0.00001 * i);
  return out + "]";
}

// Lines of the valid descriptor: 1 title, 2 question, 3 source, 4 scenes, 5 grid, 6 techniques, 7 bitmask, 8
// pcss, 9 reference, 10 image, 11 timing, 12 metrics, 13 report; extras begin in line 14.
std::vector<Malformed> malformed() {
  return {
      {"EmptyFile", "", "1:", {"empty"}},
      {"OnlyComment", "# nothing here\n", "", {"empty"}},
      {"AList", "- a\n- b\n", "1:", {"a list", "map"}},
      {"JustText", "hello\n", "1:", {"'hello'", "map"}},
      {"Binary",
       std::string("\x7f"
                   "ELF\x02\x01\x01\x00\x00",
                   9),
       "1:1:",
       {"control character 0x7f"}},
      {"NulByte", "title: a\nquestion: b" + std::string(1, '\0') + "\n", "2:12:", {"0x00"}},
      {"Latin1", "title: caf\xe9 noir\n", "1:11:", {"0xe9", "UTF-8"}},
      {"Utf16",
       std::string("\xff\xfe"
                   "t\0i\0",
                   6),
       "1:1:",
       {"0xff", "UTF-8"}},
      {"OverlongUtf8", "title: \xc0\xaf\n", "1:8:", {"0xc0"}},
      {"TabIndentation", "title: a\nscenes:\n\t- {name: grid}\n", "3:1:", {"tab", "spaces"}},
      {"UnclosedBracket", withLine(7, "  - {name: soft/bitmask, samples: [8, 16}"), "", {"YAML"}},
      {"UnclosedQuote", withLine(1, "title: \"never closed"), "1:8:", {"a quote that is never closed"}},
      {"BadIndentation", withLine(2, "   question: b"), "2:", {"YAML"}},
      {"DeepBrackets",
       withLine(7, "  - {name: soft/bitmask, samples: " + std::string(100000, '[') + "}"),
       "7:",
       {"64"}},
      {"DeepNesting",
       withLine(
           7, "  - {name: soft/bitmask, samples: " + std::string(20, '[') + "8" + std::string(20, ']') + "}"),
       "7:",
       {"levels of nesting"}},
      {"Anchor", withLine(7, "  - &a {name: soft/bitmask}"), "7:", {"anchor"}},
      {"Alias", withLine(8, "  - *a"), "", {}},
      {"AliasBomb", "a: &a [x, x]\nb: &b [*a, *a]\nc: &c [*b, *b]\n", "1:", {"anchor"}},
      {"Tag", withLine(7, "  - !!python/object {name: soft/bitmask}"), "7:", {"tag"}},
      {"SecondDocument", withExtra("---\ntitle: another"), "", {"second document"}},
      {"DuplicateKey", withExtra("title: again"), "14:1:", {"'title' is given twice", "line 1"}},
      {"DuplicateKeyInEntry",
       withLine(7, "  - {name: soft/bitmask, samples: 8, samples: 16}"),
       "7:38:",
       {"'samples' is given twice"}},
      {"UnknownKey", withLine(11, "timming: {warmup: 1}"), "11:1:", {"'timming'", "did you mean 'timing'?"}},
      {"MissingTitle", withLine(1, "# no title"), "", {"'title' is missing"}},
      {"NullTitle", withLine(1, "title:"), "1:", {"'title' is nothing", "text"}},
      {"MissingScenes",
       "title: a\nquestion: b\ntechniques:\n  - {name: soft/pcss}\n",
       "1:",
       {"'scenes' is missing"}},
      {"EmptyScenes",
       "title: a\nquestion: b\nscenes: []\ntechniques:\n  - {name: soft/pcss}\n",
       "3:9:",
       {"'scenes' is empty"}},
      {"ScenesAsMap",
       "title: a\nquestion: b\nscenes: {name: grid}\ntechniques:\n  - {name: soft/pcss}\n",
       "3:9:",
       {"a map", "list"}},
      {"EntryAsWord", withLine(8, "  - soft/pcss"), "8:5:", {"'soft/pcss'", "{name:"}},
      {"EntryWithoutName", withLine(8, "  - {radius: 0.1}"), "8:5:", {"'name'", "missing", "soft/pcss"}},
      {"UnknownTechnique",
       withLine(8, "  - {name: soft/pcsss}"),
       "8:12:",
       {"no technique 'soft/pcsss'", "did you mean 'soft/pcss'?"}},
      {"UnknownScene", withLine(5, "  - {name: gird}"), "5:12:", {"no scene 'gird'", "did you mean 'grid'?"}},
      {"UnknownParameter",
       withLine(8, "  - {name: soft/pcss, raduis: 0.1}"),
       "8:23:",
       {"'raduis'", "did you mean 'radius'?"}},
      {"TextForNumber",
       withLine(7, "  - {name: soft/bitmask, samples: many}"),
       "7:",
       {"'samples' is 'many'", "whole number from 1 to 100000"}},
      {"QuotedNumber",
       withLine(7, "  - {name: soft/bitmask, samples: \"8\"}"),
       "7:",
       {"the text \"8\"", "without quotes"}},
      {"RealForInteger",
       withLine(7, "  - {name: soft/bitmask, samples: 8.5}"),
       "7:",
       {"'8.5'", "whole number"}},
      {"HexadecimalNumber", withLine(7, "  - {name: soft/bitmask, samples: 0x10}"), "7:", {"'0x10'"}},
      {"OutOfRange",
       withLine(8, "  - {name: soft/pcss, radius: 1.5}"),
       "8:31:",
       {"'radius' is 1.5", "from 0 to 1"}},
      {"OutOfRangeInAxis",
       withLine(7, "  - {name: soft/bitmask, samples: [8, 0, 16]}"),
       "7:39:",
       {"'samples' is 0"}},
      {"HugeInteger",
       withLine(7, "  - {name: soft/bitmask, samples: 99999999999999999999}"),
       "7:",
       {"'99999999999999999999'"}},
      {"NaN", withLine(8, "  - {name: soft/pcss, radius: .nan}"), "8:", {"'.nan'", "number from 0 to 1"}},
      {"Infinity", withLine(8, "  - {name: soft/pcss, radius: [.inf, 0.1]}"), "8:", {"'.inf'"}},
      {"OverflowingReal", withLine(8, "  - {name: soft/pcss, radius: 1e999}"), "8:", {"'1e999'"}},
      {"YesForTrue",
       withLine(8, "  - {name: soft/pcss, fail: yes}"),
       "8:",
       {"'yes'", "did you mean 'true'?"}},
      {"UnknownChoice",
       withLine(7, "  - {name: soft/bitmask, pattern: regular8}"),
       "7:",
       {"did you mean 'regular_8'?", "jittered_16"}},
      {"EmptyAxis",
       withLine(7, "  - {name: soft/bitmask, samples: []}"),
       "7:",
       {"'samples' is empty", "from 1 to 100000"}},
      {"NullInAxis",
       withLine(7, "  - {name: soft/bitmask, samples: [8, ~]}"),
       "7:",
       {"'samples' is nothing"}},
      {"MapAsValue",
       withLine(8, "  - {name: soft/pcss, radius: {from: 0, to: 1}}"),
       "8:",
       {"'radius' is a map"}},
      {"SameValueTwice",
       withLine(7, "  - {name: soft/bitmask, samples: [8, 16, 8]}"),
       "7:",
       {"'samples' lists 8 twice"}},
      {"SameRunTwice",
       withLine(8, "  - {name: soft/bitmask, samples: 16}"),
       "8:5:",
       {"same values", "line 7"}},
      {"SameByDefault",
       withLine(8, "  - {name: soft/pcss}\n  - {name: soft/pcss, radius: 0.05}"),
       "9:5:",
       {"same values", "line 8"}},
      {"MissingFile",
       withLine(5, "  - {name: mesh, file: bunni.obj}"),
       "5:",
       {"no file 'bunni.obj'", "did you mean 'bunny.obj'?"}},
      {"MissingRequired", withLine(5, "  - {name: mesh}"), "5:5:", {"'file' of scene 'mesh' is missing"}},
      {"AxisOnReference",
       withLine(9, "reference: {name: soft/sampled, samples: [1, 2]}"),
       "9:",
       {"give one value"}},
      {"TwoReferences", withLine(9, "reference: [{name: soft/sampled}]"), "9:", {"one reference"}},
      {"MetricWithoutReference", withLine(9, ""), "12:11:", {"'rmse' needs a reference", "soft/sampled"}},
      {"OtherProduct", withLine(8, "  - {name: colour/lambert}"), "8:5:", {"colour", "visibility"}},
      {"UnknownMetric",
       withLine(12, "metrics: [rsme]"),
       "12:11:",
       {"no metric 'rsme'", "did you mean 'rmse'?"}},
      {"MetricTwice", withLine(12, "metrics: [rmse, rmse]"), "12:17:", {"listed twice"}},
      {"MetricParameter",
       withLine(12, "metrics: [{name: flip, ppd: 0}]"),
       "12:29:",
       {"'ppd' is 0", "from 1 to 500"}},
      {"EmptyMetrics", withLine(12, "metrics: []"), "12:10:", {"empty"}},
      {"ZeroWidth", withLine(10, "image: {width: 0, height: 48}"), "10:", {"'width' is 0", "16384"}},
      {"MissingHeight", withLine(10, "image: {width: 64}"), "10:", {"'height' of image is missing"}},
      {"SameSizeTwice",
       withLine(10, "image: [{width: 64, height: 48}, {width: 64, height: 48}]"),
       "10:",
       {"64x48 is given twice"}},
      {"NegativeFrames", withLine(11, "timing: {frames: -1}"), "11:", {"'frames' is -1"}},
      {"MoreRoundsThanFrames",
       withLine(11, "timing: {frames: 2, rounds: 3}"),
       "11:",
       {"3 rounds share 2 frames"}},
      {"ReportSlip",
       withLine(13, "report: {x: gpu_ms, y: rmsee}"),
       "13:",
       {"'rmsee'", "did you mean 'rmse'?"}},
      {"ReportUncounted",
       withLine(13, "report: {x: nodes_per_px}"),
       "13:",
       {"'x' of the report is 'nodes_per_px'"}},
      {"ReportSeries", withLine(13, "report: {series: techniqe}"), "13:", {"did you mean 'technique'?"}},
      {"UnknownFeature", withExtra("features: [SS-999]"), "14:", {"unknown feature 'SS-999'"}},
      {"ExpectMetric",
       withExtra("expect: [{metric: flip, below: 1}]"),
       "14:",
       {"'flip' is not a metric of this descriptor", "rmse"}},
      {"ExpectTechnique",
       withExtra("expect: [{metric: rmse, of: soft/sampled, below: 1}]"),
       "14:",
       {"'soft/sampled' is not a technique of this descriptor"}},
      {"ExpectParameter",
       withExtra("expect: [{metric: rmse, of: soft/pcss, where: {samples: 8}, below: 1}]"),
       "14:",
       {"'samples'", "radius"}},
      {"ExpectUnplannedValue",
       withExtra("expect: [{metric: rmse, where: {samples: 9}, below: 1}]"),
       "14:",
       {"no planned run", "8, 16, 32"}},
      {"ExpectTwoRelations",
       withExtra("expect: [{metric: rmse, below: 1, above: 0}]"),
       "14:",
       {"exactly one"}},
      {"ExpectNoNumber",
       withExtra("expect: [{metric: rmse, below: small}]"),
       "14:",
       {"'below' is 'small'", "a number"}},
      {"ExpectAmbiguous",
       withExtra("expect: [{metric: rmse, of: soft/bitmask, below: 1, relative_to: {of: soft/pcss}}]"),
       "14:",
       {"matches 2 runs", "where"}},
      {"TooManyRuns",
       withLine(7, "  - {name: soft/bitmask, samples: " + numbers(1000) + ", bias: " + reals(1000) +
                       ", sleep_ms: " + numbers(500) + "}"),
       "7:",
       {"the grid has 1000000004 runs", "samples 1000 x bias 1000 x sleep_ms 500", "100000"}},
  };
}

class MalformedDescriptor : public SweepCli, public testing::WithParamInterface<Malformed> {};

TEST_P(MalformedDescriptor, IsRefusedWithPlaceAndRemedyAndLeavesNothing) {
  write("d.yaml", GetParam().text);
  write("bunny.obj", "v 0 0 0\n");
  const CallResult result = call({"d.yaml"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.err, HasSubstr("d.yaml:" + GetParam().location));
  for (const std::string& word : GetParam().words) EXPECT_THAT(result.err, HasSubstr(word));
  EXPECT_LT(result.err.size(), 4000U);
  EXPECT_EQ(result.out, "");
  EXPECT_FALSE(exists("results"));
}

INSTANTIATE_TEST_SUITE_P(Table, MalformedDescriptor, testing::ValuesIn(malformed()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST_F(SweepCli, RefusesWhatIsNoReadableFile) {
  std::filesystem::create_directory(folder_ / "folder.yaml");
  write("large.yaml", std::string(5 << 20, '#'));
  const std::map<std::string, std::string> cases = {{"folder.yaml", "is a folder"},
                                                    {"missing.yaml", "no such file"},
                                                    {"large.yaml", "larger"},
                                                    {"/dev/zero", "larger"}};
  for (const auto& [file, word] : cases) {
    const CallResult result = call({file});
    EXPECT_EQ(result.exitCode, 2) << file;
    EXPECT_THAT(result.err, HasSubstr(file + ": ")) << file;
    EXPECT_THAT(result.err, HasSubstr(word)) << file;
  }
  EXPECT_FALSE(exists("results"));
}

TEST_F(SweepCli, NamesEveryMistakeOfEveryDescriptorAtOnce) {
  write("a.yaml", withLine(8, "  - {name: soft/pcss, raduis: 0.1, fail: 3}"));
  write("b.yaml", withLine(12, "metrics: [rsme]"));
  write("good.yaml", validDescriptor());
  const CallResult result = call({"good.yaml", "a.yaml", "b.yaml"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.err, HasSubstr("a.yaml:8:23: "));
  EXPECT_THAT(result.err, HasSubstr("a.yaml:8:42: "));
  EXPECT_THAT(result.err, HasSubstr("b.yaml:12:11: "));
  EXPECT_FALSE(exists("results")) << "the good one ran although others were refused";
}

TEST_F(SweepCli, CutsAFloodOfMistakesShort) {
  std::string entry = "  - {name: soft/pcss";
  for (int i = 0; i < 1000; ++i) entry += ", wrong_" + std::to_string(i) + ": 1";
  write("d.yaml", withLine(8, entry + "}"));
  const CallResult result = call({"d.yaml"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.err, HasSubstr("980 more errors"));
}

}  // namespace
}  // namespace limen::experiments
