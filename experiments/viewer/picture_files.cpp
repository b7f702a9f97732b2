// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/picture_files.h"

#include "experiments/base/replace_file.h"
#include "experiments/viewer/export_descriptor.h"
#include "experiments/viewer/results_folder.h"

namespace limen::viewer {

std::string writePictures(const std::map<std::string, ProductImages>& images, const ViewSetup& setup,
                          const std::string& folder) {
  makeFolder(folder);
  const std::filesystem::path into = freshName(folder, "pictures", "");
  makeFolder(into);
  const std::string about = setup.technique.name + " on " + setup.scene.name;
  for (const auto& [name, image] : images) {
    if (image.values) writeExr((into / (name + ".exr")).string(), *image.values, name + ": " + about);
    if (image.picture) writePng((into / (name + ".png")).string(), *image.picture, name + ": " + about);
  }
  replaceFile((into / "descriptor.yaml").string(), descriptorOf(setup));
  return into.string();
}

}  // namespace limen::viewer
