// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// Text from elsewhere as a terminal may be given it: line breaks and tabs stay; other control characters
/// (escape sequences begin with one), bytes that are no UTF-8 and marks that turn the direction of writing
/// become \xNN or \uNNNN. Whatever tells of an error passes through this.
std::string printable(const std::string& text);

/// Throws Error if the name of a file that is to be written holds control characters; `where` is the option
/// that it came from.
void requirePlainName(const std::string& name, const std::string& where = {});

}  // namespace limen
