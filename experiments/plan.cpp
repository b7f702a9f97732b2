// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/problems.h"
#include "experiments/base/text.h"
#include "experiments/describe_names.h"
#include "experiments/expectation.h"
#include "experiments/published.h"

namespace limen::experiments {
namespace {

/// One cell of an entry's axes.
struct Variant {
  Configuration choice;
  nlohmann::json values;    ///< as reports show them: files as named in the descriptor
  nlohmann::json identity;  ///< as hashed into the key: files by content
  std::string label;
  size_t entry = 0;
};

uint64_t multiply(uint64_t a, uint64_t b) {
  constexpr uint64_t kMax = std::numeric_limits<uint64_t>::max();
  return b != 0 && a > kMax / b ? kMax : a * b;
}

uint64_t add(uint64_t a, uint64_t b) { return a > std::numeric_limits<uint64_t>::max() - b ? a : a + b; }

uint64_t cells(const Entry& entry) {
  uint64_t count = 1;
  for (const Axis& axis : entry.axes) count = multiply(count, axis.points.size());
  return count;
}

uint64_t cells(const std::vector<Entry>& entries) {
  uint64_t count = 0;
  for (const Entry& entry : entries) count = add(count, cells(entry));
  return count;
}

uint64_t cells(const std::vector<ImageAxes>& images) {
  uint64_t count = 0;
  for (const ImageAxes& axes : images) count = add(count, axes.sizesPx.size());
  return count;
}

std::string describeAxes(const std::vector<Entry>& entries) {
  std::vector<std::string> parts;
  for (const Entry& entry : entries) {
    std::vector<std::string> axes;
    for (const Axis& axis : entry.axes)
      if (axis.points.size() > 1) axes.push_back(fmt::format("{} {}", axis.name, axis.points.size()));
    if (!axes.empty()) parts.push_back(entry.name + ": " + join(axes, " x "));
  }
  return parts.empty() ? "" : " (" + join(parts, "; ") + ")";
}

void checkSize(const Descriptor& descriptor) {
  const uint64_t scenes = cells(descriptor.scenes), techniques = cells(descriptor.techniques),
                 images = cells(descriptor.images);
  const uint64_t runs = multiply(images, multiply(scenes, techniques));
  if (runs <= kMaxRuns) return;
  const bool saturated = runs == std::numeric_limits<uint64_t>::max();
  throw Error(fmt::format("the grid has {}{} runs: {} scenes{} x {} techniques{} x {} image sizes",
                          saturated ? "more than " : "", runs, scenes, describeAxes(descriptor.scenes),
                          techniques, describeAxes(descriptor.techniques), images),
              location(descriptor.path, descriptor.techniques[0].mark),
              fmt::format("at most {} are allowed: shorten an axis or split the descriptor", kMaxRuns));
}

class Planner {
 public:
  Planner(const Descriptor& descriptor, const Catalogue& catalogue)
      : descriptor_(descriptor), catalogue_(catalogue), problems_(descriptor.path) {}

  Plan make() {
    checkSize(descriptor_);
    const std::vector<Variant> scenes = expand(descriptor_.scenes, catalogue_.scenes, "scene");
    const std::vector<Variant> techniques =
        takeTurns(expand(descriptor_.techniques, catalogue_.techniques, "technique"));
    std::optional<Variant> reference;
    if (descriptor_.reference) {
      // None if its values do not go together: a problem then, which is thrown below.
      std::vector<Variant> references = expand({*descriptor_.reference}, catalogue_.techniques, "reference");
      if (!references.empty()) reference = std::move(references[0]);
    }
    const auto sizes = expandImages();
    problems_.throwIfAny();

    common_ = {{"timing", timing()}, {"artefacts", artefacts()}, {"metrics", metrics()}};
    Plan plan;
    plan.runs.reserve(sizes.size() * scenes.size() * techniques.size());
    for (const auto& [width, height] : sizes)
      for (const Variant& scene : scenes) {
        const size_t begin = plan.runs.size();
        for (const Variant& technique : techniques)
          plan.runs.push_back(
              makeRun(plan.runs.size(), technique, scene, reference, width, height, sizes.size() > 1));
        plan.groups.emplace_back(begin, plan.runs.size());
      }
    resolve(descriptor_.expectations, plan.runs, problems_);
    plan.published = resolvePublished(descriptor_.published, plan.runs, problems_);
    problems_.throwIfAny();
    plan.descriptions = describeNames(descriptor_, catalogue_);
    return plan;
  }

