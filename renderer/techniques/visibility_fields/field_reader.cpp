// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/field_reader.h"

#include <epoxy/gl.h>

#include <cmath>
#include <numeric>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/visibility_fields/detail_by_size.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
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

void checkCount(const std::vector<vf::RigidObject>& objects, const char* mend) {
  if (objects.size() > vf::kMostFieldObjects)
    throw Error("the scene has " + std::to_string(objects.size()) +
                    " objects or pieces of objects; at most " + std::to_string(vf::kMostFieldObjects) +
                    " can have visibility fields",
                "objects", mend);
}

std::vector<vf::RigidObject> covered(const std::vector<vf::RigidObject>& objects, int spheres) {
  std::vector<vf::RigidObject> out;
  for (const vf::RigidObject& object : objects)
    for (vf::RigidObject& piece : vf::coverWithSpheres(object, spheres)) out.push_back(std::move(piece));
  checkCount(out, "use fewer 'spheres', or a smaller scene");
  return out;
}

struct ObjectTriangles {
  std::vector<glm::vec3> vertices;
  std::vector<glm::uvec3> triangles;
};

/// Numbered as in the scene, without those of no object, or without those of any.
ObjectTriangles objectTriangles(const frame::Frame& frame, const vf::RigidObjects& objects,
                                bool ofObjects = true) {
  const scene::Mesh& mesh = frame.scene().mesh;
  ObjectTriangles out{{}, mesh.triangles};
  for (const glm::dvec3 p : mesh.positions) out.vertices.emplace_back(p - frame.gpuScene().anchor());
  // Without area: left out of the tree, but counted.
  for (size_t i = 0; i < out.triangles.size(); ++i)
    if ((objects.objectOf[i] == vf::kFieldNoObject) == ofObjects) out.triangles[i] = glm::uvec3(0);
  return out;
}

const frame::GBufferChannel& channelOf(frame::Frame& frame, frame::Channel channel) {
  return frame.get<frame::GBufferChannel>(frame::ChannelSetting{channel});
}

}  // namespace

vf::RigidObjects objectsOf(const frame::Frame& frame, const vf::ObjectSetting& setting) {
  vf::RigidObjects objects = vf::rigidObjectsOf(frame.scene(), setting);
  checkCount(objects.objects, "use 'auto' or 'parts', or a smaller scene");
  return objects;
}

const SettingsTable<ReceiverRays>& ReceiverRays::table() {
  using S = ReceiverRays;
  static const SettingsTable<S> kTable = {
      {&S::rays, "rays", {1, 1024}, "rays", "Rays per pixel, a square number", "Gaitatzes 2012, section 4.7"},
      {&S::pattern, "pattern", "Where the rays of a pixel lie in their cells", "bench"},
      {&S::selfOcclusion, "self_occlusion", "Objects block their own rays, and not only those of others",
       "Gaitatzes 2012, section 4.4.2"},
      objectsBinding(&S::objects)};
  return kTable;
}

int ReceiverRays::side() const { return static_cast<int>(std::lround(std::sqrt(double(rays)))); }

void ReceiverRays::check() const {
  if (int64_t{side()} * side() != rays)
    throw Error("'rays' is " + std::to_string(rays) + ", not a square number", "rays",
                "give " + std::to_string(side() * side()));
}

int ReceiverRays::interleave() const {
  const auto* interleaved = std::get_if<InterleavedPattern>(&pattern);
  return interleaved ? interleaved->side : 1;
}

void ReceiverRays::makeInputs(frame::Frame& frame) {
  channelOf(frame, frame::Channel::Position);
  channelOf(frame, frame::Channel::Normal);
  frame.get<frame::TriangleIds>();
}

void ReceiverRays::configure(const gl::Program& program, frame::Frame& frame) const {
  channelOf(frame, frame::Channel::Position).texture().bindTexture(kFieldPositionUnit);
  channelOf(frame, frame::Channel::Normal).texture().bindTexture(kFieldNormalUnit);
  frame.get<frame::TriangleIds>().texture().bindTexture(kFieldIdsUnit);
  program.set("sizePx", frame.sizePx());
  program.set("raySide", side());
  const auto* turned = std::get_if<TurnedPattern>(&pattern);
  program.set("turned", turned ? 1 : 0);
  program.set("seed", turned ? static_cast<uint32_t>(turned->seed) : 0U);
  program.set("interleave", interleave());
  program.set("selfOcclusion", selfOcclusion ? 1 : 0);
  program.set("eyePosition", glm::vec3(frame.camera().eye - frame.gpuScene().anchor()));
}

const SettingsTable<SamePattern>& SamePattern::table() {
  static const SettingsTable<SamePattern> kTable = {};
  return kTable;
}

const SettingsTable<TurnedPattern>& TurnedPattern::table() {
  static const SettingsTable<TurnedPattern> kTable = {
      {&TurnedPattern::seed, "seed", {0, 1000000}, "", "Seed of the choice"}};
  return kTable;
}

