// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/procedures/procedure.h"

// One reader per type, behind readProcedure(). Each takes settings without `type`, reads all its keys and
// refuses others; each describes its keys for describeProcedures().
namespace limen::study {

class SettingsReader;

ProcedureSettings readConstant(SettingsReader& reader);
ProcedureSettings readStaircase(SettingsReader& reader);
ProcedureSettings readQuest(SettingsReader& reader);
ProcedureSettings readPsi(SettingsReader& reader);
ProcedureSettings readQuestPlus(SettingsReader& reader);
ProcedureSettings readInterleaved(SettingsReader& reader);

const char* describeConstant();
const char* describeStaircase();
const char* describeQuest();
const char* describePsi();
const char* describeQuestPlus();
const char* describeInterleaved();

}  // namespace limen::study
