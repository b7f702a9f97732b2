// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/base/parameter_list.h"
#include "experiments/base/registry.h"
#include "experiments/base/settings_table.h"
#include "renderer/scene/item_stream.h"
#include "renderer/scene/material.h"
#include "renderer/scene/part_motion.h"
#include "renderer/surfaces/nurbs.h"
#include "renderer/surfaces/patch_set.h"
#include "renderer/surfaces/subdivision_surface.h"

namespace limen::scene {

/// A run of triangles with one material.
struct Part {
  std::string name;
  uint32_t firstTriangle = 0, triangleCount = 0;
  uint32_t material = 0;
  /// Lies beneath or behind everything and never shadows another part (a ground plane); shadow maps are
  /// fitted to the other parts only. It is drawn into shadow maps nevertheless.
  bool receiverOnly = false;
};

/// Indexed triangles in world space. Positions are double so that a scene far from the origin loses no
/// precision; on the GPU they are relative to an anchor near the geometry.
struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;  ///< vertex indices; counter-clockwise seen from outside
  /// Empty or one per vertex: unit, outward; the zero vector if a vertex has none (its triangles are flat).
  std::vector<glm::vec3> normals;
  /// Empty or one per vertex; Material::surface says what it means.
  std::vector<glm::vec4> attributes;
  /// Empty or one per vertex: where the vertex lies once its level has become the next coarser one; its own
  /// position if it does not move.
  std::vector<glm::dvec3> morphTargets;
};

/// Uniform bicubic B-spline patch over (u, v) in [0,1]^2: control point i + 4 j belongs to the i-th basis
/// function in u and the j-th in v.
struct BicubicPatch {
  std::array<glm::dvec3, 16> points{};
};

enum class LightShape { Rectangle, Disc, Polygon };

/// Part of a light with one colour: a simple polygon in unit light coordinates, counter-clockwise.
struct LightPart {
  std::vector<glm::dvec2> outline;  ///< in [0,1]^2; empty: the whole shape
  glm::vec3 radiance{1.0F};
};

/// Planar one-sided area light. Light space: origin at `centre`, x along `axisX`, y along `axisY`, z along
/// `direction()` = cross(axisX, axisY), into the lit half-space. Unit light coordinates: (x, y) / size + 1/2.
struct AreaLight {
  LightShape shape = LightShape::Rectangle;
  glm::dvec3 centre{0.0};
  glm::dvec3 axisX{1.0, 0.0, 0.0}, axisY{0.0, 1.0, 0.0};  ///< unit, perpendicular
  glm::dvec2 size{1.0};  ///< full extents of the bounding rectangle, world units
  std::vector<glm::dvec2>
      outline;  ///< Polygon only: vertices in unit light coordinates, counter-clockwise, simple
  std::vector<LightPart> parts{{}};

  glm::dvec3 direction() const { return glm::cross(axisX, axisY); }
  /// True if the unit light coordinates lie on the light (boundary included).
  bool contains(glm::dvec2 unit) const;
  /// Area in world units squared.
  double area() const;
  /// World position of unit light coordinates.
  glm::dvec3 point(glm::dvec2 unit) const {
    return centre + axisX * ((unit.x - 0.5) * size.x) + axisY * ((unit.y - 0.5) * size.y);
  }
  /// World to light space; translation is relative to `anchor` (the result applies to position - anchor).
  glm::dmat4 toLightSpace(glm::dvec3 anchor = glm::dvec3(0.0)) const;
};

struct Camera {
  glm::dvec3 eye{0.0, 0.0, 5.0}, target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double verticalFovDeg = 45.0;
};

/// Key-framed camera, times in seconds, ascending. Positions by centripetal-free cubic Hermite (Catmull-Rom
/// tangents), clamped at both ends; one key is a still camera.
struct CameraPath {
  struct Key {
    double timeS = 0.0;
    Camera camera;
  };
  std::vector<Key> keys;
  /// If true, the camera already moves before the first key as it does there, so that a path's first frame
  /// has a predecessor; otherwise it rests.
  bool runIn = false;
  Camera at(double timeS) const;
  double durationS() const { return keys.empty() ? 0.0 : keys.back().timeS - keys.front().timeS; }
};

struct Bounds {
  glm::dvec3 low{1e300}, high{-1e300};
  void extend(glm::dvec3 point) { low = glm::min(low, point), high = glm::max(high, point); }
  bool empty() const { return low.x > high.x; }
  glm::dvec3 centre() const { return 0.5 * (low + high); }
  double diagonal() const { return empty() ? 0.0 : glm::length(high - low); }
};

/// A run of triangles of a scene, numbered through Scene::mesh and on through Scene::coarser.
struct TriangleRange {
  uint32_t first = 0, count = 0;
};

/// One level of detail of a placed object.
struct LodLevel {
  uint32_t firstTriangle = 0;  ///< in Scene::mesh for level 0, in Scene::coarser for all others
  uint32_t triangleCount = 0;
  /// Largest distance found between this level and the finest, world units: two-sided Hausdorff distance
  /// sampled at vertices and random points; 0 for level 0.
  double deviation = 0.0;
  /// Error stated by the level's maker, world units; its meaning depends on the maker (see lod_set.h).
  double statedError = 0.0;
};

