// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/curved/pn_parameters.h"

namespace limen::scene {
namespace {

const char* const kHalfH = "Half of h in place of h, so that a flat triangle's normals are all of one length";
constexpr Range kAngles{1.0, 179.0};
const char* const kAngleHelp = "Edges with at least this angle between their triangles are creases";

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

surfaces::PatchSet curvedSet(const surfaces::BaseMesh& mesh, const CurvedForm& form) {
  if (const auto* phong = std::get_if<PhongForm>(&form)) return surfaces::phongSet(mesh, phong->alpha);
  return surfaces::pnSet(mesh, {pnSettings(std::get<PnForm>(form).normals), true});
}

surfaces::PatchSet curvedSet(surfaces::BaseMesh mesh, const CreasedForm& form) {
  const auto* pn = std::get_if<CreasedPnForm>(&form);
  const auto* follow = pn ? std::get_if<CreaseEdges>(&pn->creases) : nullptr;
  const auto* gaps = pn ? std::get_if<GapEdges>(&pn->creases) : nullptr;
  computeCornerNormals(mesh, follow ? follow->angleDeg : gaps ? gaps->angleDeg : 180.0);
  if (!pn) return surfaces::phongSet(mesh, std::get<PhongForm>(form).alpha);
  return surfaces::pnSet(mesh, {pnSettings(pn->normals), !gaps});
}

}  // namespace limen::scene
