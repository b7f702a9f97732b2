// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/curved/pn_parameters.h"

#include "renderer/surfaces/scalar_tags.h"
#include "renderer/surfaces/smooth_triangles.h"

namespace limen::scene {
namespace {

const char* const kHalfH = "Half of h in place of h, so that a flat triangle's normals are all of one length";
constexpr Range kAngles{1.0, 179.0};
const char* const kAngleHelp = "Edges with at least this angle between their triangles are creases";

const char* const kPiecesHelp = "Cubic patches along each side of a triangle, which interpolate its surface";

const char* const kNormalsHelp = "Middle control points of the normal field";

}  // namespace

const SettingsTable<FarinNormals>& FarinNormals::table() {
  static const SettingsTable<FarinNormals> kTable = {{&FarinNormals::halfH, "half_h", kHalfH}};
  return kTable;
}

const SettingsTable<CorrectedFarinNormals>& CorrectedFarinNormals::table() {
  static const SettingsTable<CorrectedFarinNormals> kTable = {
      {&CorrectedFarinNormals::halfH, "half_h", kHalfH}};
  return kTable;
}

const SettingsTable<PnForm>& PnForm::table() {
  static const SettingsTable<PnForm> kTable = {{&PnForm::normals, "normals", kNormalsHelp}};
  return kTable;
}

const SettingsTable<PhongForm>& PhongForm::table() {
  static const SettingsTable<PhongForm> kTable = {
      {&PhongForm::alpha,
       "alpha",
       {0.0, 1.0},
       "",
       "Share of the way to the tangent planes; 0: flat triangles",
       "Boubekeur and Alexa 2008"}};
  return kTable;
}

const SettingsTable<SmoothedForm>& SmoothedForm::table() {
  static const SettingsTable<SmoothedForm> kTable = {
      {&SmoothedForm::pieces, "pieces", {1, 4}, "", kPiecesHelp}};
  return kTable;
}

const SettingsTable<Png1Form>& Png1Form::table() {
  static const SettingsTable<Png1Form> kTable = {{&Png1Form::pieces, "pieces", {1, 4}, "", kPiecesHelp}};
  return kTable;
}

const SettingsTable<TaggedPnForm>& TaggedPnForm::table() {
  using S = TaggedPnForm;
  static const SettingsTable<S> kTable = {
      {&S::angleDeg, "angle_deg", kAngles, "deg", kAngleHelp},
      {&S::sharpness, "sharpness", {0.0, 1.0}, "", "Share of the angle at creases that is kept; 0: smooth"},
      {&S::bias, "bias", {-1.0, 1.0}, "", "Which side of a crease turns more; 0: both alike"},
      {&S::tension, "tension", {0.0, 1.0}, "", "How much tangents are shortened; 1: straight sides"}};
  return kTable;
}

const SettingsTable<CreaseEdges>& CreaseEdges::table() {
  static const SettingsTable<CreaseEdges> kTable = {
      {&CreaseEdges::angleDeg, "angle_deg", kAngles, "deg", kAngleHelp}};
  return kTable;
}

const SettingsTable<GapEdges>& GapEdges::table() {
  static const SettingsTable<GapEdges> kTable = {
      {&GapEdges::angleDeg, "angle_deg", kAngles, "deg", kAngleHelp}};
  return kTable;
}

const SettingsTable<CreasedPnForm>& CreasedPnForm::table() {
  using S = CreasedPnForm;
  static const SettingsTable<S> kTable = {{&S::normals, "normals", kNormalsHelp},
                                          {&S::creases, "creases", "Edges at which normals differ"}};
  return kTable;
}

surfaces::PnSettings pnSettings(const NormalsChoice& normals) {
  using N = surfaces::PnNormals;
  if (const auto* farin = std::get_if<FarinNormals>(&normals)) return {N::Farin, farin->halfH};
  if (const auto* corrected = std::get_if<CorrectedFarinNormals>(&normals))
    return {N::CorrectedFarin, corrected->halfH};
  if (std::holds_alternative<VlachosNormals>(normals)) return {N::Vlachos, false};
  if (std::holds_alternative<VanOverveldWyvillNormals>(normals)) return {N::VanOverveldWyvill, false};
  return {std::holds_alternative<LeeJenNormals>(normals) ? N::LeeJen : N::Linear, false};
}

namespace {

/// What does not depend on creases.
template <class Form>
std::optional<surfaces::PatchSet> smoothForm(const surfaces::BaseMesh& mesh, const Form& form) {
  if (const auto* phong = std::get_if<PhongForm>(&form)) return surfaces::phongSet(mesh, phong->alpha);
  if (const auto* smoothed = std::get_if<SmoothedForm>(&form))
    return surfaces::smoothSet(mesh, surfaces::Smoothing::SideVertex, smoothed->pieces);
  if (const auto* png1 = std::get_if<Png1Form>(&form))
    return surfaces::smoothSet(mesh, surfaces::Smoothing::TangentPlanes, png1->pieces);
  return std::nullopt;
}

}  // namespace

surfaces::PatchSet curvedSet(const surfaces::BaseMesh& mesh, const CurvedForm& form) {
  if (auto set = smoothForm(mesh, form)) return *std::move(set);
  return surfaces::pnSet(mesh, {pnSettings(std::get<PnForm>(form).normals), true});
}

surfaces::PatchSet curvedSet(surfaces::BaseMesh mesh, const CreasedForm& form) {
  if (const auto* tagged = std::get_if<TaggedPnForm>(&form)) {
    tagCornerNormals(mesh, tagged->angleDeg, {tagged->sharpness, tagged->bias});
    return surfaces::pnSet(mesh, {{surfaces::PnNormals::Linear, false, tagged->tension}, true});
  }
  const auto* pn = std::get_if<CreasedPnForm>(&form);
  const auto* follow = pn ? std::get_if<CreaseEdges>(&pn->creases) : nullptr;
  const auto* gaps = pn ? std::get_if<GapEdges>(&pn->creases) : nullptr;
  computeCornerNormals(mesh, follow ? follow->angleDeg : gaps ? gaps->angleDeg : 180.0);
  if (auto set = smoothForm(mesh, form)) return *std::move(set);
  return surfaces::pnSet(mesh, {pnSettings(pn->normals), !gaps});
}

}  // namespace limen::scene
