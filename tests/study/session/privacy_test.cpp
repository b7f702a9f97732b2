// SPDX-License-Identifier: BSD-3-Clause
#include "study/session/privacy.h"

#include <fstream>

#include "tests/study/session/session_fixture.h"

namespace limen::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Codes, OfTheRightShapeAreTaken) {
  for (const std::string code : {"p01", "A-1", "x", "P_2024_a", "0123456789abcdef", "pilot7", "20241399",
                                 "999999", "1", "12345", "K-12-b", "s01_02"})
    EXPECT_EQ(errorOf([&] { checkCode(code, "participant"); }), "no error") << code;
}

TEST(Codes, ThatLookLikeAnAddressADateOrAreTooLongAreRefusedUnrepeated) {
  for (const std::string code :
       {"jo@example.org", "a@b",      "1990-05-17", "17-5-1990", "17_05_90",          "19900517",
        "17051990",       "05171990", "170590",     "900517",    "p-1990-05-17",      "17may1990",
        "3-Feb-88",       "Jo Smith", "jo.smith",   "o'neil",    "0123456789abcdefg", "",
        "größe",          "a/b",      "a\nb"}) {
    const std::string error = errorOf([&] { checkCode(code, "participant"); });
    EXPECT_NE(error, "no error") << code;
    EXPECT_THAT(error, HasSubstr("--participant"));
    if (code.size() > 3) {
      EXPECT_THAT(error, Not(HasSubstr(code)));
    }
  }
}

// Every byte of the files of the store is searched: what was typed is nowhere, not even in free pages or the
// log.
TEST_F(SessionStoreTest, NothingThatIsTypedReachesTheStore) {
  const Protocol protocol = largeProtocol();
  ScriptedFrontEnd frontEnd(protocol);
  const std::vector<std::string> typed = {"Jane Doe", "12 Elm Street", "jane@example.org", "17 May 1990",
                                          "+49 123 456"};
  frontEnd.screenResult = [&](const Screen& screen) {
    ScreenResult result;
    result.answers = {{"consent", true}, {"name", typed[0]}};
    if (screen.kind == Screen::Kind::Form)
      result.answers = {{"age", typed[3]}, {"remarks", typed[1]}, {"e-mail", typed[2]}};
    for (const std::string& text : typed) result.note += text + "; ";
    return result;
  };
  EXPECT_EQ(run(protocol, frontEnd).kind, Step::Kind::Finished);
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    for (const std::string& text : typed)
      EXPECT_EQ(bytes.find(text), std::string::npos) << entry.path() << text;
  }
  store::SessionReader reader(request_.store);
  EXPECT_EQ(reader.sessions()[0].form, nlohmann::json({{"remarks", {{"given", true}, {"length", 13}}}}));
  const std::vector<store::StudyNote> notes = reader.notes(1);
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes[0].author, "participant");
  EXPECT_EQ(notes[0].code, "note_given");
  EXPECT_EQ(notes[0].detail, nlohmann::json({{"given", true}, {"length", 8 + 13 + 16 + 11 + 11 + 5 * 2}}));
}

TEST_F(SessionStoreTest, CodesOfSessionsAreCheckedToo) {
  const Protocol protocol = smallProtocol();
  ScriptedFrontEnd frontEnd(protocol);
  request_.session = "Jane Doe";
  EXPECT_THAT(errorOf([&] { run(protocol, frontEnd); }),
              AllOf(HasSubstr("--session"), Not(HasSubstr("Jane"))));
  EXPECT_FALSE(std::filesystem::exists(request_.store));
}

TEST(Notes, OfTheExperimenterComeFromAList) {
  for (const auto& [code, meaning] : experimenterNotes())
    EXPECT_EQ(errorOf([&, c = code] { checkExperimenterNote(c); }), "no error");
  EXPECT_THAT(errorOf([] { checkExperimenterNote("Jane was late"); }),
              AllOf(HasSubstr("interrupted"), Not(HasSubstr("Jane"))));
}

}  // namespace
}  // namespace limen::study
