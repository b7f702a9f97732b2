// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/field_reader.h"

#include <epoxy/gl.h>

#include <cmath>
#include <numeric>

#include "experiments/base/error.h"
#include "renderer/techniques/visibility_fields/detail_by_size.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
#include "renderer/techniques/visibility_fields/object_tracer.h"
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/sphere_cover.h"

namespace limen::techniques {
namespace vf = visibility_fields;
namespace {

constexpr int64_t kMostSoftwareSteps = 60000;
static_assert(static_cast<int>(FieldFetch::Nearest) == kFetchNearest &&
              static_cast<int>(FieldFetch::Aimed) == kFetchAimed &&
              static_cast<int>(FieldFetch::Positions) == kFetchPositions &&
              static_cast<int>(FieldFetch::All) == kFetchAll);

std::vector<vf::RigidObject> covered(const std::vector<vf::RigidObject>& objects, int spheres) {
  std::vector<vf::RigidObject> out;
  for (const vf::RigidObject& object : objects)
    for (vf::RigidObject& piece : vf::coverWithSpheres(object, spheres)) out.push_back(std::move(piece));
  checkObjectCount(out, "use fewer 'spheres', or a smaller scene");
  return out;
}

}  // namespace

const SettingsTable<FieldUse>& FieldUse::table() {
  using S = FieldUse;
  static const SettingsTable<S> kTable = {{&S::slack,
                                           "slack",
                                           {0.0, 20.0},
                                           "spacings",
                                           "From inside an object's sphere: by how much a blocker must lie "
                                           "before the origin so that it is not the "
                                           "surface that the ray starts on, in spacings of the field's rays",
                                           "Gaitatzes 2012, section 4.4.2 (without a value)"},
                                          {&S::spheres,
                                           "spheres",
                                           {1, 64},
                                           "",
                                           "Spheres with a field each that cover an object which is long or "
                                           "hollow, at most; 1: one for every object",
                                           "Gaitatzes 2012, section 4.8 (suggested)"}};
  return kTable;
}

const SettingsTable<FieldStorage>& FieldStorage::table() {
  using S = FieldStorage;
  static const SettingsTable<S> kTable = {
      folderBinding(&S::folder),
      {&S::tolerance,
       "tolerance",
       {0, 64},
       "codes",
       "By how much codes of 8 bits may change so that runs of equal ones are longer: lossy compression",
       "Gaitatzes 2012, section 4.8 (suggested)"},
      {&S::detail, "detail", "Positions, directions and bits of the fields",
       "Gaitatzes 2012, section 4.6.1.3 (1 bit for far objects)"}};
  return kTable;
}

const SettingsTable<GivenDetail>& GivenDetail::table() {
  static const SettingsTable<GivenDetail> kTable = {};
  return kTable;
}

const SettingsTable<BySizeDetail>& BySizeDetail::table() {
  static const SettingsTable<BySizeDetail> kTable = {
      {&BySizeDetail::error,
       "error",
       {0.0001, 1.0},
       "",
       "Bound of the root mean square error of the whole picture (detail_by_size.h)"}};
  return kTable;
}

const SettingsTable<FieldReading>& FieldReading::table() {
  using S = FieldReading;
  static const SettingsTable<S> kTable = {
      included(&S::form),
      included(&S::use),
      {&S::fetch, "fetch",
       "What a look-up reads: the nearest position's nearest direction; from the nearest position, the "
       "direction to where the ray is likely to meet the object; the three positions around, each so aimed; "
       "or "
       "the four directions around as well. What neighbours let through is weighed, not their distances",
       "Gaitatzes 2012, section 4.4.2 (nearest); after Gortler et al. 1996 (aimed)"},
      {&S::storage, "storage", "How fields are kept"}};
  return kTable;
}

void FieldReading::check() const {
  if (storage.tolerance > 0 && form.bits != 8)
    throw Error("'tolerance' is for codes of 8 bits; 'bits' is " + std::to_string(form.bits),
                "storage.tolerance", "leave out 'tolerance', or give bits: 8");
  const bool between = fetch == FieldFetch::Positions || fetch == FieldFetch::All;
  if (between &&
      (form.positionMap != vf::PositionForm::Lattice || form.directionMap != vf::DirectionForm::Concentric))
    throw Error(std::string("'fetch: ") + limen::toText(fetch) +
                    "' reads neighbours, which it knows on a lattice of concentric maps",
                "fetch", "give fetch: nearest or aimed, or leave out 'position_map' and 'direction_map'");
}

void FieldReader::prepare(frame::Frame& frame, const ReceiverRays& rays, bool smooth, bool traces) {
  const vf::RigidObjects whole = objectsOf(frame, rays.objects);
  std::vector<vf::RigidObject> objects = covered(whole.objects, settings_.use.spheres);
  if (!smooth)
    for (vf::RigidObject& object : objects) object.normals.clear();
  const int64_t steps = rays.rays * static_cast<int64_t>(objects.size() + 2);
  if (frame.context().device().software && steps > kMostSoftwareSteps)
    throw Error(std::to_string(rays.rays) + " rays against " + std::to_string(objects.size()) +
                    " objects take more steps than a software renderer allows",
                "rays", "use fewer rays, or a GPU");
  rest_.clear(), motions_.clear();
  for (const vf::RigidObject& object : objects) {
    rest_.push_back(vf::VisibilityFields::poseOf(object));
    motions_.push_back(vf::motionOf(frame.scene(), object));
  }
  now_ = rest_;
  move(frame.timeS());
  std::vector<vf::FieldForm> forms(objects.size(), settings_.form);
  if (const auto* bySize = std::get_if<BySizeDetail>(&settings_.storage.detail)) {
    std::vector<double> sizesPx;
    for (const vf::Pose& pose : now_) sizesPx.push_back(sizePx(frame.camera(), frame.sizePx(), pose));
    detail_ = formsBySize(settings_.form, sizesPx, frame.sizePx(), bySize->error);
    forms = detail_->forms;
  }
  fields_.emplace(frame.context(), objects, forms, settings_.storage.tolerance, settings_.storage.folder);
  names_.clear();
  for (const vf::RigidObject& object : objects) names_.push_back(object.name);
  objectOf_.emplace(whole.objectOf);
  if (traces) keepTriangles(frame, rays, objects);
  fields_->place(now_, frame.gpuScene().anchor());
}

void FieldReader::keepTriangles(frame::Frame& frame, const ReceiverRays& rays,
                                const std::vector<vf::RigidObject>& objects) {
  if (frame.scene().motions.empty()) {
    tree_.emplace(treeOfObjects(frame, rays));
    return;
  }
  std::vector<ray_tracing::TreeTriangles> each;
  for (const vf::RigidObject& object : objects)
    each.push_back({object.vertices, object.triangles, object.numbers});
  forest_.emplace(frame.context(), each);
  fields_->setRoots(forest_->roots());
}

gl::ShaderDefines FieldReader::traceDefines() const {
  gl::ShaderDefines defines;
  if (forest_) defines["RAY_FOREST"] = "1";
  return defines;
}

void FieldReader::bindTrees(const gl::Program& program) const {
  if (forest_)
    forest_->bind(program);
  else
    tree_->tree().bind(program);
}

int64_t FieldReader::bytesHeld() const {
  return fields_->bytesHeld() + objectOf_->bytes() + (tree_ ? tree_->bytes() : 0) +
         (forest_ ? forest_->bytes() : 0);
}

void FieldReader::move(double timeS) {
  for (size_t i = 0; i < rest_.size(); ++i)
    if (motions_[i]) now_[i] = vf::VisibilityFields::moved(rest_[i], motions_[i]->at(timeS));
}

void FieldReader::place(const frame::Frame& frame) {
  if (frame.scene().motions.empty()) return;
  move(frame.timeS());
  fields_->place(now_, frame.gpuScene().anchor());
}

gl::ShaderDefines FieldReader::defines() const {
  gl::ShaderDefines defines = fields_->defines();
  defines["FIELD_FETCH"] = std::to_string(static_cast<int>(settings_.fetch));
  if (settings_.fetch != FieldFetch::Nearest) defines["FIELD_AIMED"] = "1";
  return defines;
}

void FieldReader::bind(const gl::Program& program) const {
  fields_->bind(program);
  objectOf_->bindStorage(vf::kFieldObjectOfBuffer);
  program.set("slackSpacings", static_cast<float>(settings_.use.slack));
}

gl::Buffer FieldReader::emptyCounts() {
  gl::Buffer counts(int64_t{4} * kFieldCountSlots, nullptr);
  counts.clearUint(0);
  return counts;
}

std::vector<Counter> FieldReader::countersOf(const gl::Buffer& counts, const frame::Frame& frame) const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const std::vector<uint32_t> each = counts.read<uint32_t>();
  const double pixels = double(frame.sizePx().x) * frame.sizePx().y;
  std::vector<Counter> out = {
      {"field_lookups_per_px", std::accumulate(each.begin(), each.end(), 0.0) / pixels},
      {"field_mib", double(fields_->bytes()) / (1 << 20)},
      {"field_run_length_mib", double(fields_->runLengthBytes()) / (1 << 20)},
      {"field_rays", double(fields_->rayCount())},
      {"field_objects", double(fields_->objectCount())}};
  if (detail_) {
    out.push_back({"field_forms", double(detail_->formCount())});
    if (std::isfinite(detail_->bound)) out.push_back({"field_error_bound", detail_->bound});
  }
  return out;
}

