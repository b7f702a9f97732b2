// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/context.h"

#include <epoxy/gl.h>

#include <stdexcept>

#include "experiments/base/error.h"
#include "renderer/gl/fills.h"

namespace limen::gl {
namespace {

std::string glText(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text ? text : "";
}

bool isSoftware(const std::string& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "SwiftShader", "Software Rasterizer", "swrast"})
    if (renderer.find(name) != std::string::npos) return true;
  return false;
}

void GLAPIENTRY onDebugMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length,
                               const GLchar* text, const void* user) {
  if (severity != GL_DEBUG_SEVERITY_HIGH && severity != GL_DEBUG_SEVERITY_MEDIUM) return;
  auto* messages = static_cast<std::vector<DebugMessage>*>(const_cast<void*>(user));
  // A driver that repeats a message every frame must not fill memory.
  if (messages->size() < 100)
    messages->push_back({std::string(text, static_cast<size_t>(length)), type == GL_DEBUG_TYPE_PERFORMANCE});
}

}  // namespace

Context::~Context() = default;

void Context::deleteObjects() {
  makeCurrent();
  Fills::gone(*this);
  programs_.clear();
}

void Context::initialize(const std::string& platform) {
  device_ = {glText(GL_VENDOR), glText(GL_RENDERER), glText(GL_VERSION), platform, false};
  device_.software = isSoftware(device_.renderer);
  if (epoxy_gl_version() < 45)
    throw Error("the OpenGL driver offers version " + device_.version + " only", device_.renderer,
                "Limen needs OpenGL 4.5 core: update the driver or use Mesa's llvmpipe");
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(&onDebugMessage, &messages_);
  glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  Fills::madeCurrent(*this);
}

std::vector<DebugMessage> Context::takeDebugMessages() { return std::exchange(messages_, {}); }

void Context::checkDebugMessages() {
  std::string mistakes;
  for (const DebugMessage& message : takeDebugMessages())
    if (!message.performance) mistakes += (mistakes.empty() ? "" : "\n") + message.text;
  if (!mistakes.empty()) throw std::runtime_error("the OpenGL driver reports: " + mistakes);
}

}  // namespace limen::gl