const SettingsTable<InterleavedPattern>& InterleavedPattern::table() {
  using S = InterleavedPattern;
  static const SettingsTable<S> kTable = {
      {&S::side,
       "side",
       {2, 8},
       "px",
       "Side of the tiles of pixels that share a grid of rays that is finer by as much",
       "Keller and Heidrich 2001 (bench)"},
      {&S::filter, "filter", "What is made of interleaved pixels", "bench"}};
  return kTable;
}

const SettingsTable<NoFilter>& NoFilter::table() {
  static const SettingsTable<NoFilter> kTable = {};
  return kTable;
}

const SettingsTable<BilateralFilter>& BilateralFilter::table() {
  static const SettingsTable<BilateralFilter> kTable = {
      {&BilateralFilter::angleDeg,
       "angle_deg",
       {0.1, 90.0},
       "deg",
       "Angle between normals, or between a surface and the way to another pixel's point, at which that "
       "counts no more"}};
  return kTable;
}

const SettingsTable<TreeTracer>& TreeTracer::table() {
  static const SettingsTable<TreeTracer> kTable = {};
  return kTable;
}

const SettingsTable<GridTracer>& GridTracer::table() {
  static const SettingsTable<GridTracer> kTable = {
      {&GridTracer::density, "density", {0.01, 64.0}, "", "Cells per triangle", "Cleary and Wyvill 1988"}};
  return kTable;
}

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

void FieldReader::prepare(frame::Frame& frame, const ReceiverRays& rays, bool smooth, bool trees) {
  const vf::RigidObjects whole = objectsOf(frame, rays.objects);
  std::vector<vf::RigidObject> objects = covered(whole.objects, settings_.use.spheres);
  if (!smooth)
    for (vf::RigidObject& object : objects) object.normals.clear();
  const int64_t steps = rays.rays * static_cast<int64_t>(objects.size() + 2);
  if (frame.context().device().software && steps > kMostSoftwareSteps)
    throw Error(std::to_string(rays.rays) + " rays against " + std::to_string(objects.size()) +
                    " objects take more steps than a software renderer allows",
                "rays", "use fewer rays, or a GPU");
  rest_.clear(), motions_.assign(objects.size(), nullptr);
  for (const vf::RigidObject& object : objects) rest_.push_back(vf::VisibilityFields::poseOf(object));
  for (const scene::PartMotion& motion : frame.scene().motions)
    for (size_t i = 0; i < objects.size(); ++i)
      if (objects[i].part == motion.part) motions_[i] = &motion;
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
  if (trees) {
    std::vector<ray_tracing::TreeTriangles> each;
    for (const vf::RigidObject& object : objects)
      each.push_back({object.vertices, object.triangles, object.numbers});
    trees_.emplace(frame.context(), each);
    fields_->setRoots(trees_->roots());
  }
  fields_->place(now_, frame.gpuScene().anchor());
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

ray_tracing::RayScene raysWithoutObjects(frame::Frame& frame, const ReceiverRays& rays) {
  const ObjectTriangles others = objectTriangles(frame, objectsOf(frame, rays.objects), false);
  return {frame.context(), others.vertices, others.triangles};
}

void ObjectTracer::prepare(frame::Frame& frame, const ReceiverRays& rays, const TracerSetting& tracer) {
  const vf::RigidObjects objects = objectsOf(frame, rays.objects);
  const ObjectTriangles all = objectTriangles(frame, objects);
  const auto* grid = std::get_if<GridTracer>(&tracer);
  if (!frame.scene().motions.empty()) {
    if (grid)
      throw Error("the cells of a grid are filled once, and parts of this scene move", "tracer",
                  "use tracer: tree");
    auto rebuilt = std::make_unique<ray_tracing::RebuiltTree>(frame.context(),
                                                              static_cast<uint32_t>(all.triangles.size()));
    rebuilt_ = rebuilt.get();
    rays_ = std::move(rebuilt);
    indices_.emplace(all.triangles);
  } else if (grid)
    rays_ = std::make_unique<ray_tracing::TriangleGrid>(frame.context(), all.vertices, all.triangles,
                                                        grid->density);
  else
    rays_ = std::make_unique<ray_tracing::RayScene>(frame.context(), all.vertices, all.triangles);
  objectOf_.emplace(objects.objectOf);
}

void ObjectTracer::update(frame::Frame& frame) {
  if (rebuilt_) rebuilt_->build(frame.passes(), frame.positions(), *indices_);
}

gl::ShaderDefines ObjectTracer::defines(const TracerSetting& tracer) {
  gl::ShaderDefines defines;
  if (std::holds_alternative<GridTracer>(tracer)) defines["RAY_GRID"] = "1";
  return defines;
}

void ObjectTracer::bind(const gl::Program& program) const {
  rays_->bind(program);
  objectOf_->bindStorage(vf::kFieldObjectOfBuffer);
}

void ObjectTracer::dispatchRows(const gl::Program& program, frame::Frame& frame, int rows) {
  const int atOnce = frame.context().device().software ? 1 : rows;
  for (int row = 0; row < rows; row += atOnce) {
    program.set("firstRow", row);
    program.set("lastRow", row + atOnce - 1);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
}

}  // namespace limen::techniques
