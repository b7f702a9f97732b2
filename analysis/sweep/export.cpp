// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/report.h"

#include <filesystem>
#include <map>
#include <set>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/sweep/grouping.h"
#include "analysis/sweep/power_law.h"
#include "analysis/sweep/printed_tables.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

using Row = std::vector<std::string>;

std::string number(const std::optional<double>& value) { return value ? shortestNumber(*value) : ""; }

// What names a run in every table.
Row identity(const store::Run& run) { return {run.key, run.device, run.technique, run.scene, run.label}; }
const Row kIdentity = {"key", "device", "technique", "scene", "label"};

Row joined(Row left, const Row& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

std::string csvOf(const Row& header, const std::vector<Row>& rows) {
  std::string text = csvLine(header);
  for (const Row& row : rows) text += csvLine(row);
  return text;
}

void write(const std::string& folder, const std::string& name, const Row& header,
           const std::vector<Row>& rows) {
  writeFileBytes((std::filesystem::path(folder) / name).string(), csvOf(header, rows));
}

std::vector<const store::Run*> allRuns(const Sweep& sweep) {
  std::vector<const store::Run*> runs;
  for (const Cell& cell : sweep.cells) runs.push_back(&cell.run);
  for (const store::Run& run : sweep.failed) runs.push_back(&run);
  return runs;
}

/// The data dictionary: what the columns of runs.csv and the names in measurements.csv mean.
void exportDictionary(const Sweep& sweep, const std::string& folder) {
  std::vector<Row> quantities, parameters;
  for (const store::QuantityRow& q : sweep.names.descriptions().quantities)
    quantities.push_back(
        {q.name, q.title, q.unit, q.direction ? toText(*q.direction) : "unknown", q.kind, q.pass, q.source});
  for (const store::ParameterRow& p : sweep.names.descriptions().parameters)
    // The values of metrics' parameters stand in one column, "metrics".
    parameters.push_back({p.subject == "metric" ? "metrics" : p.subject + "." + p.path, p.subject, p.owner,
                          p.path, p.when.empty() ? "" : p.when.dump(), p.title, p.unit, p.type,
                          p.defaultValue, p.description, p.source});
  write(folder, "quantities.csv", {"name", "title", "unit", "direction", "kind", "pass", "source"},
        quantities);
  write(folder, "parameters.csv",
        {"column", "subject", "owner", "path", "exists_when", "title", "unit", "type", "default",
         "description", "source"},
        parameters);
}

}  // namespace

std::string runsCsv(const Sweep& sweep) {
  const std::vector<const store::Run*> runs = allRuns(sweep);
  std::set<std::string> parameters;
  Row measurements;
  for (const store::Run* run : runs) {
    for (const auto& [path, value] : flatParameters(*run)) parameters.insert(path);
    for (const store::Measurement& m : run->measurements) indexIn(measurements, m.name);
  }
  const Row times = {"n_frames",     "frame_median_ms", "frame_low95_ms", "frame_high95_ms",
                     "frame_p95_ms", "frame_min_ms",    "frame_mean_ms",  "frame_sd_ms"};
  Row header = joined(kIdentity, {"status", "error", "started", "finished"});
  header = joined(header, Row(parameters.begin(), parameters.end()));
  header = joined(joined(header, measurements), times);

  std::vector<Row> rows;
  for (size_t index = 0; index < runs.size(); ++index) {
    const store::Run& run = *runs[index];
    Row row = joined(identity(run), {run.status, run.error, run.started, run.finished});
    const std::map<std::string, std::string> values = flatParameters(run);
    for (const std::string& path : parameters) {
      const auto found = values.find(path);
      row.push_back(found == values.end() ? "" : found->second);
    }
    for (const std::string& name : measurements) row.push_back(number(measurementOf(run, name)));
    if (index < sweep.cells.size() && sweep.cells[index].frame) {
      const Summary& s = *sweep.cells[index].frame;
      const std::optional<MedianInterval>& i = sweep.cells[index].interval;
      row = joined(row,
                   {std::to_string(s.n), number(s.median), i ? number(i->low) : "", i ? number(i->high) : "",
                    number(s.p95), number(s.minimum), number(s.mean), number(s.standardDeviation)});
    } else {
      row.resize(row.size() + times.size());
    }
    rows.push_back(std::move(row));
  }
  return csvOf(header, rows);
}

void exportTables(const Sweep& sweep, const std::string& folder) {
  writeFileBytes((std::filesystem::path(folder) / "runs.csv").string(), runsCsv(sweep));
  exportDictionary(sweep, folder);
  std::vector<Row> measurements, frameTimes, passes;
  for (const store::Run* run : allRuns(sweep)) {
    for (const store::Measurement& m : run->measurements)
      measurements.push_back(joined(identity(*run), {m.name, m.kind, number(m.value), m.unit}));
    for (const store::FrameTime& t : run->frameTimes)
      frameTimes.push_back({run->key, run->device, std::to_string(t.frame), std::to_string(t.round), t.pass,
                            std::to_string(t.nanoseconds)});
  }
  for (const Cell& cell : sweep.cells)
    for (const PassRow& row : passRows(cell))
      passes.push_back(joined(identity(cell.run),
                              {row.pass, std::to_string(row.bytesHeld), row.ms ? number(row.ms->median) : "",
                               row.ms ? number(row.ms->p95) : "", row.ms ? std::to_string(row.ms->n) : ""}));
  write(folder, "measurements.csv", joined(kIdentity, {"name", "kind", "value", "unit"}), measurements);
  write(folder, "frame_times.csv", {"key", "device", "frame", "round", "pass", "nanoseconds"}, frameTimes);
  write(folder, "passes.csv", joined(kIdentity, {"pass", "bytes_held", "median_ms", "p95_ms", "n_frames"}),
        passes);
  if (const std::vector<Scaling> scalings = findScalings(sweep); !scalings.empty())
    writeFileBytes((std::filesystem::path(folder) / "scalings.csv").string(),
                   toCsv(tableOf(sweep, scalings)));
  if (const auto published = comparePrinted(sweep); !published.empty())
    writeFileBytes((std::filesystem::path(folder) / "published.csv").string(), printedCsv(published));
}

}  // namespace limen::analysis