 private:
  nlohmann::json timing() const {
    const Timing& timing = descriptor_.timing;
    nlohmann::json out = {{"warmup", timing.warmup},
                          {"frames", timing.frames},
                          {"rounds", timing.rounds},
                          {"batch", timing.batch}};
    // Left out where it is not asked for, so that keys of runs are what they were before it could be.
    if (timing.firstPicture) out["first_picture"] = true;
    return out;
  }

  nlohmann::json artefacts() const {
    return {{"pictures", descriptor_.artefacts.pictures}, {"exr", descriptor_.artefacts.exr}};
  }

  nlohmann::json metrics() const {
    nlohmann::json out = nlohmann::json::array();
    for (const Configuration& metric : descriptor_.metrics) {
      nlohmann::json one = metric.values.toJson();
      one["name"] = metric.name;
      one["version"] = metric.version;
      out.push_back(std::move(one));
    }
    return out;
  }

  std::vector<Variant> expand(const std::vector<Entry>& entries, const CatalogueKind& kind,
                              const char* word) {
    std::vector<Variant> out;
    std::map<std::string, Mark> seen;
    for (size_t index = 0; index < entries.size(); ++index) {
      const Entry& entry = entries[index];
      const CatalogueEntry& info = kind.at(entry.name);
      for (const AxisPoint& given : combine(entry.axes)) {
        Variant variant{
            {entry.name, info.version, ParameterValues(info.parameters, given)}, {}, {}, {}, index};
        if (!goTogether(info, variant.choice.values, entry.mark)) break;
        describeValues(variant, info.parameters);
        const auto [first, fresh] = seen.emplace(variant.identity.dump(), entry.mark);
        if (!fresh && first->second.line >= 0) {
          problems_.add(entry.mark,
                        fmt::format("{} '{}' with the same values is also in line {}: {}", word, entry.name,
                                    first->second.line, variant.values.dump()),
                        "the same run would be planned twice; keep one");
          break;
        }
        out.push_back(std::move(variant));
      }
    }
    setLabels(out);
    return out;
  }

  bool goTogether(const CatalogueEntry& info, const ParameterValues& values, Mark mark) {
    try {
      if (info.check) info.check(values);
      return true;
    } catch (const Error& error) {
      problems_.add(mark, error.message(), error.hint());
      return false;
    }
  }

  void describeValues(Variant& variant, const std::vector<Parameter>& declared) const {
    variant.values = variant.choice.values.toJson();
    nlohmann::json identity = variant.values;
    for (const DeclaredAt& at : chosen(declared, variant.choice.values)) {
      const ParameterValue& value = *variant.choice.values.find(at.path);
      if (at.parameter->keyedIfGiven && value == at.parameter->defaultValue) identity.erase(at.path);
      if (at.parameter->type != ParameterType::File) continue;
      const auto& file = std::get<std::string>(value);
      const auto hash = descriptor_.fileHashes.find(file);
      if (hash == descriptor_.fileHashes.end()) continue;
      variant.values[at.path] = descriptor_.filesAsNamed.at(file);
      identity[at.path] = "sha256:" + hash->second;
    }
    variant.identity = {
        {"name", variant.choice.name}, {"version", variant.choice.version}, {"values", identity}};
  }

  static std::string show(const nlohmann::json& value) {
    if (value.is_string()) return value.get<std::string>();
    return value.is_number_float() ? shortestNumber(value.get<double>()) : value.dump();
  }

  /// A label names the parameters that differ among the variants of one name.
  static void setLabels(std::vector<Variant>& variants) {
    std::map<std::string, std::vector<Variant*>> byName;
    for (Variant& variant : variants) byName[variant.choice.name].push_back(&variant);
    for (auto& [name, group] : byName) {
      std::set<std::string> paths;
      for (const Variant* variant : group)
        for (const auto& [path, value] : variant->values.items()) paths.insert(path);
      for (const std::string& path : paths) {
        // A parameter of some alternatives only distinguishes runs if it differs among those; where it is
        // missing, the choice above it already says so.
        const auto first = std::find_if(group.begin(), group.end(), [&](const Variant* variant) {
          return variant->values.contains(path);
        });
        const auto differs = [&](const Variant* other) {
          return other->values.contains(path) && other->values[path] != (*first)->values[path];
        };
        if (std::none_of(group.begin(), group.end(), differs)) continue;
        for (Variant* variant : group) {
          if (!variant->values.contains(path)) continue;
          if (!variant->label.empty()) variant->label += ", ";
          variant->label += path + "=" + show(variant->values[path]);
        }
      }
    }
  }

