// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/protocol_lettering.h"

#include <set>

#include "study/protocol/visible_texts.h"

namespace limen::study {

window::UiLettering letteringFor(const Protocol& protocol) {
  std::set<char32_t> characters;
  for (const VisibleText& text : visibleTexts(protocol))
    for (const char32_t c : codePoints(text.text))
      if (c > 0x7E) characters.insert(c);
  return {{characters.begin(), characters.end()}, protocol.font};
}

void checkLettering(const Protocol& protocol) {
  refuseCharacters(
      protocol, window::lackingCharacters(letteringFor(protocol)),
      "install fonts-ipafont-gothic (Japanese), fonts-noto-cjk (Chinese, Japanese, Korean) or fonts-unifont "
      "(most scripts), or name a font file with 'font: FILE'");
}

}  // namespace limen::study
