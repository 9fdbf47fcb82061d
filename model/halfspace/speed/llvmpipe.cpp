#include "halfspace/speed/llvmpipe.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#define GL_GLEXT_PROTOTYPES  // for their types: nothing is linked
#include <GL/glcorearb.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "halfspace/machine/draw_state.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

// clang-format off
#define HALFSPACE_GL(F)                                                                                     \
  F(AttachShader) F(BeginQuery) F(BindBuffer) F(BindFramebuffer) F(BindRenderbuffer) F(BindVertexArray)     \
  F(BufferData) F(Clear) F(ClearDepthf) F(ClipControl) F(CompileShader) F(CreateProgram) F(CreateShader)    \
  F(CullFace) F(DeleteBuffers) F(DeleteFramebuffers) F(DeleteRenderbuffers) F(DepthFunc) F(DepthMask)       \
  F(DepthRangef) F(Disable) F(DrawElementsBaseVertex) F(Enable) F(EnableVertexAttribArray) F(EndQuery)      \
  F(Finish) F(FramebufferParameteri) F(FramebufferRenderbuffer) F(FrontFace) F(GenBuffers)                  \
  F(GenFramebuffers) F(GenQueries) F(GenRenderbuffers) F(GenVertexArrays) F(GetError)                       \
  F(GetQueryObjectui64v) F(GetString) F(GetUniformLocation) F(LinkProgram) F(PolygonOffset)                 \
  F(RenderbufferStorage) F(Scissor) F(ShaderSource) F(Uniform1f) F(UseProgram) F(VertexAttribPointer)       \
  F(ViewportIndexedf)

/// OpenGL 4.5, by the names of its functions.
struct Gl {
#define HALFSPACE_MEMBER(name) decltype(&::gl##name) name = nullptr;
  HALFSPACE_GL(HALFSPACE_MEMBER)
#undef HALFSPACE_MEMBER
};
// clang-format on

constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec4 position;
uniform float y_sign;
void main() { gl_Position = vec4(position.x, y_sign * position.y, position.zw); }
)";
constexpr const char* kFragmentShader = R"(#version 450 core
void main() {}
)";

GLenum gl_format(DepthFormat format) {
  switch (format) {
    case DepthFormat::kUnorm16:
      return GL_DEPTH_COMPONENT16;
    case DepthFormat::kFloat32:
      return GL_DEPTH_COMPONENT32F;
    default:
      return GL_DEPTH_COMPONENT24;
  }
}

/// The library of EGL and a current context of OpenGL 4.5.
class Context {
 public:
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() {
    if (display_ != EGL_NO_DISPLAY) {
      make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      terminate_(display_);
    }
    if (library_ != nullptr) {
      dlclose(library_);
    }
  }

  /// Empty where it worked; else what is missing.
  std::string open() {
    library_ = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) {
      return "not installed: no libEGL.so.1 (Debian: libegl1)";
    }
    const auto symbol = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library_, name));
      return function != nullptr;
    };
    decltype(&::eglGetPlatformDisplay) get_display = nullptr;
    decltype(&::eglInitialize) initialize = nullptr;
    decltype(&::eglBindAPI) bind_api = nullptr;
    decltype(&::eglCreateContext) create_context = nullptr;
    if (!symbol(get_display, "eglGetPlatformDisplay") || !symbol(initialize, "eglInitialize") ||
        !symbol(bind_api, "eglBindAPI") || !symbol(create_context, "eglCreateContext") ||
        !symbol(make_current_, "eglMakeCurrent") || !symbol(terminate_, "eglTerminate") ||
        !symbol(get_address_, "eglGetProcAddress")) {
      return "libEGL.so.1 is older than EGL 1.5";
    }
    const EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || initialize(display, nullptr, nullptr) == EGL_FALSE) {
      return "not installed: EGL has no surfaceless display (Debian: libegl-mesa0, libgl1-mesa-dri)";
    }
    display_ = display;
    bind_api(EGL_OPENGL_API);
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    const EGLContext context = create_context(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT ||
        make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
      return "no context of OpenGL 4.5";
    }
    return {};
  }

  /// Null where it is not there.
  template <class Function>
  void get(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(get_address_(name));
  }

 private:
  void* library_ = nullptr;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  decltype(&::eglMakeCurrent) make_current_ = nullptr;
  decltype(&::eglTerminate) terminate_ = nullptr;
  decltype(&::eglGetProcAddress) get_address_ = nullptr;
};

