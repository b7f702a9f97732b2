// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace limen {

/// Writes `text` to `path` through a temporary file beside it that is renamed once it is on the disk:
/// whatever happens meanwhile, `path` holds all of the old text or all of the new. `check`, if any, gets the
/// temporary's path before the old text goes; what it throws leaves the old text in place. Throws Error.
void replaceFile(const std::string& path, const std::string& text,
                 const std::function<void(const std::string&)>& check = {});

}  // namespace limen
