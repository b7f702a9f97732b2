// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/store/descriptions.h"

#include <algorithm>
#include <set>

#include "experiments/base/text.h"
#include "experiments/store/rows.h"

namespace limen::store {
namespace {

// Text that is not a direction can only come from another program; the direction is then unknown.
std::optional<Direction> directionOf(const std::string& text) {
  for (const auto& entry : enumNames(Direction{}).entries)
    if (entry.name == text) return entry.value;
  return std::nullopt;
}

}  // namespace

const QuantityRow* Descriptions::quantity(const std::string& name) const {
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const QuantityRow& row) { return row.name == name; });
  return found == quantities.end() ? nullptr : &*found;
}

void writeDescriptions(sqlite3* database, int64_t experiment, const Descriptions& descriptions) {
  execute(database, "DELETE FROM quantity WHERE experiment = ?", experiment);
  execute(database, "DELETE FROM parameter WHERE experiment = ?", experiment);
  Statement quantity(database,
                     "INSERT INTO quantity (experiment, name, title, unit, direction, kind, pass, source) "
                     "VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  for (const QuantityRow& row : descriptions.quantities)
    quantity
        .bind(experiment, row.name, row.title, row.unit,
              std::string(toText(row.direction.value_or(Direction::Neither))), row.kind, row.pass, row.source)
        .execute();
  Statement parameter(database,
                      "INSERT INTO parameter (experiment, subject, owner, path, exists_when, title, unit, "
                      "type, default_value, description, source) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const ParameterRow& row : descriptions.parameters)
    parameter
        .bind(experiment, row.subject, row.owner, row.path, row.when.dump(), row.title, row.unit, row.type,
              row.defaultValue, row.description, row.source)
        .execute();
}

Descriptions readDescriptions(sqlite3* database, int64_t experiment) {
  Descriptions out;
  Statement tables(database, "SELECT 1 FROM sqlite_schema WHERE name = 'quantity'");
  if (!tables.step()) return out;
  Statement quantity(database,
                     "SELECT name, title, unit, direction, kind, pass, source FROM quantity WHERE experiment "
                     "= ? ORDER BY rowid");
  quantity.bind(experiment);
  while (quantity.step())
    out.quantities.push_back({quantity.text(0), quantity.text(1), quantity.text(2),
                              directionOf(quantity.text(3)), quantity.text(4), quantity.text(5),
                              quantity.text(6)});
  Statement parameter(database,
                      "SELECT subject, owner, path, exists_when, title, unit, type, default_value, "
                      "description, source FROM parameter WHERE experiment = ? ORDER BY rowid");
  parameter.bind(experiment);
  while (parameter.step())
    out.parameters.push_back({parameter.text(0), parameter.text(1), parameter.text(2),
                              parseJson(parameter, 3, JsonIs::Object), parameter.text(4), parameter.text(5),
                              parameter.text(6), parameter.text(7), parameter.text(8), parameter.text(9)});
  return out;
}

Descriptions joinDescriptions(Descriptions ours, const Descriptions& theirs) {
  for (const QuantityRow& row : theirs.quantities)
    if (ours.quantity(row.name) == nullptr) ours.quantities.push_back(row);
  for (const ParameterRow& row : theirs.parameters)
    if (std::none_of(ours.parameters.begin(), ours.parameters.end(), [&](const ParameterRow& own) {
          return own.subject == row.subject && own.owner == row.owner && own.path == row.path &&
                 own.when == row.when;
        }))
      ours.parameters.push_back(row);
  return ours;
}

Descriptions Store::descriptions(int64_t experiment) const {
  Transaction snapshot(database_, Transaction::Mode::Read);
  Descriptions out = readDescriptions(database_, experiment);
  Statement measured(database_,
                     "SELECT m.name, m.unit, m.kind FROM experiment_run e JOIN run r ON r.key = e.key JOIN "
                     "measurement m ON m.run = r.id WHERE e.experiment = ? GROUP BY m.name ORDER BY m.name");
  measured.bind(experiment);
  while (measured.step())
    if (out.quantity(measured.text(0)) == nullptr)
      out.quantities.push_back(formerQuantity(measured.text(0), measured.text(1), measured.text(2)));
  return out;
}

}  // namespace limen::store
