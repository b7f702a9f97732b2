// SPDX-License-Identifier: BSD-3-Clause
// Exports against the rules of the published Psych-DS schema 1.x: https://github.com/psych-ds/psych-DS
// (schema) and https://github.com/psych-ds/psychds-validator, src/setup/defaultSchema.json, whose codes are
// named here. The validator itself is a Deno program that no package registry here has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/study/export/exported_study.h"

namespace limen {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;

/// Cells of a CSV file by RFC 4180; "CSV_FORMATTING_ERROR" in `out` if it is none.
std::vector<std::vector<std::string>> cellsOf(const std::string& text, std::set<std::string>& out) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!quoted && c == '\n') {
      rows.push_back({""});
    } else if (quoted || c != '\r') {
      rows.back().back() += c;
    }
  }
  if (quoted) out.insert("CSV_FORMATTING_ERROR");
  if (rows.back() == std::vector<std::string>{""}) rows.pop_back();
  return rows;
}

/// Columns that a description declares: names as text or as PropertyValue objects.
std::set<std::string> declaredIn(const json& description) {
  std::set<std::string> out;
  if (!description.contains("variableMeasured")) return out;
  for (const json& variable : description["variableMeasured"])
    out.insert(variable.is_string() ? variable.get<std::string>() : variable.value("name", ""));
  return out;
}

void checkData(const fs::path& file, const std::set<std::string>& declared, std::set<std::string>& out) {
  static const std::regex kName(R"(([a-z]+-[a-zA-Z0-9]+)(_[a-z]+-[a-zA-Z0-9]+)*_data\.csv)");
  static const std::set<std::string> kKeywords = {"study", "site",      "subject",  "session",    "task",
                                                  "trial", "condition", "stimulus", "description"};
  const std::string name = file.filename();
  if (!std::regex_match(name, kName)) out.insert("FILENAME_KEYWORD_FORMATTING_ERROR");
  const std::regex pair("([a-z]+)-[a-zA-Z0-9]+");
  for (auto at = std::sregex_iterator(name.begin(), name.end(), pair); at != std::sregex_iterator(); ++at)
    if (!kKeywords.count((*at)[1])) out.insert("FILENAME_UNOFFICIAL_KEYWORD_WARNING");
  const auto rows = cellsOf(test::contentOf(file), out);
  if (rows.empty() || rows[0] == std::vector<std::string>{""}) {
    out.insert("CSV_HEADER_MISSING");
    return;
  }
  std::set<std::string> seen, ids;
  for (const std::string& column : rows[0]) {
    if (!seen.insert(column).second) out.insert("CSV_HEADER_REPEATED");
    if (!declared.count(column)) out.insert("CSV_COLUMN_MISSING_FROM_METADATA");
  }
  for (const auto& row : rows)
    if (row.size() != rows[0].size()) out.insert("CSV_HEADER_LENGTH_MISMATCH");
  for (size_t i = 0; i < rows[0].size(); ++i)
    for (size_t r = 1; rows[0][i] == "row_id" && r < rows.size(); ++r)
      if (!ids.insert(rows[r].at(i)).second) out.insert("ROWID_VALUES_NOT_UNIQUE");
}

/// Objects below a schema.org property have a type each.
void checkTypes(const json& value, std::set<std::string>& out) {
  if (value.is_object() && !value.contains("@type") && !value.contains("@value") && !value.contains("@id"))
    out.insert("OBJECT_TYPE_MISSING");
  if (value.is_structured())
    for (const json& item : value) checkTypes(item, out);
}

