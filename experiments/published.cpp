// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/published.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/plan.h"
#include "experiments/selection.h"
#include "experiments/selection_reader.h"

namespace limen::experiments {
namespace {

using Kind = YamlNode::Kind;

class PublishedReader : private SelectionReader {
 public:
  PublishedReader(const Descriptor& descriptor, const Catalogue& catalogue, Problems& problems)
      : SelectionReader(descriptor, catalogue, problems) {}

  std::vector<PublishedTable> readAll(const YamlNode& node) {
    std::vector<PublishedTable> out;
    if (!reader_.isFilledList(node, "'published'",
                              "- {title: ..., source: ..., columns: [...], rows: [...]}"))
      return out;
    for (const YamlNode& item : node.items) out.push_back(readTable(item));
    return out;
  }

 private:
  std::string word(const YamlNode& map, const char* key, bool required) {
    const YamlNode* node = map.find(key);
    if (node) return reader_.values().text(*node, key).value_or("");
    if (required) problems_.add(map.mark, fmt::format("'{}' is missing", key), "give it: text");
    return {};
  }

  std::vector<std::string> words(const YamlNode& map, const char* key) {
    std::vector<std::string> out;
    const YamlNode* node = map.find(key);
    if (!node || !reader_.isFilledList(*node, fmt::format("'{}'", key), "[..., ...]")) return out;
    for (const YamlNode& item : node->items)
      if (const auto text = reader_.values().text(item, key)) out.push_back(*text);
    return out;
  }

  PublishedTable readTable(const YamlNode& item) {
    PublishedTable table;
    table.mark = item.mark;
    if (item.kind != Kind::Map) {
      problems_.add(item.mark, "a published table is " + item.describe(), "write it as a map: {title: ...}");
      return table;
    }
    reader_.checkKeys(
        item, "a published table",
        {"title", "source", "device", "note", "unit", "columns", "measure", "passes", "relative_to", "rows"});
    table.title = word(item, "title", true);
    table.source = word(item, "source", true);
    table.device = word(item, "device", false);
    table.note = word(item, "note", false);
    table.unit = word(item, "unit", false);
    table.columns = words(item, "columns");
    if (!item.find("columns"))
      problems_.add(item.mark, "'columns' of a published table is missing",
                    "give the headings of its values");
    table.measure = readName(item, "measure", quantities_, "measurement");
    table.passes = words(item, "passes");
    const YamlNode* rows = item.find("rows");
    if (!rows) problems_.add(item.mark, "'rows' of a published table is missing", "give a list of rows");
    if (!rows || !reader_.isFilledList(*rows, "'rows'", "- {name: ..., values: [...], of: TECHNIQUE}"))
      return table;
    const std::string relativeTo = word(item, "relative_to", false);
    for (const YamlNode& row : rows->items) readRow(row, relativeTo, table);
    checkBases(table);
    const bool allHavePasses =
        std::all_of(table.rows.begin(), table.rows.end(),
                    [](const PublishedTable::Row& row) { return !row.passes.empty(); });
    if (table.measure.empty() == !allHavePasses)
      problems_.add(item.mark, "a published table needs either 'measure' or 'passes'",
                    "name the measurement, or the passes whose times are compared");
    return table;
  }