/// An object with levels of detail, placed in the world. All levels have the material of its part.
struct LodObject {
  std::string name;
  uint32_t part = 0;             ///< of Scene::parts: its triangles are level 0
  std::vector<LodLevel> levels;  ///< finest first, at least one
  /// Ascending, one fewer than levels: level i + 1 is shown from switchDistances[i] on (distance from the eye
  /// to the middle of `bounds`, world units). Set by hand, as in Schwarz 2009, section 10.3.5.
  std::vector<double> switchDistances;
  Bounds bounds;  ///< of all levels
};

/// A part that is one NURBS surface.
struct NurbsPart {
  surfaces::NurbsSurface surface;
  uint32_t part = 0;        ///< of Scene::parts
  uint32_t firstPatch = 0;  ///< of Scene::surfaces: its Bézier patches, row by row
};

/// A world to render. Built by a registered scene; constant afterwards.
struct Scene {
  std::string name;
  Mesh mesh;
  std::vector<Part> parts;
  std::vector<Material> materials;
  std::vector<AreaLight> lights;
  CameraPath camera;
  std::vector<BicubicPatch> patches;
  /// Curved surfaces. `mesh` holds a tessellation of each of their parts, so that renderers that know
  /// triangles alone render the scene as well.
  surfaces::PatchSet surfaces;
  std::vector<NurbsPart> nurbs;  ///< that some of `surfaces` come from
  /// Control meshes of subdivision surfaces. `mesh`, and `surfaces` if it has any of their part, hold what
  /// stands in for them.
  std::vector<surfaces::SubdivisionSurface> subdivisions;
  /// Objects that come in several levels of detail. `mesh` holds their finest level, so that renderers
  /// without LOD support render the finest scene; parts that belong to no object are background.
  std::vector<LodObject> lodObjects;
  Mesh coarser;                     ///< all other levels; its triangles index its own vertices
  std::optional<ItemStream> items;  ///< for techniques of streams, which render nothing
  /// Parts that move; `mesh` holds them at rest. At most one of a part; scenes with LOD objects have none.
  std::vector<PartMotion> motions;

  Bounds bounds() const;        ///< of all finite positions, wherever they move
  Bounds casterBounds() const;  ///< of parts that are not receiverOnly
  /// SHA-256 over the exact bytes of everything that determines a picture: geometry, parts, materials,
  /// lights, camera; no names.
  std::string contentHash() const;
  TriangleRange triangles(const LodObject& object, int level) const;
  /// What the scene has, for techniques that need it: "area_light"; of the first light "rectangular_light",
  /// "disc_light" or "polygonal_light" if it has a uniform colour, otherwise "multi_part_light";
  /// "several_lights", "moving_camera", "lod_sets", "casters", "receiver_only_parts", "curved_surfaces",
  /// "nurbs", "subdivision_surfaces", "trimmed_surfaces", "moving_surfaces", "moving_parts", "item_stream";
  /// of its parts' materials "mirrors" (any that reflect), "glossy_materials", "refractive_materials",
  /// "emissive_materials".
  std::set<std::string> traits() const;
};

/// Registration of a scene. `parameters` are its own, without those of every scene (PlacementSettings, see
/// placement.h).
struct SceneInfo {
  static constexpr const char* kKind = "scene";
  std::string name;
  int version = 1;  ///< raised when the built scene changes
  std::string summary;
  std::string source;
  ParameterList parameters = {};
  std::function<Scene(const ParameterValues&)> build = {};
  /// Throws Error if its own values contradict each other; null: they cannot.
  std::function<void(const ParameterValues&)> check = {};

  /// Own parameters followed by those of every scene.
  std::vector<Parameter> allParameters() const;
  /// Throws Error if values of allParameters() contradict each other or the camera cannot be used. Reads the
  /// file of a camera path.
  void checkValues(const ParameterValues& complete) const;
};
using SceneRegistry = Registry<SceneInfo>;

/// For scenes without parameters of their own.
struct NoSettings {
  static const SettingsTable<NoSettings>& table();
};

/// Registers a scene that is built from settings S (settings_table.h) at program start. `info` provides the
/// rest; its parameters, build and check are filled in.
template <class S>
struct RegisteredScene {
  RegisteredScene(SceneInfo info, Scene (*build)(const S&), const S& defaults = {}) {
    info.parameters = ParameterList([defaults] { return S::table().parameters(defaults); });
    info.build = [build](const ParameterValues& values) { return build(S::table().read(values)); };
    info.check = [](const ParameterValues& values) { S::table().read(values); };
    SceneRegistry::instance().add(std::move(info));
  }
};

/// Builds a registered scene and places it (placement.h); what `values` leaves out takes its default.
/// The parts of the result tile its triangles in order. Throws Error.
Scene buildScene(const std::string& name, const ParameterValues& values);

}  // namespace limen::scene
