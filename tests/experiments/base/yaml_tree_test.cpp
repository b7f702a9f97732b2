// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/yaml_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/base/error.h"

namespace limen {
namespace {

using testing::HasSubstr;

TEST(YamlTree, KeepsOrderQuotingAndPlace) {
  const YamlNode root = parseYaml("b: \"8\"\na:\n  - 8\n  - {x: true}\nc:\n", "f.yaml");
  ASSERT_EQ(root.members.size(), 3U);
  EXPECT_EQ(root.members[0].key.text, "b");
  EXPECT_TRUE(root.find("b")->quoted);
  const YamlNode& list = *root.find("a");
  ASSERT_EQ(list.items.size(), 2U);
  EXPECT_FALSE(list.items[0].quoted);
  EXPECT_EQ(list.items[0].mark.line, 3);
  EXPECT_EQ(list.items[0].mark.column, 5);
  EXPECT_EQ(list.items[1].find("x")->text, "true");
  EXPECT_EQ(root.find("c")->kind, YamlNode::Kind::Null);
  EXPECT_EQ(root.find("missing"), nullptr);
}

TEST(YamlTree, TakesUtf8AndByteOrderMark) {
  const YamlNode root = parseYaml("\xEF\xBB\xBFtitle: Schärfe – 10 µm 𝛼\n", "f.yaml");
  EXPECT_EQ(root.find("title")->text, "Schärfe – 10 µm 𝛼");
}

TEST(YamlTree, DescribesLongTextShortAndWhole) {
  // 100 two-byte letters are cut between letters, never inside one.
  std::string text;
  for (int i = 0; i < 100; ++i) text += "ä";
  const std::string shown = parseYaml("a: x" + text, "f.yaml").find("a")->describe();
  EXPECT_LT(shown.size(), 80U);
  EXPECT_THAT(shown, HasSubstr("ä...'"));
}

TEST(YamlTree, ErrorsAreNeverAnythingButError) {
  // Every prefix and every single-byte change of a small file either parses or is refused with the file's
  // name.
  const std::string text = "a: [1, {b: 'c'}]\nd:\n  - \"e\"\n  - |\n    f\n";
  for (size_t at = 0; at <= text.size(); ++at)
    for (const char byte :
         {'\0', '\t', '{', '[', ']', ':', '&', '*', '!', '"', '\'', '%', '@', '|', '\x80'}) {
      std::string changed = text;
      if (at < text.size()) changed[at] = byte;
      for (const std::string& candidate : {changed, text.substr(0, at) + byte}) {
        try {
          parseYaml(candidate, "f.yaml");
        } catch (const Error& error) {
          EXPECT_THAT(error.what(), HasSubstr("f.yaml:"));
        }
      }
    }
}

TEST(YamlTree, BracketsInCommentsOpenNothing) {
  std::string text;
  for (int i = 0; i < 200; ++i) text += "k" + std::to_string(i) + ": 1  # in [0, 1)\n# and {(\n";
  EXPECT_EQ(parseYaml(text, "f.yaml").members.size(), 200U);
  EXPECT_THROW(parseYaml("a: \"# \" " + std::string(100000, '['), "f.yaml"), Error);
  EXPECT_THROW(parseYaml(std::string(100, '['), "f.yaml"), Error);
}

}  // namespace
}  // namespace limen