  void readRow(const YamlNode& item, const std::string& relativeTo, PublishedTable& table) {
    PublishedTable::Row row;
    row.mark = item.mark;
    if (item.kind != Kind::Map) {
      problems_.add(item.mark, "a row is " + item.describe(),
                    "write it as a map: {name: ..., values: [...]}");
      return;
    }
    reader_.checkKeys(item, "a row", {"name", "values", "of", "scene", "where", "relative_to", "passes"});
    row.name = word(item, "name", true);
    row.technique = readName(item, "of", techniques_, "technique");
    row.scene = readName(item, "scene", scenes_, "scene");
    row.where = readWhere(item, row.technique, row.scene);
    row.relativeTo = item.find("relative_to") ? word(item, "relative_to", false) : relativeTo;
    row.passes = item.find("passes") ? words(item, "passes") : table.passes;
    const YamlNode* values = item.find("values");
    if (!values) problems_.add(item.mark, "'values' of a row is missing", "give the printed numbers");
    if (values && reader_.isFilledList(*values, "'values'", "[1.5, 2.5]")) {
      for (const YamlNode& value : values->items)
        row.values.push_back(value.kind == Kind::Null ? std::nullopt
                                                      : reader_.values().number(value, "values"));
      if (row.values.size() != table.columns.size())
        problems_.add(values->mark,
                      fmt::format("{} values for {} columns", row.values.size(), table.columns.size()),
                      "give one for each column, null where none is printed");
    }
    if (std::any_of(table.rows.begin(), table.rows.end(),
                    [&](const PublishedTable::Row& other) { return other.name == row.name; }))
      problems_.add(item.mark, "row '" + row.name + "' is given twice", "give each a name of its own");
    table.rows.push_back(std::move(row));
  }

  void checkBases(const PublishedTable& table) {
    for (const PublishedTable::Row& row : table.rows) {
      const auto base =
          std::find_if(table.rows.begin(), table.rows.end(),
                       [&](const PublishedTable::Row& other) { return other.name == row.relativeTo; });
      if (!row.relativeTo.empty() && base == table.rows.end())
        problems_.add(row.mark, "'relative_to' names no row: '" + row.relativeTo + "'",
                      "give the name of a row of this table");
    }
  }
};

}  // namespace

std::vector<PublishedTable> readPublished(const YamlNode& node, const Descriptor& descriptor,
                                          const Catalogue& catalogue, Problems& problems) {
  return PublishedReader(descriptor, catalogue, problems).readAll(node);
}

nlohmann::json resolvePublished(const std::vector<PublishedTable>& tables,
                                const std::vector<PlannedRun>& runs, Problems& problems) {
  nlohmann::json out = nlohmann::json::array();
  for (const PublishedTable& table : tables) {
    nlohmann::json rows = nlohmann::json::array();
    for (const PublishedTable::Row& row : table.rows) {
      std::vector<size_t> matched;
      for (size_t i = 0; i < runs.size(); ++i)
        if (matches(runs[i], row.technique, row.scene, row.where)) matched.push_back(i);
      if (matched.empty())
        problems.add(row.mark, "no planned run matches the row '" + row.name + "'",
                     "give 'of' and 'where' as planned");
      nlohmann::json keys = nlohmann::json::array();
      for (const size_t i : matched) {
        const auto twin = std::find_if(matched.begin(), matched.end(), [&](size_t j) {
          return j < i && runs[j].scene.name == runs[i].scene.name && runs[j].widthPx == runs[i].widthPx &&
                 runs[j].heightPx == runs[i].heightPx &&
                 runs[j].scene.values.all() == runs[i].scene.values.all();
        });
        if (twin != matched.end()) {
          problems.add(
              row.mark, "the row '" + row.name + "' matches several runs of one scene",
              "add 'where' until it matches one: " + describe(runs[*twin]) + " or " + describe(runs[i]));
          break;
        }
        keys.push_back(runs[i].key);
      }
      nlohmann::json values = nlohmann::json::array();
      for (const std::optional<double>& value : row.values)
        values.push_back(value ? nlohmann::json(*value) : nlohmann::json());
      rows.push_back({{"name", row.name},
                      {"values", values},
                      {"relative_to", row.relativeTo},
                      {"passes", row.passes},
                      {"runs", keys}});
    }
    out.push_back({{"title", table.title},
                   {"source", table.source},
                   {"device", table.device},
                   {"note", table.note},
                   {"unit", table.unit},
                   {"columns", table.columns},
                   {"measure", table.measure},
                   {"rows", rows}});
  }
  return out;
}

}  // namespace limen::experiments
