// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_tables/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/answer_tables/levels.h"
#include "analysis/answer_tables/table_input.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string message(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Table, ReadsQuotesMarksAndLineEnds) {
  const Table table = Table::parse(
      "\xEF\xBB\xBF"
      "name,\"the, level\",n\r\n\"a \"\"b\"\"\", 1.5 ,3\r\n\r\n\"two\nlines\",-2e3,90.0\r\n",
      "t.csv");
  EXPECT_THAT(table.header(), ElementsAre("name", "the, level", "n"));
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.text(0, 0), "a \"b\"");
  EXPECT_EQ(table.text(1, 0), "two\nlines");
  EXPECT_EQ(table.number(0, 1), 1.5);
  EXPECT_EQ(table.number(1, table.column("the, level")), -2000.0);
  EXPECT_EQ(table.count(1, 2), 90);
  EXPECT_EQ(table.place(1, 2), "t.csv:4, column 'n'");
}

TEST(Table, TakesTabsAndNoLastLineFeed) {
  const Table table = Table::parse("a\tb\n1,5\t2", "t");
  EXPECT_EQ(table.text(0, 0), "1,5");
  EXPECT_EQ(table.count(0, 1), 2);
  EXPECT_THAT(message([&] { table.number(0, 0); }),
              HasSubstr("t:2, column 'a': '1,5' is not a number; write a decimal point"));
}

TEST(Table, NamesRowAndColumnOfWhatIsWrong) {
  const auto parsed = [](const std::string& text) { return message([&] { Table::parse(text, "t.csv"); }); };
  EXPECT_THAT(parsed(""), HasSubstr("t.csv: is empty"));
  EXPECT_THAT(parsed("\n \n"), HasSubstr("is empty"));
  EXPECT_THAT(parsed("a,b\n"), HasSubstr("no rows"));
  EXPECT_THAT(parsed("a,b\n1,2\n3\n"), HasSubstr("t.csv:3: 1 field(s) where the header has 2"));
  EXPECT_THAT(parsed("a,b\n1,2,3\n"), HasSubstr("t.csv:2: 3 field(s)"));
  EXPECT_THAT(parsed("a,a\n1,2\n"), HasSubstr("two columns are named 'a'"));
  EXPECT_THAT(parsed("a,b\n\"1,2\n"), HasSubstr("t.csv:2: a quote is not closed"));
  EXPECT_THAT(parsed("a,b\n\"1\"x,2\n"), HasSubstr("text follows a closing quote"));
  EXPECT_THAT(parsed("a;b\n1;2\n"), HasSubstr("semicolons"));
  EXPECT_THAT(parsed(std::string("a,b\n\0,1\n", 8)), HasSubstr("zero bytes"));

  const Table table = Table::parse("level,n\nabc,-1\n,2.5\nnan,1e400\n0x10,1e15\n 1 2,+4\n", "t.csv");
  const auto number = [&](size_t row) { return message([&] { table.number(row, 0); }); };
  const auto count = [&](size_t row) { return message([&] { table.count(row, 1); }); };
  EXPECT_THAT(message([&] { table.column("levl", "--x"); }),
              HasSubstr("no column 'levl' (--x); did you mean 'level'?"));
  EXPECT_THAT(number(0), HasSubstr("t.csv:2, column 'level': 'abc' is not a number"));
  EXPECT_THAT(number(1), HasSubstr("t.csv:3, column 'level': is empty"));
  EXPECT_THAT(number(2), HasSubstr("not a finite number"));
  EXPECT_THAT(number(3), HasSubstr("not a number"));
  EXPECT_THAT(number(4), HasSubstr("not a number"));
  EXPECT_THAT(count(0), HasSubstr("negative"));
  EXPECT_THAT(count(1), HasSubstr("not a whole number"));
  EXPECT_THAT(count(2), HasSubstr("too large"));
  EXPECT_THAT(count(3), HasSubstr("too large"));
  EXPECT_EQ(table.count(4, 1), 4);
  EXPECT_THAT(message([] { Table::read("/nowhere/t.csv"); }), HasSubstr("no such file"));
  EXPECT_THAT(message([] { Table::read("/tmp"); }), HasSubstr("is a folder"));
}

TEST(RowFilter, TakesRowsThatFitEveryColumn) {
  const Table table = Table::parse("who,lod,x\na,1,p\nb,2,p\nc,1.0,q\nd,3,p\n", "t.csv");
  const Table one = filterRows(table, {"lod=1"});
  ASSERT_EQ(one.rows(), 2u);
  EXPECT_EQ(one.text(1, 0), "c");
  EXPECT_EQ(one.place(1), "t.csv:4");
  EXPECT_EQ(filterRows(table, {"lod=1", "lod=2", "x=p"}).rows(), 2u);
  EXPECT_EQ(filterRows(table, {}).rows(), 4u);
  EXPECT_THAT(message([&] { filterRows(table, {"lod=4"}); }), HasSubstr("no row has lod=4"));
  EXPECT_THAT(message([&] { filterRows(table, {"led=4"}); }), HasSubstr("did you mean 'lod'?"));
  EXPECT_THAT(message([&] { filterRows(table, {"lod"}); }), HasSubstr("COLUMN=VALUE"));
}

TEST(Levels, AppearInOrderAndNumbersGrow) {
  const Levels text = levelsIn({"still", "moving", "still"});
  EXPECT_THAT(text.names, ElementsAre("still", "moving"));
  EXPECT_THAT(text.ofRow, ElementsAre(0, 1, 0));
  const Levels numbers = levelsIn({"10", "9", "9.0", "-1"});
  EXPECT_THAT(numbers.names, ElementsAre("-1", "9", "10"));
  EXPECT_THAT(numbers.ofRow, ElementsAre(2, 1, 1, 0));
  EXPECT_THAT(levelsIn({"10", "9", "many"}).names, ElementsAre("10", "9", "many"));
  EXPECT_THAT(namesIn({"10", "9", "9.0"}).names, ElementsAre("10", "9", "9.0"));
}

TEST(AnswerColumns, AreOfOneKind) {
  const Table table = Table::parse("k,n,y\n3,4,1\n2,4,1.0\n", "t.csv");
  const AnswerReader counts(table, {"", "k", "n", ""});
  EXPECT_EQ(counts.count(0).correct, 3);
  EXPECT_EQ(counts.value(1), 0.5);
  const AnswerReader outcomes(table, {"y", "", "", ""});
  EXPECT_EQ(outcomes.count(1).correct, 1);
  EXPECT_EQ(outcomes.count(1).trials, 1);
  EXPECT_THAT(message([&] { AnswerReader(table, {"y", "k", "n", ""}); }), HasSubstr("one kind"));
  EXPECT_THAT(message([&] { AnswerReader(table, {"", "", "n", ""}); }), HasSubstr("--k"));
  EXPECT_THAT(message([&] { AnswerReader(table, {}); }), HasSubstr("--outcome, or --k and --n"));
}

}  // namespace
}  // namespace limen::analysis
