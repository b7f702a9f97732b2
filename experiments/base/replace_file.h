// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "experiments/base/part_file.h"

namespace limen {

/// Writes `text` to `path` as PartFile does. `check`, if any, gets the hidden file's path before the old text
/// goes; what it throws leaves the old text in place. Throws Error.
void replaceFile(const std::string& path, const std::string& text,
                 const std::function<void(const std::string&)>& check = {}, Readers readers = Readers::Usual);

}  // namespace limen
