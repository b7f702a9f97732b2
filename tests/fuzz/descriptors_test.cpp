// SPDX-License-Identifier: BSD-3-Clause
// Descriptors, protocols, examples and other YAML, read with everything that is registered.
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/yaml_tree.h"
#include "experiments/descriptor.h"
#include "experiments/features.h"
#include "experiments/plan.h"
#include "experiments/viewer/saved_views.h"
#include "perception/vision/display.h"
#include "renderer/catalogue.h"
#include "renderer/scene/camera_path_file.h"
#include "study/example/example.h"
#include "study/observers/simulation.h"
#include "study/protocol/describe.h"
#include "tests/fuzz/rounds.h"

#include <gtest/gtest.h>

namespace limen::fuzz {
namespace {

TEST(Fuzz, Descriptors) {
  const auto catalogue = catalogueFromRegistries();
  const std::set<std::string> features = experiments::knownFeatures(LIMEN_SOURCE_DIR);
  expectRobust({.name = "descriptor",
                .extension = ".yaml",
                .corpus = shippedFiles("experiments/descriptors", ".yaml"),
                .mutate = mutateYaml,
                .read =
                    [&](const std::string& path) {
                      const experiments::Descriptor descriptor =
                          experiments::readDescriptor(path, *catalogue, features);
                      experiments::makePlan(descriptor, *catalogue);
                    },
                .rounds = 1500});
}

TEST(Fuzz, Protocols) {
  const auto catalogue = catalogueFromRegistries();
  expectRobust({.name = "protocol",
                .extension = ".yaml",
                .corpus = shippedFiles("study/protocols", ".yaml"),
                .mutate = mutateYaml,
                .read =
                    [&](const std::string& path) {
                      const study::Protocol protocol = study::readProtocol(path, catalogue);
                      const study::Design design = study::makeDesign(protocol, 1, 0);
                      study::describe(protocol, design, 1, 0);
                    },
                .rounds = 1000});
}

TEST(Fuzz, Examples) {
  expectRobust({.name = "example",
                .extension = ".yaml",
                .corpus = shippedFiles("study/examples", ".yaml"),
                .mutate = mutateYaml,
                .read = [](const std::string& path) { study::readExample(path); },
                .rounds = 1000});
}

TEST(Fuzz, Features) {
  const std::string all = readTextFile(LIMEN_SOURCE_DIR "/experiments/features.yaml");
  expectRobust({.name = "features",
                .extension = ".yaml",
                .corpus = {all.substr(0, all.find("\n- {", 4000) + 1)},
                .mutate = mutateYaml,
                .read = [](const std::string& path) { experiments::readFeatures(path); },
                .rounds = 1000});
}

TEST(Fuzz, Displays) {
  std::vector<std::string> corpus;
  for (const std::string& name : perception::displayPresets())
    corpus.push_back(perception::toYaml(perception::displayPreset(name)));
  expectRobust({.name = "display",
                .extension = ".yaml",
                .corpus = corpus,
                .mutate = mutateYaml,
                .read = [](const std::string& path) { perception::readDisplay(path); },
                .rounds = 2000});
}

TEST(Fuzz, CameraPaths) {
  const std::string path =
      "camera_path:\n  - {time_s: 0, eye: [0, 1, 5], target: [0, 0, 0], up: [0, 1, 0], fov_deg: 45}\n"
      "  - {time_s: 1.5, eye: [1, 1, 5], target: [0, 0.5, 0]}\n  - {time_s: 2, eye: [2, 1, 5], target: [0, "
      "0, 0]}\n";
  expectRobust({.name = "camera_path",
                .extension = ".yaml",
                .corpus = {path},
                .mutate = mutateYaml,
                .read =
                    [](const std::string& file) {
                      const scene::CameraPath read = scene::readCameraPath(file);
                      // What is read can be written and read again.
                      if (scene::toYaml(scene::parseCameraPath(scene::toYaml(read), "copy")) !=
                          scene::toYaml(read))
                        throw Violation{"a camera path that is written is another one"};
                    },
                .rounds = 2000});
}

TEST(Fuzz, SavedViews) {
  const std::string views =
      "views:\n  - {name: \"feet of the columns\", scene: columns_hall, camera: \"eye 0 1 5 target 0 0 0\"}\n"
      "  - {name: b, scene: palm, camera: \"eye 0 1 5 target 0 0 0 up 0 1 0 fov 45\"}\n";
  expectRobust({.name = "views",
                .extension = ".yaml",
                .corpus = {views},
                .mutate = mutateYaml,
                .read = [](const std::string& path) { viewer::readSavedViews(path); },
                .rounds = 2000});
}

}  // namespace
}  // namespace limen::fuzz
