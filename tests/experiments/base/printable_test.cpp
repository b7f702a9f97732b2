// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/printable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"

namespace limen {
namespace {

TEST(Printable, LeavesTextAsItIs) {
  const std::string text = "Schärfe – 10 µm 𝛼\n\t日本語 100 %";
  EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatATerminalObeys) {
  EXPECT_EQ(printable("\x1b[2J"), "\\x1b[2J");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\x7f\r\b"), "\\x7f\\x0d\\x08");
  // U+009B is an escape sequence's beginning, too; U+202E turns the direction of writing.
  EXPECT_EQ(printable("\xc2\x9b"), "\\x9b");
  EXPECT_EQ(printable("\xe2\x80\xae"), "\\u202e");
}

TEST(Printable, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("a\xc3"), "a\\xc3");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");           // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
}

TEST(RequirePlainName, RefusesControlCharacters) {
  EXPECT_NO_THROW(requirePlainName("Schärfe 10 %.svg"));
  for (const char* name : {"a\nb", "\x1b", "a\tb", "\x7f"}) EXPECT_THROW(requirePlainName(name), Error);
}

TEST(Gnuplot, TextIsAnExpressionThatIsThisText) {
  EXPECT_EQ(gnuplotQuoted("a'b"), "'a''b'");
  EXPECT_EQ(gnuplotQuoted("'a"), "\"'\".'a'");
  EXPECT_EQ(gnuplotQuoted("''"), "\"'\".\"'\".''");
  EXPECT_EQ(gnuplotQuoted("a\nb"), "'a b'");
  EXPECT_EQ(gnuplotTick("50 %"), "'50 %%'");
  EXPECT_EQ(gnuplotFile("|rm"), "'./|rm'");
  EXPECT_THROW(gnuplotFile("a\nb"), Error);
}

}  // namespace
}  // namespace limen