std::vector<std::string> FieldReader::remarks() const {
  std::vector<std::string> out;
  if (detail_) out = detailRemarks(*detail_, names_);
  if (fields_ && fields_->fieldsRead() > 0)
    out.push_back(std::to_string(fields_->fieldsRead()) + " of " + std::to_string(fields_->objectCount()) +
                  " fields were read from '" + settings_.storage.folder +
                  "' and not made: preparation took less time");
  return out;
}

std::vector<Quantity> FieldReader::quantities() {
  return {
      {"field_lookups_per_px", "Look-ups in fields, per pixel", "1/px", Direction::LowerIsBetter,
       "Gaitatzes 2012, section 4.7.1"},
      {"field_mib", "Size of the fields", "MiB", Direction::LowerIsBetter, "Gaitatzes 2012, Fig. 42"},
      {"field_run_length_mib", "Size of the fields as run lengths", "MiB", Direction::LowerIsBetter,
       "Gaitatzes 2012, section 4.8"},
      {"field_rays", "Rays traced to make the fields", "rays", Direction::LowerIsBetter,
       "Gaitatzes 2012, section 4.4.1"},
      {"field_objects", "Objects with a field", "", Direction::Neither, "Gaitatzes 2012, section 4.5.1"},
      {"field_forms", "Different forms of fields that were chosen by size", "", Direction::Neither, "bench"},
      {"field_error_bound", "Bound of the error of fields that were chosen by size", "",
       Direction::LowerIsBetter, "bench"}};
}

}  // namespace limen::techniques