  /// One variant of each entry in turn.
  std::vector<Variant> takeTurns(std::vector<Variant> variants) const {
    std::vector<std::vector<Variant>> queues(descriptor_.techniques.size());
    for (Variant& variant : variants) queues[variant.entry].push_back(std::move(variant));
    std::vector<Variant> out;
    for (size_t turn = 0; out.size() < variants.size(); ++turn) {
      const size_t before = out.size();
      for (auto& queue : queues)
        if (turn < queue.size()) out.push_back(std::move(queue[turn]));
      if (out.size() == before) break;
    }
    return out;
  }

  std::vector<std::pair<int, int>> expandImages() {
    std::vector<std::pair<int, int>> out;
    for (const ImageAxes& axes : descriptor_.images)
      for (const std::pair<int, int>& size : axes.sizesPx) {
        if (std::find(out.begin(), out.end(), size) != out.end())
          problems_.add(axes.mark, fmt::format("image size {}x{} is given twice", size.first, size.second),
                        "keep one");
        out.push_back(size);
      }
    return out;
  }

  PlannedRun makeRun(size_t position, const Variant& technique, const Variant& scene,
                     const std::optional<Variant>& reference, int width, int height, bool showSize) const {
    PlannedRun run;
    run.position = static_cast<int>(position);
    run.technique = technique.choice;
    run.scene = scene.choice;
    run.widthPx = width;
    run.heightPx = height;
    run.timing = descriptor_.timing;
    run.artefacts = descriptor_.artefacts;
    run.metrics = descriptor_.metrics;
    run.label = technique.label;
    run.setting = scene.label;
    if (showSize) run.setting += fmt::format("{}{}x{}", run.setting.empty() ? "" : ", ", width, height);

    run.parameters = common_;
    run.parameters["technique"] = technique.values;
    run.parameters["scene"] = scene.values;
    run.parameters["image"] = {{"width", width}, {"height", height}};
    nlohmann::json identity = common_;
    identity["technique"] = technique.identity;
    identity["scene"] = scene.identity;
    identity["image"] = run.parameters["image"];
    if (reference) {
      run.reference = reference->choice;
      run.parameters["reference"] = reference->values;
      run.parameters["reference"]["name"] = reference->choice.name;
      identity["reference"] = reference->identity;
    }
    run.key = sha256(identity.dump());
    return run;
  }

  const Descriptor& descriptor_;
  const Catalogue& catalogue_;
  Problems problems_;
  nlohmann::json common_;
};

}  // namespace

Plan makePlan(const Descriptor& descriptor, const Catalogue& catalogue) {
  return Planner(descriptor, catalogue).make();
}

std::vector<bool> shardMask(const Plan& plan, int index, int count) {
  std::vector<bool> mask;
  mask.reserve(plan.runs.size());
  for (const PlannedRun& run : plan.runs) {
    const uint64_t hash = std::stoull(run.key.substr(0, 16), nullptr, 16);
    mask.push_back(hash % static_cast<uint64_t>(count) == static_cast<uint64_t>(index - 1));
  }
  return mask;
}

std::string describe(const PlannedRun& run) {
  return run.technique.name + (run.label.empty() ? "" : " " + run.label) + ", " + run.scene.name +
         (run.setting.empty() ? "" : " " + run.setting);
}

std::string describeSize(const Descriptor& descriptor, const Plan& plan) {
  const auto plural = [](uint64_t count, const std::string& word) {
    return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
  };
  return fmt::format("{}: {}{} x {}{} x {}", plural(plan.runs.size(), "run"),
                     plural(cells(descriptor.scenes), "scene"), describeAxes(descriptor.scenes),
                     plural(cells(descriptor.techniques), "technique"), describeAxes(descriptor.techniques),
                     plural(cells(descriptor.images), "image size"));
}

}  // namespace limen::experiments
