// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/export_descriptor.h"

#include <filesystem>
#include <sstream>

#include "experiments/base/replace_file.h"
#include "experiments/base/value_writer.h"
#include "experiments/descriptor.h"
#include "experiments/plan.h"
#include "experiments/viewer/results_folder.h"
#include "renderer/catalogue.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {
namespace {

namespace fs = std::filesystem;

/// Files by their absolute path: a descriptor may lie anywhere.
Entry withAbsoluteFiles(Entry entry, const std::vector<Parameter>& declared) {
  for (auto& [path, value] : entry.given) {
    const Parameter* parameter = findDeclaration(declared, entry, path);
    if (!parameter || parameter->type != ParameterType::File) continue;
    auto& file = std::get<std::string>(value);
    std::error_code failed;
    const fs::path absolute = fs::absolute(file, failed);
    if (!failed && !file.empty()) file = absolute.lexically_normal().string();
  }
  return entry;
}

std::string entryText(const Entry& entry, const std::vector<Parameter>& declared) {
  const std::string parameters = toYaml(declared, withAbsoluteFiles(entry, declared).given);
  return "{name: " + entry.name + (parameters.empty() ? "" : ", " + parameters) + "}";
}

std::string techniqueText(const Entry& entry) { return entryText(entry, techniqueParameters(entry.name)); }

Entry entryOf(const experiments::Configuration& choice, const std::vector<Parameter>& declared) {
  return {choice.name, withoutDefaults(declared, choice.values.all())};
}

}  // namespace

std::string descriptorOf(const ViewSetup& setup) {
  const auto kindOf = [](const Entry& entry) {
    return techniques::TechniqueRegistry::instance().get(entry.name, "technique").product;
  };
  std::ostringstream out;
  out << "title: \"" << setup.technique.name << " on " << setup.scene.name << ", as seen in the viewer\"\n"
      << "question: What does this setup measure?\n"
      << "source: exported from limen view\n"
      << "scenes:\n  - " << entryText(setup.scene, sceneParameters(setup.scene.name)) << "\ntechniques:\n  - "
      << techniqueText(setup.technique) << '\n';
  if (setup.second && !(*setup.second == setup.technique) && kindOf(*setup.second) == kindOf(setup.technique))
    out << "  - " << techniqueText(*setup.second) << '\n';
  if (setup.reference) out << "reference: " << techniqueText(*setup.reference) << '\n';
  out << "image: {width: " << setup.sizePx.x << ", height: " << setup.sizePx.y << "}\n"
      << "timing: {warmup: 8, frames: 64}\n"
      << "metrics: " << (setup.reference ? "[rmse, largest_error]" : "[non_finite]") << '\n'
      << "artefacts: {pictures: true, exr: true}\n";
  return out.str();
}

std::string exportDescriptor(const ViewSetup& setup, const std::string& folder) {
  makeFolder(folder);
  const fs::path path = freshName(folder, "exported", ".yaml");
  const std::string text = descriptorOf(setup);
  // Anything a sweep would refuse is reported now, while the picture is still on screen.
  const Catalogue& catalogue = *catalogueFromRegistries();
  experiments::makePlan(experiments::parseDescriptor(text, path.string(), catalogue, {}), catalogue);
  replaceFile(path.string(), text);
  return path.string();
}

ViewSetup readSetup(const std::string& descriptorPath) {
  const Catalogue& catalogue = *catalogueFromRegistries();
  const experiments::Plan plan =
      experiments::makePlan(experiments::readDescriptor(descriptorPath, catalogue, {}), catalogue);
  const experiments::PlannedRun& run = plan.runs.at(0);
  ViewSetup out;
  out.scene = entryOf(run.scene, sceneParameters(run.scene.name));
  out.technique = entryOf(run.technique, techniqueParameters(run.technique.name));
  if (!run.reference.name.empty())
    out.reference = entryOf(run.reference, techniqueParameters(run.reference.name));
  out.sizePx = {run.widthPx, run.heightPx};
  return out;
}

}  // namespace limen::viewer
