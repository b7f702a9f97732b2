// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/keep.h"

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "experiments/base/error.h"
#include "experiments/base/replace_file.h"
#include "experiments/base/text.h"
#include "experiments/descriptor.h"
#include "experiments/plan.h"
#include "experiments/product.h"
#include "renderer/catalogue.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {
namespace {

namespace fs = std::filesystem;

/// Double-quoted YAML.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string yaml(const ParameterValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text ? quoted(*text) : toText(value);
}

/// Files by their whole path: a descriptor may lie anywhere.
std::string yaml(const Parameter& parameter, const ParameterValue& value) {
  if (parameter.type != ParameterType::File) return yaml(value);
  std::error_code ignored;
  const std::string& name = std::get<std::string>(value);
  const fs::path whole = fs::absolute(name, ignored);
  return quoted(ignored || name.empty() ? name : whole.lexically_normal().string());
}

std::string entry(const Chosen& chosen, const std::vector<Parameter>& declared) {
  std::string out = "{name: " + chosen.name;
  for (const Parameter& parameter : declared) {
    const auto given = chosen.given.find(parameter.name);
    if (given != chosen.given.end()) out += ", " + parameter.name + ": " + yaml(parameter, given->second);
  }
  return out + "}";
}

/// A name in `folder` that is not taken: "STEM_001EXTENSION".
fs::path freshName(const fs::path& folder, const std::string& stem, const std::string& extension) {
  for (int number = 1; number < 100000; ++number) {
    std::ostringstream name;
    name << stem << '_' << std::setw(3) << std::setfill('0') << number << extension;
    if (!fs::exists(folder / name.str())) return folder / name.str();
  }
  throw Error("no free name for another " + stem, folder.string(), "move older files elsewhere");
}

void makeFolder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    throw Error("cannot make this folder: " + failed.message(), folder.string(),
                "choose another one with --results");
}

Chosen withoutDefaults(const experiments::Choice& choice, const std::vector<Parameter>& declared) {
  Chosen out{choice.name, {}};
  for (const Parameter& parameter : declared) give(out, parameter, choice.values.all().at(parameter.name));
  return out;
}

}  // namespace

std::string descriptorOf(const Choices& choices) {
  const techniques::ProductKind kind =
      techniques::TechniqueRegistry::instance().get(choices.technique.name).product;
  const std::vector<Parameter> technique = techniqueParameters(choices.technique.name);
  std::ostringstream out;
  out << "title: "
      << quoted(choices.technique.name + " on " + choices.scene.name + ", as it was seen in the viewer")
      << "\nquestion: What was looked at?\nsource: \"kept from limen view\"\nscenes:\n  - "
      << entry(choices.scene, sceneParameters(choices.scene.name)) << "\ntechniques:\n  - "
      << entry(choices.technique, technique) << '\n';
  if (choices.other && !(*choices.other == choices.technique) &&
      techniques::TechniqueRegistry::instance().get(choices.other->name).product == kind)
    out << "  - " << entry(*choices.other, techniqueParameters(choices.other->name)) << '\n';
  if (choices.reference)
    out << "reference: " << entry(*choices.reference, techniqueParameters(choices.reference->name)) << '\n';
  out << "image: {width: " << choices.sizePx.x << ", height: " << choices.sizePx.y << "}\n"
      << "timing: {warmup: 8, frames: 64}\n"
      << "metrics: " << (choices.reference ? "[rmse, largest_error]" : "[non_finite]") << '\n'
      << "artefacts: {pictures: true, exr: true}\n";
  return out.str();
}

std::string keep(const Choices& choices, const std::string& folder) {
  makeFolder(folder);
  const fs::path path = freshName(folder, "kept", ".yaml");
  const std::string text = descriptorOf(choices);
  // Whatever a sweep would refuse is said now, while the picture is still on screen.
  const Catalogue& catalogue = *catalogueFromRegistries();
  experiments::makePlan(experiments::parseDescriptor(text, path.string(), catalogue, {}), catalogue);
  replaceFile(path.string(), text);
  return path.string();
}

Choices choicesOf(const std::string& descriptorPath) {
  const Catalogue& catalogue = *catalogueFromRegistries();
  const experiments::Plan plan =
      experiments::makePlan(experiments::readDescriptor(descriptorPath, catalogue, {}), catalogue);
  const experiments::PlannedRun& run = plan.runs.at(0);
  Choices out;
  out.scene = withoutDefaults(run.scene, sceneParameters(run.scene.name));
  out.technique = withoutDefaults(run.technique, techniqueParameters(run.technique.name));
  if (!run.reference.name.empty())
    out.reference = withoutDefaults(run.reference, techniqueParameters(run.reference.name));
  out.sizePx = {run.widthPx, run.heightPx};
  return out;
}

std::string writeProducts(const std::map<std::string, ProductImages>& images, const Choices& choices,
                          const std::string& folder) {
  makeFolder(folder);
  const fs::path into = freshName(folder, "pictures", "");
  makeFolder(into);
  const std::string about = choices.technique.name + " on " + choices.scene.name;
  for (const auto& [name, image] : images) {
    if (image.values) writeExr((into / (name + ".exr")).string(), *image.values, name + ": " + about);
    if (image.picture) writePng((into / (name + ".png")).string(), *image.picture, name + ": " + about);
  }
  std::ofstream descriptor(into / "descriptor.yaml");
  descriptor << descriptorOf(choices);
  return into.string();
}

}  // namespace limen::viewer
