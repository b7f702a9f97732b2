// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/protocol_lettering.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "experiments/base/error.h"
#include "renderer/catalogue.h"

namespace limen::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The shipped quick protocol with its question replaced and lines added.
Protocol quickWith(const std::string& question, const std::string& more = "") {
  const Protocol quick = readProtocol("quick", catalogueFromRegistries());
  std::string text = quick.text;
  const std::string original = "Did the bunny change?\"";
  const size_t at = text.find("question: \"" + original);
  text.replace(at + 11, original.size(), question + "\"");
  return parseProtocol(text + more, "mine.yaml", catalogueFromRegistries());
}

std::string refused(const Protocol& protocol) {
  try {
    checkLettering(protocol);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ProtocolLettering, EuropeanLanguagesAreFine) {
  EXPECT_EQ(refused(readProtocol("quick", catalogueFromRegistries())), "");
  EXPECT_EQ(
      refused(quickWith(
          "D\u00e9j\u00e0 vu \u2013 \u017b\u00f3\u0142w, \u0394\u03ad\u03bb\u03c4\u03b1, \u0414\u0430?")),
      "");
  EXPECT_EQ(refused(quickWith("Changed?", "\nwords: german\n")), "");
}

// Private use: no font has these.
TEST(ProtocolLettering, ACharacterThatNoFontHasIsRefusedWithItsPlace) {
  EXPECT_THAT(refused(quickWith("Was \uE123 there?")),
              AllOf(HasSubstr("mine.yaml:7:"), HasSubstr("(U+E123)"), HasSubstr("task.question"),
                    HasSubstr("fonts-noto-cjk"), HasSubstr("font: FILE")));
  EXPECT_THAT(refused(quickWith("\U0001F600?")), HasSubstr("(U+1F600)"));
}

TEST(ProtocolLettering, AFileThatIsNoFontIsRefused) {
  const std::string file = testing::TempDir() + "no_font.ttf";
  std::ofstream(file) << "something else";
  EXPECT_THAT(refused(quickWith("\u3042?", "\nfont: " + file + "\n")),
              AllOf(HasSubstr(file), HasSubstr("is not a TrueType or OpenType font")));
}

// With whatever wide font is installed; LIMEN_TEST_FONT names one that is not.
TEST(ProtocolLettering, JapaneseIsShownWhereAFontHasIt) {
  const char* font = std::getenv("LIMEN_TEST_FONT");
  const Protocol protocol = quickWith("\u5909\u5316\u3057\u307e\u3057\u305f\u304b\uff1f",
                                      font ? std::string("\nfont: ") + font + "\n" : std::string());
  const std::string said = refused(protocol);
  if (!font && !said.empty()) {
    EXPECT_THAT(said, HasSubstr("U+5909"));
    GTEST_SKIP() << "no font with Japanese characters is installed";
  }
  EXPECT_EQ(said, "");
}

}  // namespace
}  // namespace limen::study
