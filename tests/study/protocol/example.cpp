// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/protocol/example.h"

#include "experiments/base/error.h"
#include "tests/experiments/base/declare.h"

namespace limen::study {

std::shared_ptr<const Catalogue> exampleCatalogue() {
  static const auto kCatalogue = [] {
    auto out = std::make_shared<Catalogue>();
    out->scenes["box"] = {.version = 3,
                          .parameters = {realParameter("distance", 5, 0.5, 50, "m", ""),
                                         integerParameter("tile", 0, 0, 63, "", ""),
                                         choiceParameter("kind", "wood", {"wood", "stone"}, ""),
                                         booleanParameter("textured", true, "")}};
    out->scenes["model"] = {.parameters = {fileParameter("file", "")}};
    out->techniques["fast"] = {.version = 2,
                               .parameters = {integerParameter("quality", 3, 1, 10, "", ""),
                                              choiceParameter("pattern", "8", {"8", "16"}, "")}};
    out->techniques["exact"] = {};
    out->shading = {realParameter("ambient", 0.2, 0, 1, "", "")};
    return out;
  }();
  return kCatalogue;
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
  return parseProtocol(protocolText(partKeys), "test.yaml", exampleCatalogue());
}

std::string refusal(const std::string& text) {
  try {
    parseProtocol(text, "test.yaml", exampleCatalogue());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace limen::study
