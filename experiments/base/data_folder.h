// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// Folder, laid out like the source tree, with the files that programs read by name at run time: descriptors
/// and features, protocols, words and examples of studies. Of an installed program (PREFIX/lib/limen/NAME) it
/// is PREFIX/share/limen, wherever PREFIX is; of one that was built and not installed, the source tree.
std::string dataFolder();

}  // namespace limen
