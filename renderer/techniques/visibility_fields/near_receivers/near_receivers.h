// SPDX-License-Identifier: BSD-3-Clause
// Receivers so near to an object that texels of its field do not tell what is there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/visibility_fields/field_reader.h"
#include "renderer/techniques/visibility_fields/near_receivers/near_setting.h"

namespace limen::techniques {

/// Lists such receivers while fields are read, and then makes their pixels anew with traced rays. Nothing is
/// read back.
class NearReceivers {
 public:
  explicit NearReceivers(const NearSetting& setting) : setting_(setting) {}
  bool traced() const { return std::holds_alternative<NearTraced>(setting_); }

  /// `shader`: traces listed pixels; `defines`: of the fields, which have trees if traced().
  void prepare(frame::Frame& frame, const std::string& shader, const gl::ShaderDefines& defines);
  /// To be added to the defines of a program that includes near_list.glsl.
  void define(gl::ShaderDefines& defines) const;
  /// Set-up of such a program.
  void bindList(const gl::Program& program) const;
  /// After that program's dispatch: traces what it listed. `configure(program)` sets up the shader's rays and
  /// binds the picture.
  template <class Configure>
  void trace(const FieldReader& reader, const Configure& configure) const {
    if (!traced()) return;
    makeGroups();
    reader.bind(*program_);
    reader.bindTrees(*program_);
    configure(*program_);
    list_->bindStorage(kNearListBuffer);
    dispatch();
  }
  int64_t bytesHeld() const { return list_ ? list_->bytes() : 0; }

  /// Of the frame last rendered; waits for the GPU.
  Counter count(const frame::Frame& frame) const;
  static Quantity quantity();

 private:
  void makeGroups() const;
  void dispatch() const;

  NearSetting setting_;
  std::optional<gl::Buffer> list_;
  const gl::Program *groups_ = nullptr, *program_ = nullptr;
};

}  // namespace limen::techniques
