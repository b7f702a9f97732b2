// SPDX-License-Identifier: BSD-3-Clause
// How scenes of curved triangles are told their form.
#pragma once

#include <variant>

#include "renderer/scene/scene.h"
#include "renderer/surfaces/pn_set.h"

namespace limen::scene {

// Middle control points of the normal field; see surfaces::PnNormals.
struct LinearNormals {
  static constexpr const char *kKind = "linear", *kSummary = "mean of the ends' normals";
};
struct VlachosNormals {
  static constexpr const char *kKind = "vlachos", *kSummary = "the mean reflected at the edge, unit";
};
struct VanOverveldWyvillNormals {
  static constexpr const char *kKind = "van_overveld_wyvill", *kSummary = "van Overveld and Wyvill's";
};
struct FarinNormals {
  static constexpr const char *kKind = "farin", *kSummary = "Farin's";
  bool halfH = false;
  static const SettingsTable<FarinNormals>& table();
};
struct CorrectedFarinNormals {
  static constexpr const char *kKind = "corrected_farin",
                              *kSummary = "the thesis', exact in the middle of edges";
  bool halfH = false;
  static const SettingsTable<CorrectedFarinNormals>& table();
};
struct LeeJenNormals {
  static constexpr const char *kKind = "lee_jen", *kSummary = "vlachos at inflections, linear elsewhere";
};
using NormalsChoice = std::variant<LinearNormals, VlachosNormals, VanOverveldWyvillNormals, FarinNormals,
                                   CorrectedFarinNormals, LeeJenNormals>;
surfaces::PnSettings pnSettings(const NormalsChoice& normals);

struct PnForm {
  static constexpr const char *kKind = "pn", *kSummary = "cubic PN triangles with a normal field of degree 2";
  NormalsChoice normals;
  static const SettingsTable<PnForm>& table();
};

struct PhongForm {
  static constexpr const char *kKind = "phong", *kSummary = "Phong tessellation: quadratic triangles";
  double alpha = 0.75;
  static const SettingsTable<PhongForm>& table();
};

struct SmoothedForm {
  static constexpr const char *kKind = "smoothed", *kSummary = "smoothed N-patches by the side-vertex method";
  int pieces = 2;
  static const SettingsTable<SmoothedForm>& table();
};

struct Png1Form {
  static constexpr const char *kKind = "png1",
                              *kSummary = "PN triangles moved into common tangent planes along their sides";
  int pieces = 2;
  static const SettingsTable<Png1Form>& table();
};

struct TaggedPnForm {
  static constexpr const char *kKind = "tagged_pn", *kSummary = "PN triangles with scalar tags at creases";
  double angleDeg = 40.0, sharpness = 0.5, bias = 0.0, tension = 0.0;
  static const SettingsTable<TaggedPnForm>& table();
};

// What happens at edges with a large angle between their triangles.
struct SmoothEdges {
  static constexpr const char *kKind = "none", *kSummary = "all edges are smooth";
};
struct CreaseEdges {
  static constexpr const char *kKind = "followed", *kSummary = "boundaries follow creases";
  double angleDeg = 40.0;
  static const SettingsTable<CreaseEdges>& table();
};
struct GapEdges {
  static constexpr const char *kKind = "gaps", *kSummary = "neighbours part at creases";
  double angleDeg = 40.0;
  static const SettingsTable<GapEdges>& table();
};
using EdgesChoice = std::variant<SmoothEdges, CreaseEdges, GapEdges>;

struct CreasedPnForm {
  static constexpr const char *kKind = PnForm::kKind, *kSummary = PnForm::kSummary;
  NormalsChoice normals;
  EdgesChoice creases;
  static const SettingsTable<CreasedPnForm>& table();
};

/// How triangles become curved; for meshes without and with creases.
using CurvedForm = std::variant<PnForm, PhongForm, SmoothedForm, Png1Form>;
using CreasedForm = std::variant<CreasedPnForm, PhongForm, SmoothedForm, Png1Form, TaggedPnForm>;

/// A scene's parameter for it.
template <class S, class Form>
Binding<S> formBinding(Form S::*member) {
  return {member, "primitive", "How the base triangles become curved", "Schwarz 2009, section 6.1.3"};
}

/// Corner normals are given.
surfaces::PatchSet curvedSet(const surfaces::BaseMesh& mesh, const CurvedForm& form);
/// Corner normals are computed; positions must be merged.
surfaces::PatchSet curvedSet(surfaces::BaseMesh mesh, const CreasedForm& form);

}  // namespace limen::scene