/// Codes of all that the schema objects to.
std::set<std::string> objections(const fs::path& folder) {
  std::set<std::string> out;
  if (!fs::exists(folder / "README.md") && !fs::exists(folder / "README.txt"))
    out.insert("MISSING_README_DOC");
  if (!fs::is_directory(folder / "data")) out.insert("MISSING_DATA_DIRECTORY");
  if (!fs::exists(folder / "dataset_description.json")) return out.insert("MISSING_DATASET_DESCRIPTION"), out;
  const json description = json::parse(test::contentOf(folder / "dataset_description.json"), nullptr, false);
  if (!description.is_object()) return out.insert("INVALID_JSON_FORMATTING"), out;
  for (const char* key : {"name", "description", "variableMeasured"})
    if (!description.contains(key)) out.insert("JSON_KEY_REQUIRED");
  const std::string context = description.value("@context", "");
  if (context != "https://schema.org/" && context != "http://schema.org/") out.insert("JSON_KEY_REQUIRED");
  if (!description.contains("@type"))
    out.insert("MISSING_DATASET_TYPE");
  else if (description["@type"] != "Dataset")
    out.insert("INCORRECT_DATASET_TYPE");
  // Properties that schema.org has of a Dataset, as far as used here.
  static const std::set<std::string> kProperties = {"@context",      "@type",   "name",   "description",
                                                    "schemaVersion", "license", "author", "variableMeasured"};
  for (const auto& [key, value] : description.items())
    if (!kProperties.count(key)) out.insert("INVALID_SCHEMAORG_PROPERTY");
  static const std::set<std::string> kOfValues = {"@type", "name",           "description", "unitText",
                                                  "value", "valueReference", "minValue",    "maxValue"};
  for (const json& variable : description.value("variableMeasured", json::array())) {
    checkTypes(variable, out);
    for (const auto& [key, value] : variable.items())
      if (variable.is_object() && !kOfValues.count(key)) out.insert("INVALID_SCHEMAORG_PROPERTY");
  }
  const std::set<std::string> declared = declaredIn(description);
  size_t dataFiles = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    if (entry.file_size() == 0) out.insert("FILE_EMPTY");
    const fs::path relative = entry.path().lexically_relative(folder);
    const bool data = *relative.begin() == "data" && relative.extension() == ".csv";
    if (data) {
      ++dataFiles;
      checkData(entry.path(), declared, out);
    } else if (relative != "README.md" && relative != "dataset_description.json") {
      out.insert("FILE_NOT_CHECKED");
    }
  }
  if (dataFiles == 0) out.insert("MISSING_DATAFILE");
  return out;
}

TEST(PsychDs, ExportsKeepTheRulesOfItsSchema) {
  for (const char* protocol : {"quick", "threshold_2ifc"}) {
    const test::ExportedStudy study(protocol);
    EXPECT_THAT(objections(study.folder("psych_ds")), IsEmpty()) << protocol;
  }
}

TEST(PsychDs, PlantedMistakesAreFound) {
  const auto after = [](const std::function<void(const fs::path&)>& spoil) {
    const test::ExportedStudy study("quick");
    spoil(study.folder("psych_ds"));
    return objections(study.folder("psych_ds"));
  };
  const auto description = [](const std::function<void(json&)>& change) {
    return [change](const fs::path& folder) {
      json value = json::parse(test::contentOf(folder / "dataset_description.json"));
      change(value);
      std::ofstream(folder / "dataset_description.json") << value;
    };
  };
  EXPECT_THAT(after(description([](json& value) { value.erase("name"); })), ElementsAre("JSON_KEY_REQUIRED"));
  EXPECT_THAT(after(description([](json& value) { value.erase("@type"); })),
              ElementsAre("MISSING_DATASET_TYPE"));
  EXPECT_THAT(after(description([](json& value) { value["variableMeasured"].erase(0); })),
              ElementsAre("CSV_COLUMN_MISSING_FROM_METADATA"));
  EXPECT_THAT(
      after([](const fs::path& folder) { std::ofstream(folder / "data/Subject_1.csv") << "subject\n1\n"; }),
      ElementsAre("FILENAME_KEYWORD_FORMATTING_ERROR"));
  EXPECT_THAT(after([](const fs::path& folder) {
                std::ofstream(folder / "data/study-x_data.csv") << "subject,subject\n1\n";
              }),
              ElementsAre("CSV_HEADER_LENGTH_MISMATCH", "CSV_HEADER_REPEATED"));
  EXPECT_THAT(after([](const fs::path& folder) { fs::remove_all(folder / "data"); }),
              ElementsAre("MISSING_DATAFILE", "MISSING_DATA_DIRECTORY"));
}

}  // namespace
}  // namespace limen
