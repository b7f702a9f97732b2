// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace limen {

/// Writes `text` to `path` through a temporary file beside it that is renamed once it is on disk: whatever
/// happens, `path` holds either all of the old text or all of the new. `check`, if given, gets the temporary
/// file's path before the old text is replaced; if it throws, the old text stays. Throws Error.
void replaceFile(const std::string& path, const std::string& text,
                 const std::function<void(const std::string&)>& check = {});

}  // namespace limen
