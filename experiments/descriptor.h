// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/catalogue.h"
#include "experiments/base/entry_reader.h"
#include "experiments/executor.h"

namespace limen::experiments {

/// An entry of `scenes` or `techniques`, or the reference. Parameters that are not given take their defaults.
struct Entry {
  std::string name;
  std::vector<Axis> axes;  ///< in order of writing
  Mark mark;
};

struct ImageAxes {
  std::vector<std::pair<int, int>> sizesPx;  ///< width and height
  Mark mark;
};

/// Selects planned runs by parameter value, by path: technique parameters, then scene parameters, then
/// `width` and `height`.
using Selection = std::map<std::string, ParameterValue>;

/// A statement about measured values that the sweep evaluates when it ends.
struct ExpectationStatement {
  enum class Relation { Below, Above, Equals };
  std::string metric;
  std::string technique, scene;  ///< "" for any
  Selection where;
  Relation relation = Relation::Below;
  double bound = 0.0;  ///< with `relativeTo`, a factor applied to that run's value

  /// The run to compare with: the same scene and image size except as stated here; of several runs of another
  /// technique, the one that shares the evaluated run's values of the parameters common to both.
  struct Baseline {
    std::string technique;  ///< "" for the evaluated run's own
    std::string scene;      ///< "" for the evaluated run's own
    Selection where;
  };
  std::optional<Baseline> relativeTo;

  std::string text;  ///< "rmse of soft_shadows/bitmask where pattern=regular_8 below 0.01"
  Mark mark;
};

/// A published table, to compare with what the sweep measures.
struct PublishedTable {
  struct Row {
    std::string name;
    std::vector<std::optional<double>> values;  ///< one for each column
    std::string technique, scene;               ///< "" for any
    Selection where;
    std::string relativeTo;           ///< name of the row that ratios are relative to; "": none
    std::vector<std::string> passes;  ///< whose times are summed; empty: the table's `measure` counts
    Mark mark;
  };
  std::string title, source, device, note, unit;
  std::vector<std::string> columns;
  std::string measure;
  std::vector<std::string> passes;
  std::vector<Row> rows;
  Mark mark;
};

/// An experiment as its author wrote it, checked against the catalogue.
struct Descriptor {
  std::string path, text, hash;  ///< hash: SHA-256 of the text
  std::string title, question, source;
  std::vector<std::string> features;
  std::vector<Entry> scenes, techniques;
  std::optional<Entry> reference;
  std::vector<ImageAxes> images;
  Timing timing;
  Artefacts artefacts;
  std::vector<Configuration> metrics;
  std::vector<std::string> metricNames;  ///< of the measurements that `metrics` yield, in order
  nlohmann::json report =
      nlohmann::json::object();  ///< x, y, series, panels; fit: names with commas, if given
  std::vector<ExpectationStatement> expectations;
  std::vector<PublishedTable> published;
  std::map<std::string, std::string>
      fileHashes;  ///< resolved path of each named file -> SHA-256 of its content
  std::map<std::string, std::string> filesAsNamed;  ///< resolved path -> path as written in the descriptor
};

/// Reads and checks a descriptor. `features` are the known feature ids. Throws one Error with a line
/// "file:line:column: what was found; what is allowed" for each problem; writes nothing.
Descriptor readDescriptor(const std::string& path, const Catalogue& catalogue,
                          const std::set<std::string>& features);

/// Like readDescriptor(), for a text already in memory; `path` names it and is the base of relative file
/// names.
Descriptor parseDescriptor(const std::string& text, const std::string& path, const Catalogue& catalogue,
                           const std::set<std::string>& features);

}  // namespace limen::experiments
