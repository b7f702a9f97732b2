// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/replace_file.h"

namespace limen {

void replaceFile(const std::string& path, const std::string& text,
                 const std::function<void(const std::string&)>& check, Readers readers) {
  PartFile part(path, readers);
  part.write(text);
  part.close();
  if (check) check(part.path());
  part.putInPlace();
}

}  // namespace limen
