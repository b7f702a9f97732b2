// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/words.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "experiments/base/error.h"
#include "study/protocol/visible_texts.h"
#include "tests/study/protocol/example.h"

namespace limen::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string refusedWords(const std::string& text) {
  try {
    Words::parse(text, "words.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// A complete translation into itself, with lines replaced.
std::string english(const std::string& line, const std::string& by) {
  std::string out;
  for (const auto& [key, text] : Words::english().all()) {
    std::string own = key + ": \"";
    for (const char c : text) own += c == '"' ? std::string("\\\"") : std::string(1, c);
    own += "\"";
    out += (key == line ? by : own) + "\n";
  }
  return out;
}

TEST(Words, EveryShippedLanguageIsComplete) {
  for (const char* language : {"english", "german"}) {
    const Words words = readWords(language, "");
    EXPECT_EQ(words.all().size(), Words::english().all().size());
    EXPECT_EQ(words.hash().size(), 64U);
  }
  EXPECT_EQ(readWords("german", "")["no"], "nein");
}

TEST(Words, PlaceholdersAreFilled) {
  EXPECT_EQ(Words::english().filled("progress", {{"done", "3"}, {"count", "12"}}), "3 of 12");
  // A value with a placeholder in it is left alone.
  EXPECT_EQ(Words::english().filled("answer_help", {{"answers", "{answers}"}}).find("{answers}"),
            Words::english()["answer_help"].find("{answers}"));
}

TEST(Words, WhatIsMissingUnknownOrOtherwiseFilledIsNamedWithItsPlace) {
  EXPECT_EQ(refusedWords(english("", "")), "");
  EXPECT_THAT(refusedWords(english("pause_title", "")),
              AllOf(HasSubstr("'pause_title' is missing"), HasSubstr("in English: Pause")));
  EXPECT_THAT(refusedWords(english("pause_title", "pause_titel: Halt")),
              AllOf(HasSubstr("words.yaml:"), HasSubstr("no text 'pause_titel'"), HasSubstr("pause_title")));
  EXPECT_THAT(
      refusedWords(english("progress", "progress: \"{done} / {all}\"")),
      AllOf(HasSubstr("'progress' has the placeholders {all}, {done}"), HasSubstr("{count}, {done}")));
  EXPECT_THAT(refusedWords(english("progress", "progress: [1]")), HasSubstr("'progress' is a list"));
}

TEST(Words, AProtocolNamesItsLanguageOrAFileBesideIt) {
  const Protocol german = exampleProtocol(kYesNo + kBox + "words: german\n");
  EXPECT_EQ(german.words["continue"], "Weiter");
  EXPECT_EQ(german.parts[0].task.answers, (std::vector<std::string>{"yes", "no"})) << "what is stored";
  EXPECT_EQ(german.parts[0].task.labels, (std::vector<std::string>{"ja", "nein"})) << "what is shown";
  const Protocol own =
      exampleProtocol("task: {type: yes_no, question: q, answers: [si, non]}\n" + kBox + "words: german\n");
  EXPECT_EQ(own.parts[0].task.labels, (std::vector<std::string>{"si", "non"}));
  EXPECT_THAT(refusal(protocolText(kYesNo + kBox + "words: germn\n")),
              AllOf(HasSubstr("test.yaml:5:"), HasSubstr("did you mean 'german'")));

  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "words_beside";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mine.yaml") << english("continue", "continue: Onwards");
  const Protocol beside = parseProtocol(protocolText(kYesNo + kBox + "words: mine.yaml\n"),
                                        (folder / "study.yaml").string(), exampleCatalogue());
  EXPECT_EQ(beside.words["continue"], "Onwards");
}

TEST(VisibleTexts, AreThoseThatParticipantsRead) {
  const Protocol protocol = exampleProtocol(R"(task:
  type: yes_no
  question: "Q\u00e9?"
  answers: [si, no]
  severity: {question: how, labels: [little, much]}
form: [{name: age, label: Your age, choices: [young, old]}]
)" + kBox + "# a comment\n");
  std::map<std::string, std::string> texts;
  for (const VisibleText& text : visibleTexts(protocol)) texts[text.key] += text.text + "|";
  EXPECT_EQ(texts["task.question"], "Q\u00e9?|");
  EXPECT_EQ(texts["task.answers"], "si|no|");
  EXPECT_EQ(texts["task.severity.labels"], "little|much|");
  EXPECT_EQ(texts["form.label"], "Your age|");
  EXPECT_EQ(texts["texts.consent"], "I agree.|");
  EXPECT_EQ(texts["pause_title"], "Pause|");
  EXPECT_FALSE(texts.count("title"));
}

TEST(VisibleTexts, CharactersAreNamedWithTheirPlace) {
  const Protocol protocol =
      exampleProtocol(std::string("task: {type: yes_no, question: \"Seen \u3042\u3044?\"}\n") + kBox +
                      "# \u3046 in a comment is nobody's business\n");
  const auto said = [&](const std::u32string& lacking) -> std::string {
    try {
      refuseCharacters(protocol, lacking, "install a font");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(said(U""), "");
  EXPECT_EQ(said(U"\u3046"), "");
  // `task: {type: yes_no, question: "Seen ` has 37 characters.
  EXPECT_THAT(said(U"\u3044"), AllOf(HasSubstr("test.yaml:1:39: '\u3044' (U+3044) in 'task.question'"),
                                     HasSubstr("install a font"), Not(HasSubstr("3042"))));
}

TEST(VisibleTexts, CodePointsAndBack) {
  const std::string text = "a\u00e9\u3042\U0001F600";
  const std::u32string points = codePoints(text);
  EXPECT_EQ(points, U"a\u00e9\u3042\U0001F600");
  std::string back;
  for (const char32_t c : points) back += toUtf8(c);
  EXPECT_EQ(back, text);
  EXPECT_EQ(codePoints("a\xC3"), U"a\uFFFD");
}

}  // namespace
}  // namespace limen::study
