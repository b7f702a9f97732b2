// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "study/protocol/protocol.h"

namespace limen::study {

/// A text that participants read, and where it was written.
struct VisibleText {
  std::string file, key;  ///< key: "texts.consent", "task.answers"
  Mark mark;              ///< of its first character, or of the block that it is
  std::string text;
};

/// All of a protocol and of its words.
std::vector<VisibleText> visibleTexts(const Protocol& protocol);

/// Code points of UTF-8; what is not UTF-8 counts as U+FFFD.
std::u32string codePoints(const std::string& text);
std::string toUtf8(char32_t character);

/// Refuses a protocol that shows any of `lacking`: one Error with a line for each character, with its place.
void refuseCharacters(const Protocol& protocol, const std::u32string& lacking, const std::string& hint);

}  // namespace limen::study
