// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/session/front_end.h"

/// What may go into the store. No filter can tell every name or address from harmless text, so no typed text
/// is stored at all: a form's answers come from the protocol's declared choices, of free text only the length
/// is kept, and the experimenter's notes are codes from a closed list. Only the codes of participant and
/// session are typed, in a form that rules out an address, an e-mail or a date; that a code is not somebody's
/// name is the experimenter's responsibility.
namespace limen::study {

/// Letters, digits, - and _, 16 at most, and nothing that looks like a date (six or eight digits, in a row or
/// separated). `thing`: "participant", for the message. Throws Error, which does not repeat the text.
void checkCode(const std::string& code, const std::string& thing);

/// Data of the ScreenDone event: {screen, part, block, answers, note}. Fields that the form does not declare
/// and choices that it does not offer are dropped; `answers` of a field without choices and `note` become
/// {"given": true, "length": characters}.
nlohmann::json screenData(const Protocol& protocol, const Screen& screen, const ScreenResult& result);

/// Codes of notes that an experimenter may add, each with what it means.
const std::vector<std::pair<std::string, std::string>>& experimenterNotes();
/// Throws Error for a code that is not in the list.
void checkExperimenterNote(const std::string& code);
/// The code itself, or "other" for what is not in the list.
std::string noteCode(const std::string& text);
/// Who stopped a session, as the log names them: "experimenter", "system" or "participant".
std::string stopper(const std::string& by);

}  // namespace limen::study
