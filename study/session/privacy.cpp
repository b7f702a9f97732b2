// SPDX-License-Identifier: BSD-3-Clause
#include "study/session/privacy.h"

#include <algorithm>
#include <regex>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::study {
namespace {

constexpr size_t kLongestCode = 16;

// Characters of UTF-8, not bytes.
size_t lengthOf(const std::string& text) {
  return static_cast<size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

nlohmann::json lengthAlone(const std::string& text) { return {{"given", true}, {"length", lengthOf(text)}}; }

// 1990-05-17, 17-5-1990, 17_05_90 and months by name; 19900517 and 170590, if they are a valid calendar date.
bool looksLikeDate(const std::string& code) {
  static const std::regex kParted(
      "(^|[^0-9])([0-9]{4}[-_][0-9]{1,2}[-_][0-9]{1,2}|[0-9]{1,2}[-_][0-9]{1,2}[-_]([0-9]{4}|"
      "[0-9]{2}))([^0-9]|$)");
  static const std::regex kNamed(
      "[0-9]{1,2}[-_]?(jan|feb|mar|apr|may|jun|jul|aug|sep|oct|nov|dec)[a-z]*[-_]?[0-9]{2}",
      std::regex::icase);
  static const std::regex kDigits("[0-9]+");
  if (std::regex_search(code, kParted) || std::regex_search(code, kNamed)) return true;
  const auto isDay = [](const std::string& day) { return day >= "01" && day <= "31"; };
  const auto isMonth = [](const std::string& month) { return month >= "01" && month <= "12"; };
  const auto isYear = [](const std::string& year) { return year >= "1900" && year <= "2099"; };
  for (std::sregex_iterator run(code.begin(), code.end(), kDigits), end; run != end; ++run) {
    const std::string digits = run->str();
    const auto part = [&](size_t from, size_t count) { return digits.substr(from, count); };
    if (digits.size() == 8) {
      if (isYear(part(0, 4)) && isMonth(part(4, 2)) && isDay(part(6, 2))) return true;
      if (!isYear(part(4, 4))) continue;
      if (isMonth(part(0, 2)) && isDay(part(2, 2))) return true;
      if (isDay(part(0, 2)) && isMonth(part(2, 2))) return true;
    } else if (digits.size() == 6) {
      if (isMonth(part(2, 2)) && (isDay(part(0, 2)) || isDay(part(4, 2)))) return true;
      if (isMonth(part(0, 2)) && isDay(part(2, 2))) return true;
    }
  }
  return false;
}

nlohmann::json formAnswers(const Protocol& protocol, const nlohmann::json& answers) {
  nlohmann::json out = nlohmann::json::object();
  for (const FormField& field : protocol.form) {
    const auto given = answers.find(field.name);
    if (given == answers.end() || !given->is_string()) continue;
    const std::string text = given->get<std::string>();
    if (field.choices.empty())
      out[field.name] = lengthAlone(text);
    else if (std::find(field.choices.begin(), field.choices.end(), text) != field.choices.end())
      out[field.name] = text;
  }
  return out;
}

}  // namespace

void checkCode(const std::string& code, const std::string& thing) {
  const std::string hint =
      "give a code that identifies nobody, such as p01: letters, digits, - and _, at most " +
      std::to_string(kLongestCode);
  if (code.empty()) throw Error("the " + thing + " has no code", "--" + thing, hint);
  if (code.find('@') != std::string::npos)
    throw Error("the " + thing + "'s code looks like an e-mail address", "--" + thing, hint);
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  if (code.size() > kLongestCode || !std::all_of(code.begin(), code.end(), allowed))
    throw Error("the " + thing + "'s code has forbidden characters, or too many", "--" + thing, hint);
  if (looksLikeDate(code)) throw Error("the " + thing + "'s code looks like a date", "--" + thing, hint);
}

nlohmann::json screenData(const Protocol& protocol, const Screen& screen, const ScreenResult& result) {
  nlohmann::json answers = nlohmann::json::object();
  const nlohmann::json given = result.answers.is_object() ? result.answers : nlohmann::json::object();
  if (screen.kind == Screen::Kind::Form) answers = formAnswers(protocol, given);
  if (screen.kind == Screen::Kind::Consent) {
    const auto consent = given.find("consent");
    answers["consent"] = consent != given.end() && consent->is_boolean() && consent->get<bool>();
  }
  nlohmann::json data = {{"screen", toText(screen.kind)},
                         {"part", screen.part},
                         {"block", screen.block},
                         {"answers", std::move(answers)}};
  if (!result.note.empty()) data["note"] = lengthAlone(result.note);
  return data;
}

const std::vector<std::pair<std::string, std::string>>& experimenterNotes() {
  static const std::vector<std::pair<std::string, std::string>> kNotes = {
      {"interrupted", "the session was interrupted"},
      {"noise", "noise or light from outside"},
      {"glasses", "glasses or lenses were put on or taken off"},
      {"moved", "the viewer moved from the set distance"},
      {"misunderstood", "the task was misunderstood for a while"},
      {"question", "the participant asked about the task"},
      {"tired", "the participant was visibly tired"},
      {"unwell", "the participant felt unwell"},
      {"equipment", "equipment failed"},
      {"wrong_key", "the participant reported pressing wrong keys"},
      {"other", "something else, noted elsewhere"},
  };
  return kNotes;
}

std::string noteCode(const std::string& text) {
  for (const auto& [code, meaning] : experimenterNotes())
    if (code == text) return text;
  return "other";
}

std::string stopper(const std::string& by) {
  return by == "experimenter" || by == "system" ? by : "participant";
}

void checkExperimenterNote(const std::string& code) {
  std::vector<std::string> known;
  for (const auto& [name, meaning] : experimenterNotes()) known.push_back(name);
  if (noteCode(code) != code)
    throw Error("no such note", "note",
                "notes are picked from a list, so that they contain no names: " + join(known));
}

}  // namespace limen::study
