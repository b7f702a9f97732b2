// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {

/// Name of an installed Chromium; "" if there is none.
std::string findBrowser();

/// Opens a page in a window of `size` ("1280,1600") and returns what `script` finds in it: a <script> that
/// appends <pre id="probe"> with JSON. `window.problems` has the page's errors by then.
nlohmann::json probe(const std::string& browser, const TemporaryFolder& folder, const std::string& page,
                     const std::string& script, const std::string& size);

/// Draws a page's first screen into a PNG file.
void drawPage(const std::string& browser, const TemporaryFolder& folder, const std::string& page,
              const std::string& size, const std::string& png);

}  // namespace limen::analysis
