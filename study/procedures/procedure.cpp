// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/procedure.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "study/procedures/details.h"
#include "study/procedures/model.h"
#include "study/procedures/settings_reader.h"

namespace limen::study {
namespace {

struct ProcedureType {
  const char* name;
  ProcedureSettings (*read)(SettingsReader&);
  const char* (*describe)();
};

constexpr ProcedureType kTypes[] = {{"constant", readConstant, describeConstant},
                                    {"staircase", readStaircase, describeStaircase},
                                    {"quest", readQuest, describeQuest},
                                    {"psi", readPsi, describePsi},
                                    {"quest_plus", readQuestPlus, describeQuestPlus},
                                    {"interleaved", readInterleaved, describeInterleaved}};

}  // namespace

Procedure::~Procedure() = default;
ProcedureDetail::~ProcedureDetail() = default;

ProcedureSettings readProcedure(const nlohmann::json& settings, const std::string& where) {
  SettingsReader reader(settings, where);
  std::vector<std::string> names;
  for (const ProcedureType& type : kTypes) names.emplace_back(type.name);
  reader.required("type", "one of " + join(names));
  const std::string name = reader.choiceOr("type", "", names);
  const auto type =
      std::find_if(std::begin(kTypes), std::end(kTypes), [&](const auto& t) { return name == t.name; });
  return type->read(reader);
}

nlohmann::json toJson(const ProcedureSettings& settings) {
  nlohmann::json out = settings.detail->toJson();
  out["type"] = settings.type;
  return out;
}

std::unique_ptr<Procedure> makeProcedure(const ProcedureSettings& settings, uint64_t seed) {
  return settings.detail->make(seed);
}

std::string describeProcedures() {
  std::string out = "Types of procedure, with their keys:\n\n";
  for (const ProcedureType& type : kTypes) out += std::string(type.describe()) + "\n";
  return out + describeModels();
}

}  // namespace limen::study
