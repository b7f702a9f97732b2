// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/output/text_output.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limen::analysis {
namespace {

TEST(Base64, MatchesTheVectorsOfRfc4648) {
  const std::pair<const char*, const char*> vectors[] = {
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, encoded] : vectors) EXPECT_EQ(base64(plain), encoded);
  EXPECT_EQ(base64(std::string("\xff\xfe\xfd\x00", 4)), "//79AA==");
}

TEST(EscapeHtml, LeavesNothingThatEndsTextOrAttribute) {
  EXPECT_EQ(escapeHtml("<a href='x'>\"&ü\n\x01"), "&lt;a href=&#39;x&#39;&gt;&quot;&amp;ü&#10;");
}

TEST(FormatNumber, KeepsFourSignificantDigits) {
  EXPECT_EQ(formatNumber(0.0), "0");
  EXPECT_EQ(formatNumber(1234567.0), "1234567");
  EXPECT_EQ(formatNumber(3.14159), "3.142");
  EXPECT_EQ(formatNumber(0.00012345), "0.0001234");
  EXPECT_EQ(formatNumber(1.5e-9), "1.5e-9");
  EXPECT_EQ(formatNumber(INFINITY), "∞");
  EXPECT_EQ(formatNumber(-0.0), "0");
}

TEST(CsvLine, QuotesWhatNeedsIt) {
  EXPECT_EQ(csvLine({"plain", "a,b", "say \"hi\"", "two\nlines", ""}),
            "plain,\"a,b\",\"say \"\"hi\"\"\",\"two\nlines\",\n");
}

TEST(Slug, IsSafeAsAFileName) {
  EXPECT_EQ(slug("Speed & <quality>: ../../x"), "speed_quality_x");
  EXPECT_LE(slug(std::string(500, 'a')).size(), 60U);
}

}  // namespace
}  // namespace limen::analysis
