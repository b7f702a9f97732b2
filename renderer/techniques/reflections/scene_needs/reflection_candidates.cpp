// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/scene_needs/reflection_candidates.h"

#include <algorithm>
#include <cmath>

#include "renderer/frame/mirror_rays.h"

namespace limen::techniques {
namespace {

using Given = std::map<std::string, ParameterValue>;

const char *const kPlanar = "reflections/planar_mirror", *const kMap = "reflections/environment_map",
                  *const kScreenSpace = "reflections/screen_space",
                  *const kVertices = "reflections/vertex_reflection", *const kRays = "reflections/ray_traced",
                  *const kHierarchy = "reflections/ray_hierarchy", *const kCones = "reflections/cone_traced";

ParameterValue choice(const char* name) { return std::string(name); }

enum class For { All, Glossy };

/// A candidate in one line.
struct Row {
  const char* technique;
  Given given = {};
  For mirrors = For::All;  ///< Glossy: tried only where any mirror is
};

Given lobe(double glossRad) {
  return {{"prefilter", choice("lobe")}, {"prefilter.exponent", lobeExponent(glossRad)}};
}

std::vector<Row> rows(double glossRad) {
  return {{kMap, {{"resolution", int64_t{64}}}},
          {kMap},
          {kMap, {{"lookup", choice("finite")}}},
          {kMap, {{"lookup", choice("depth")}}},
          {kMap, {{"lookup", choice("depth")}, {"resolution", int64_t{1024}}}},
          {kMap, lobe(glossRad), For::Glossy},
          {kScreenSpace},
          {kPlanar, {{"planes", int64_t{1}}}},
          {kPlanar},
          {kPlanar, {{"planes", int64_t{16}}}},
          {kVertices, {{"tessellation", choice("even")}, {"invalid", choice("drop")}}},
          {kVertices, {{"surroundings", choice("environment")}}},
          {kVertices},
          {kRays},
          {kRays, {{"tree", choice("rebuilt")}}},
          {kRays, {{"tree", choice("refitted")}}},
          {kHierarchy},
          {kCones}};
}

/// What departs from the defaults.
Given departures(const ReflectionCommon& common) {
  const Given usual = ReflectionCommon::table().write({});
  Given out;
  for (const auto& [path, value] : ReflectionCommon::table().write(common)) {
    const auto found = usual.find(path);
    if (found == usual.end() || !(found->second == value)) out.emplace(path, value);
  }
  return out;
}

void complete(Candidate& candidate, const Given& common) {
  const TechniqueInfo* info = TechniqueRegistry::instance().find(candidate.technique);
  if (!info) return;
  for (const auto& [path, value] : common)
    if (takes(*info, path)) candidate.given.emplace(path, value);
}

Candidate completed(Candidate candidate, const ReflectionCommon& common) {
  complete(candidate, departures(common));
  return candidate;
}

Image mirrorMask(frame::Frame& frame) {
  const Image origins = frame.get<frame::MirrorRays>().origins().read();
  Image out(origins.width, origins.height, 1);
  for (size_t i = 0; i < out.pixels(); ++i) out.data[i] = origins.data[4 * i + 3];
  return out;
}

}  // namespace

const SettingsTable<ReflectionCommon>& ReflectionCommon::table() {
  using S = ReflectionCommon;
  static const SettingsTable<S> kTable = {included(&S::path), frame::shadingBinding(&S::shading)};
  return kTable;
}

std::vector<Candidate> builtInReflections(double glossRad, const ReflectionCommon& common) {
  std::vector<Candidate> out;
  for (const Row& row : rows(glossRad))
    if (row.mirrors == For::All || glossRad > 0.0)
      out.push_back(completed({row.technique, row.given}, common));
  return out;
}

std::vector<Candidate> readReflections(const std::string& path, const ReflectionCommon& common) {
  const Given given = departures(common);
  return readCandidateFile(path, {.product = ProductKind::Colour,
                                  .chooser = "reflections/scene_needs",
                                  .example = "- {name: reflections/environment_map, resolution: [64, 256]}",
                                  .complete = [&](Candidate& candidate) { complete(candidate, given); }});
}

Candidate filteredMap(double glossRad, const ReflectionCommon& common) {
  return completed({kMap, lobe(glossRad)}, common);
}

Candidate candidateForNeed(ReflectorNeed need, int planes, double glossRad, const scene::Scene& scene,
                           const ReflectionCommon& common) {
  const auto of = [&]() -> Candidate {
    switch (need) {
      case ReflectorNeed::Cones:
        if (TechniqueRegistry::instance().find(kCones)) return {kCones, {}};
        return {kMap, lobe(glossRad)};
      case ReflectorNeed::PlanarMirror:
        return {kPlanar, {{"planes", int64_t{planes}}}};
      case ReflectorNeed::Map:
        return {kMap, {}};
      case ReflectorNeed::Tracer:
        return {kRays, {}};
      case ReflectorNeed::Vertices:
        // The map of far surroundings is made once.
        if (!scene.motions.empty()) return {kVertices, {}};
        return {kVertices, {{"surroundings", choice("environment")}}};
      case ReflectorNeed::RayHierarchy:
        break;
    }
    return {kHierarchy, {}};
  };
  return completed(of(), common);
}

Candidate candidateFor(const RuleVerdict& verdict, double glossRad, const scene::Scene& scene,
                       const ReflectionCommon& common) {
  return candidateForNeed(verdict.all.need, verdict.planes, glossRad, scene, common);
}

NeedsSubject reflectionSubject(bool glossy, const ReflectionCommon& common) {
  return {.reference =
              [glossy, common](int samples, int64_t seed) {
                Candidate out{"reflections/reference", {}};
                if (glossy)
                  out = {"reflections/distribution_traced",
                         {{"places", int64_t{samples}}, {"directions", int64_t{4}}, {"seed", seed}}};
                return completed(std::move(out), common);
              },
          .exact = !glossy,
          .samples = "places per pixel",
          .mask = mirrorMask,
          .depicts = perception::Depicts::Light};
}

double lobeExponent(double glossRad) {
  const double square = 1.0 - std::cos(glossRad);
  return square > 0.0 ? std::clamp(2.0 / square - 2.0, 1.0, 1000.0) : 1000.0;
}

}  // namespace limen::techniques
