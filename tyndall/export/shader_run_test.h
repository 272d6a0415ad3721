#pragma once
// Runs generated GLSL: a compute shader on whatever OpenGL ES 3.1 the machine has without a window (Mesa's llvmpipe).
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace tyndall {

/// An OpenGL ES 3.1 context for the life of the object. Throws where there is none.
class ShaderMachine {
 public:
  ShaderMachine() {
    const auto get_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get_display == nullptr) throw std::runtime_error("EGL has no platform displays");
    display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE)
      throw std::runtime_error("no surfaceless EGL display");
    eglBindAPI(EGL_OPENGL_ES_API);
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display_, wanted, &config, 1, &count);
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
    if (context_ == EGL_NO_CONTEXT || eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
      throw std::runtime_error("no OpenGL ES 3.1 context");
  }
  // The display is not terminated: unloading Mesa's driver loses 128 bytes, which leak checkers report.
  ~ShaderMachine() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  ShaderMachine(const ShaderMachine&) = delete;
  ShaderMachine& operator=(const ShaderMachine&) = delete;

  /// Runs `body` once for each row of `given` (rows of `columns_in` numbers, read as given(k)) and returns rows of
  /// `columns_out` numbers, set by found(k, value). Throws with the compiler's words when the text is not valid.
  std::vector<float> run(const std::string& functions, const std::string& body, const std::vector<float>& given,
                         std::size_t columns_in, std::size_t columns_out) const {
    const std::size_t rows = given.size() / columns_in;
    const std::string text =
        "#version 310 es\nprecision highp float;\nprecision highp int;\nlayout(local_size_x = 64) in;\n"
        "layout(std430, binding = 0) readonly buffer Given { float all_given[]; };\n"
        "layout(std430, binding = 1) writeonly buffer Found { float all_found[]; };\n" +
        functions + "\nfloat given(uint k) { return all_given[gl_GlobalInvocationID.x * " + std::to_string(columns_in) +
        "u + k]; }\nvoid found(uint k, float value) { all_found[gl_GlobalInvocationID.x * " +
        std::to_string(columns_out) +
        "u + k] = value; }\nvoid main() {\n  if (gl_GlobalInvocationID.x >= " + std::to_string(rows) + "u) return;\n" +
        body + "}\n";
    const GLuint program = compiled(text);
    GLuint buffers[2];
    glGenBuffers(2, buffers);
    const auto bytes_in = static_cast<GLsizeiptr>(given.size() * sizeof(float));
    const auto bytes_out = static_cast<GLsizeiptr>(rows * columns_out * sizeof(float));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0]);
    glBufferData(GL_SHADER_STORAGE_BUFFER, bytes_in, given.data(), GL_STATIC_DRAW);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1]);
    glBufferData(GL_SHADER_STORAGE_BUFFER, bytes_out, nullptr, GL_STATIC_READ);
    glUseProgram(program);
    glDispatchCompute(static_cast<GLuint>((rows + 63) / 64), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const void* const mapped = glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, bytes_out, GL_MAP_READ_BIT);
    if (mapped == nullptr) throw std::runtime_error("the shader's results cannot be read");
    const auto* const first = static_cast<const float*>(mapped);
    std::vector<float> out(first, first + rows * columns_out);
    glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
    glDeleteBuffers(2, buffers);
    glDeleteProgram(program);
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
      throw std::runtime_error("OpenGL error " + std::to_string(error));
    return out;
  }

 private:
  static GLuint compiled(const std::string& text) {
    const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
    const char* const source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    const GLuint program = glCreateProgram();
    glAttachShader(program, shader);
    glLinkProgram(program);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
      char words[4096] = "";
      glGetShaderInfoLog(shader, sizeof words, nullptr, words);
      throw std::runtime_error(std::string(words) + "\n" + text);
    }
    glDeleteShader(shader);
    return program;
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace tyndall
