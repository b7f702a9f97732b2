// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/observers/example.h"
#include "tests/experiments/base/declare.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>

namespace limen::study {

Protocol boxProtocol(const std::string& keys) {
  static const auto kCatalogue = [] {
    auto out = std::make_shared<Catalogue>();
    out->scenes["box"] = {.parameters = {realParameter("distance", 5, 0.01, 1000, "m", "")}};
    return out;
  }();
  return parseProtocol(keys +
                           "\ntitle: Test\nquestion: Does it work?\ndisplay: schwarz_2009\ntexts: {consent: "
                           "I agree., instructions: Look.}\n",
                       "test.yaml", kCatalogue);
}

Trial trialOf(const Protocol& protocol, bool change, const std::map<std::string, std::string>& condition) {
  for (const PlannedBlock& block : makeDesign(protocol, 1, 0).blocks)
    for (const PlannedTrial& planned : block.trials) {
      if (planned.practice || planned.change != change) continue;
      bool fits = true;
      for (const auto& [name, level] : condition) fits &= planned.condition.at(name) == level;
      if (!fits) continue;
      Trial out;
      out.plan = planned;
      out.number = planned.number;
      return out;
    }
  ADD_FAILURE() << "no such trial";
  return {};
}

TemporaryStore::TemporaryStore() {
  std::string name = (std::filesystem::temp_directory_path() / "limen_observers_XXXXXX").string();
  folder = mkdtemp(name.data());
  path = folder + "/store.sqlite";
}

TemporaryStore::~TemporaryStore() {
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}

}  // namespace limen::study