class EglLlvmpipe final : public Llvmpipe {
 public:
  /// As Context::open().
  std::string start() {
    if (std::string why = context_.open(); !why.empty()) {
      return why;
    }
    const char* missing = nullptr;
#define HALFSPACE_GET(name)           \
  context_.get(gl_.name, "gl" #name); \
  missing = gl_.name == nullptr ? "gl" #name : missing;
    HALFSPACE_GL(HALFSPACE_GET)
#undef HALFSPACE_GET
    if (missing != nullptr) {
      return fmt::format("OpenGL has no {}", missing);
    }
    if (name().find("llvmpipe") == std::string::npos) {
      return fmt::format("the renderer is {}", name());
    }
    const GLuint program = gl_.CreateProgram();
    for (const auto& [kind, source] :
         {std::pair{GL_VERTEX_SHADER, kVertexShader}, std::pair{GL_FRAGMENT_SHADER, kFragmentShader}}) {
      const GLuint shader = gl_.CreateShader(kind);
      gl_.ShaderSource(shader, 1, &source, nullptr);
      gl_.CompileShader(shader);
      gl_.AttachShader(program, shader);
    }
    gl_.LinkProgram(program);
    gl_.UseProgram(program);
    y_sign_ = gl_.GetUniformLocation(program, "y_sign");
    GLuint array = 0;
    gl_.GenVertexArrays(1, &array);
    gl_.BindVertexArray(array);
    gl_.EnableVertexAttribArray(0);
    gl_.GenQueries(1, &query_);
    gl_.Enable(GL_SCISSOR_TEST);
    return gl_.GetError() == GL_NO_ERROR ? "" : "OpenGL refuses a shader";
  }

  [[nodiscard]] std::string name() const override {
    return fmt::format("Mesa {}, {}", mesa_version(), text(GL_RENDERER));
  }

  void load(const Frame& frame, const Config& config) override {
    for (std::size_t i = 0; i < frame.commands.size(); ++i) {
      const Command& command = frame.commands[i];
      if (command.kind == CommandKind::kDraw && !command.fills_triangles()) {
        throw InputError(
            fmt::format("{}: command {}: it draws lines or points, which OpenGL ES does by rules of its own: "
                        "leave it out "
                        "(--without llvmpipe)",
                        frame.name, i));
      }
      if (command.is_unrestricted(frame.targets[command.target].depth_format)) {
        throw InputError(
            fmt::format("{}: command {}: its depth leaves 0 to 1; llvmpipe would clamp it: leave it out "
                        "(--without llvmpipe)",
                        frame.name, i));
      }
    }
    drop();
    frame_ = &frame;
    config_ = &config;
    gl_.GenBuffers(2, buffers_);
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(frame.vertices.size() * sizeof(glm::vec4)),
                   frame.vertices.data(), GL_STATIC_DRAW);
    gl_.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
    gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                   static_cast<GLsizeiptr>(frame.indices.size() * sizeof(std::uint32_t)),
                   frame.indices.data(), GL_STATIC_DRAW);
    make_targets();
    first_draw_ = 0;
    while (first_draw_ < frame.commands.size() && frame.commands[first_draw_].kind == CommandKind::kClear) {
      ++first_draw_;
    }
    check();
  }

  void clear() override {
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      Command clear;
      clear.target = static_cast<std::uint32_t>(i);
      clear.flags = static_cast<std::uint32_t>(Flag::kClearDepth);
      do_clear(clear);
    }
    for (std::size_t i = 0; i < first_draw_; ++i) {
      do_clear(frame_->commands[i]);
    }
    gl_.Finish();
  }

  void draw() override {
    for (std::size_t i = first_draw_; i < frame_->commands.size(); ++i) {
      const Command& command = frame_->commands[i];
      command.kind == CommandKind::kClear ? do_clear(command) : do_draw(command);
    }
    gl_.Finish();
  }

  std::uint64_t count() override {
    clear();
    draw();  // without the query shaders are others: they are compiled now, not in the first timed pass
    clear();
    gl_.BeginQuery(GL_SAMPLES_PASSED, query_);
    draw();
    gl_.EndQuery(GL_SAMPLES_PASSED);
    GLuint64 samples = 0;
    gl_.GetQueryObjectui64v(query_, GL_QUERY_RESULT, &samples);
    check();
    return samples;
  }

 private:
  [[nodiscard]] std::string text(GLenum what) const {
    const GLubyte* const bytes = gl_.GetString(what);
    return bytes == nullptr ? "nameless" : reinterpret_cast<const char*>(bytes);
  }

  /// "22.3.6" of "4.5 (Core Profile) Mesa 22.3.6".
  [[nodiscard]] std::string mesa_version() const {
    const std::string version = text(GL_VERSION);
    const std::size_t mesa = version.find("Mesa ");
    return mesa == std::string::npos ? version : version.substr(mesa + 5);
  }

  void check() const {
    if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR) {
      throw InputError(fmt::format("{}: llvmpipe: OpenGL error {:#06x}", frame_->name, error));
    }
  }

  void drop() {
    if (frame_ != nullptr) {
      gl_.DeleteBuffers(2, buffers_);
      gl_.DeleteFramebuffers(static_cast<GLsizei>(targets_.size()), targets_.data());
      gl_.DeleteRenderbuffers(static_cast<GLsizei>(surfaces_.size()), surfaces_.data());
    }
  }

  /// A renderbuffer for each depth surface and a framebuffer for each target.
  void make_targets() {
    const std::vector<Surface> all = make_surfaces(*frame_, *config_, Watch{.count_pixels = false});
    const std::span<const Surface> surfaces = depth_surfaces(all);
    surfaces_.assign(surfaces.size(), 0);
    gl_.GenRenderbuffers(static_cast<GLsizei>(surfaces_.size()), surfaces_.data());
    formats_.clear();
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      formats_.push_back(surfaces[i].format);
      gl_.BindRenderbuffer(GL_RENDERBUFFER, surfaces_[i]);
      gl_.RenderbufferStorage(GL_RENDERBUFFER, gl_format(formats_[i]), surfaces[i].codes.width(),
                              surfaces[i].codes.height());
    }
    targets_.assign(frame_->targets.size(), 0);
    gl_.GenFramebuffers(static_cast<GLsizei>(targets_.size()), targets_.data());
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const Target& target = frame_->targets[i];
      gl_.BindFramebuffer(GL_FRAMEBUFFER, targets_[i]);
      if (target.depth_surface == kNoSurface) {
        gl_.FramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH,
                                  static_cast<GLint>(target.width));
        gl_.FramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT,
                                  static_cast<GLint>(target.height));
      } else {
        gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                    surfaces_[target.depth_surface]);
      }
    }
  }

  /// False where nothing can be drawn.
  bool bind(const Command& command) {
    const Target& target = frame_->targets[command.target];
    const PixelRect rect = drawable_rect(command.scissor, target);
    if (rect.empty()) {
      return false;
    }
    gl_.BindFramebuffer(GL_FRAMEBUFFER, targets_[command.target]);
    gl_.Scissor(rect.x_first, rect.y_first, rect.x_last - rect.x_first + 1, rect.y_last - rect.y_first + 1);
    return true;
  }

  void do_clear(const Command& command) {
    if (command.has(Flag::kClearDepth) && bind(command)) {
      gl_.DepthMask(GL_TRUE);
      gl_.ClearDepthf(command.clear_depth);
      gl_.Clear(GL_DEPTH_BUFFER_BIT);
    }
  }

  void enable(GLenum what, bool on) { (on ? gl_.Enable : gl_.Disable)(what); }

  void do_draw(const Command& draw) {
    const std::uint32_t surface = frame_->targets[draw.target].depth_surface;
    if (draw.has(Flag::kNotFilled) || !bind(draw)) {
      return;
    }
    const EarlyZState state =
        early_z_state(draw, surface == kNoSurface ? DepthFormat::kNone : formats_[surface], *config_);
    enable(GL_DEPTH_TEST, state.test);
    gl_.DepthMask(state.write ? GL_TRUE : GL_FALSE);
    gl_.DepthFunc(GL_NEVER + static_cast<GLenum>(draw.depth_func));
    gl_.DepthRangef(draw.depth_range.x, draw.depth_range.y);
    enable(GL_DEPTH_CLAMP, draw.has(Flag::kDepthClamp));
    enable(GL_POLYGON_OFFSET_FILL, draw.has(Flag::kPolygonOffset));
    gl_.PolygonOffset(draw.offset_factor, draw.offset_units);  // OpenGL 4.5 cannot clamp it
    // A framebuffer's rows are counted in the direction of y, as here. Ties go to the other side, and faces
    // turn, where the origin is above; then y is turned back by the shader.
    const bool above = draw.has(Flag::kBottomLeftRule);
    gl_.ClipControl(above ? GL_UPPER_LEFT : GL_LOWER_LEFT,
                    draw.has(Flag::kNdcZMinusOneToOne) ? GL_NEGATIVE_ONE_TO_ONE : GL_ZERO_TO_ONE);
    const bool front = draw.has(Flag::kCullFront);
    const bool back = draw.has(Flag::kCullBack);
    enable(GL_CULL_FACE, front || back);
    gl_.CullFace(front && back ? GL_FRONT_AND_BACK : front ? GL_FRONT : GL_BACK);
    gl_.FrontFace(draw.has(Flag::kFrontPositiveArea) != above ? GL_CCW : GL_CW);
    const bool negative = draw.viewport.w < 0;
    gl_.Uniform1f(y_sign_, negative != above ? -1.0f : 1.0f);
    gl_.ViewportIndexedf(0, draw.viewport.x, negative ? draw.viewport.y + draw.viewport.w : draw.viewport.y,
                         draw.viewport.z, negative ? -draw.viewport.w : draw.viewport.w);
    const std::uintptr_t offset = std::uintptr_t{draw.first_index} * sizeof(std::uint32_t);
    gl_.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(draw.index_count), GL_UNSIGNED_INT,
                               std::bit_cast<const void*>(offset), static_cast<GLint>(draw.first_vertex));
  }

  Context context_;
  Gl gl_;
  GLint y_sign_ = 0;
  GLuint query_ = 0;
  const Frame* frame_ = nullptr;
  const Config* config_ = nullptr;
  GLuint buffers_[2] = {};        ///< vertices and indices
  std::vector<GLuint> surfaces_;  ///< by depth surface
  std::vector<DepthFormat> formats_;
  std::vector<GLuint> targets_;  ///< by target
  std::size_t first_draw_ = 0;   ///< the clears before it are not timed
};

}  // namespace

std::unique_ptr<Llvmpipe> Llvmpipe::open(std::string& why) {
  // Read by Mesa when it is loaded. No thread beside the caller's.
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LP_NUM_THREADS", "0", 1);
  auto llvmpipe = std::make_unique<EglLlvmpipe>();
  why = llvmpipe->start();
  return why.empty() ? std::move(llvmpipe) : nullptr;
}

}  // namespace halfspace
