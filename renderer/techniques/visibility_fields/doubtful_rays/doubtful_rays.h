// SPDX-License-Identifier: BSD-3-Clause
// Rays about which the fields are in doubt.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/visibility_fields/field_reader.h"
#include "renderer/techniques/visibility_fields/near_receivers/near_setting.h"

namespace limen::techniques {

/// Throws Error, at `where`, if doubt about rays cannot be told by how fields are read.
void checkNear(const NearSetting& setting, const FieldReading& field, const char* where);

/// Lists such rays while fields are read, which leaves them out of their pixels' sums, traces them one by
/// one, and adds what they see. Nothing is read back.
class DoubtfulRays {
 public:
  explicit DoubtfulRays(const NearSetting& setting);
  bool traced() const { return setting_.has_value(); }

  /// `shader`: traces listed rays; `defines`: of that shader; `format`: of the picture. Throws Error if there
  /// are more rays than can be counted, or more than the device can list.
  void prepare(frame::Frame& frame, const std::string& shader, const gl::ShaderDefines& defines,
               gl::Format format, int64_t raysPerPx);
  /// To be added to the defines of a program that includes doubtful_list.glsl.
  void define(gl::ShaderDefines& defines) const;
  /// Set-up of such a program.
  void bindList(const gl::Program& program) const;
  /// After that program's dispatch: traces what it listed, and completes `picture`, which holds means over
  /// the rays that are not in doubt, as shares of all. `configure(program)` sets up the shader's rays.
  template <class Configure>
  void trace(const FieldReader& reader, frame::Frame& frame, const gl::Texture& picture,
             const Configure& configure) const {
    if (!traced()) return;
    makeGroups();
    reader.bind(*program_);
    reader.bindTrees(*program_);
    configure(*program_);
    dispatch();
    addSums(frame, picture);
  }
  int64_t bytesHeld() const { return list_ ? list_->bytes() + sums_->bytes() : 0; }

  /// Of the frame last rendered; waits for the GPU.
  std::vector<Counter> count() const;
  static std::vector<Quantity> quantities();
  /// Of all frames rendered so far: whether the list was too short; waits for the GPU.
  std::vector<std::string> remarks() const;

 private:
  void makeGroups() const;
  void dispatch() const;
  void addSums(frame::Frame& frame, const gl::Texture& picture) const;

  std::optional<DoubtfulTraced> setting_;
  uint32_t capacity_ = 0;
  int64_t raysPerPx_ = 1;
  double allRays_ = 1.0;
  std::optional<gl::Buffer> list_, sums_;
  const gl::Program *groups_ = nullptr, *program_ = nullptr, *adding_ = nullptr;
};

}  // namespace limen::techniques
