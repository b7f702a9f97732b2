// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/base/problems.h"
#include "experiments/descriptor.h"
#include "experiments/executor.h"

namespace limen::experiments {

/// Reads the list under `published` of a descriptor whose scenes, techniques and metrics have been read:
/// published tables to compare with what the sweep measures. A table has `title`, `source`, optionally
/// `device` and `note`, `unit`, `columns` (headings of the printed values), either `measure` (a measurement)
/// or `passes` (whose times are summed) to compare with, and `rows`: `name`, `values` (a number for each
/// column, null where none is printed), `of`, `scene`, `where` (which runs of the sweep these are) and
/// optionally `relative_to` (name of the row that ratios are relative to). `relative_to` of the table applies
/// to all its rows. A row may have its own `passes`.
std::vector<PublishedTable> readPublished(const YamlNode& node, const Descriptor& descriptor,
                                          const Catalogue& catalogue, Problems& problems);

/// The tables with the keys of the planned runs of each row, as JSON for the store. A row that no run
/// matches, or that matches several runs of one scene and image size, becomes a problem.
nlohmann::json resolvePublished(const std::vector<PublishedTable>& tables,
                                const std::vector<PlannedRun>& runs, Problems& problems);

}  // namespace limen::experiments
