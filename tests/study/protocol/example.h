// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "study/protocol/design.h"

namespace limen::study {

/// Scene "box" (distance, tile, kind, textured, label), techniques "fast" (quality, pattern) and "exact".
std::shared_ptr<const Catalogue> exampleCatalogue();

/// A protocol with the given keys of its only part besides title, question, display and texts. `partKeys`
/// begin on line 1.
std::string protocolText(const std::string& partKeys);
Protocol exampleProtocol(const std::string& partKeys);

/// Message of the Error that reading gives; "" if there is none.
std::string refusal(const std::string& text);

inline const std::string kYesNo = R"(task: {type: yes_no, question: "Seen?"}
)";
inline const std::string kBox = R"(stimulus:
  scene: {name: box}
  levels: {before: 1, after: 0}
)";

}  // namespace limen::study
