// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/protocol/example.h"

#include "experiments/base/error.h"

namespace limen::study {

std::shared_ptr<const Declarations> exampleDeclarations() {
  static const auto kDeclarations = [] {
    auto out = std::make_shared<Declarations>();
    out->scenes["box"] = {
        3,
        {realParameter("distance", 5, 0.5, 50, "m", ""), integerParameter("tile", 0, 0, 63, "", ""),
         choiceParameter("kind", "wood", {"wood", "stone"}, ""), booleanParameter("textured", true, "")}};
    out->scenes["model"] = {1, {fileParameter("file", "")}};
    out->techniques["fast"] = {
        2, {integerParameter("quality", 3, 1, 10, "", ""), choiceParameter("pattern", "8", {"8", "16"}, "")}};
    out->techniques["exact"] = {1, {}};
    out->shading = {realParameter("ambient", 0.2, 0, 1, "", "")};
    return out;
  }();
  return kDeclarations;
}

std::string protocolText(const std::string& partKeys) {
  return partKeys + R"(
title: Test
question: Does it work?
display: schwarz_2009
texts: {consent: I agree., instructions: Look.}
)";
}

Protocol exampleProtocol(const std::string& partKeys) {
  return parseProtocol(protocolText(partKeys), "test.yaml", exampleDeclarations());
}

std::string refusal(const std::string& text) {
  try {
    parseProtocol(text, "test.yaml", exampleDeclarations());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace limen::study
