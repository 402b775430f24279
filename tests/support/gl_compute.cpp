#include "support/gl_compute.h"

#include <cstddef>
#include <cstdlib>
#include <stdexcept>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace rnmbake {
namespace {

constexpr std::size_t group_size = 64;

[[noreturn]] void no_egl(const std::string& what) {
  throw std::runtime_error(
      what +
      ": shaders cannot be run; apt-get install libegl1 libgl1-mesa-dri (Mesa's software "
      "renderer, surfaceless)");
}

std::string around(const std::string& declarations, const std::string& source, const std::string& body,
                   std::size_t width) {
  return "#version 450\nlayout(local_size_x = " + std::to_string(group_size) +
         ") in;\n"
         "layout(std430, binding = 0) readonly buffer Inputs { float test_inputs[]; };\n"
         "layout(std430, binding = 1) writeonly buffer Results { float test_results[]; };\n"
         "uniform int test_cases;\n" +
         declarations + source +
         "vec3 at(int k) {\n"
         "  int i = 3 * (int(gl_GlobalInvocationID.x) * " +
         std::to_string(width) +
         " + k);\n"
         "  return vec3(test_inputs[i], test_inputs[i + 1], test_inputs[i + 2]);\n"
         "}\n"
         "vec3 test_body() {\n" +
         body +
         "\n}\n"
         "void main() {\n"
         "  int i = int(gl_GlobalInvocationID.x);\n"
         "  if (i >= test_cases) return;\n"
         "  vec3 result = test_body();\n"
         "  for (int c = 0; c < 3; ++c) test_results[3 * i + c] = result[c];\n"
         "}\n";
}

/// Of a shader or a program.
template <typename Get, typename Log>
void check_built(GLuint id, GLenum what, Get get, Log log) {
  GLint fine = 0;
  get(id, what, &fine);
  if (fine != 0) return;
  std::string words(4096, '\0');
  GLsizei length = 0;
  log(id, static_cast<GLsizei>(words.size()), &length, words.data());
  words.resize(static_cast<std::size_t>(length));
  throw std::runtime_error("the shader does not compile: " + words);
}

GLuint built_program(const std::string& text) {
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  const char* lines = text.c_str();
  glShaderSource(shader, 1, &lines, nullptr);
  glCompileShader(shader);
  check_built(shader, GL_COMPILE_STATUS, glGetShaderiv, glGetShaderInfoLog);
  const GLuint program = glCreateProgram();
  glAttachShader(program, shader);
  glLinkProgram(program);
  check_built(program, GL_LINK_STATUS, glGetProgramiv, glGetProgramInfoLog);
  glDeleteShader(shader);
  return program;
}

GLuint bound_buffer(GLuint binding, std::size_t floats, const void* data) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(floats * sizeof(float)), data,
               GL_STATIC_DRAW);
  return buffer;
}

}  // namespace

GlCompute::GlCompute() {
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  if (dlopen("libEGL.so.1", RTLD_LAZY) == nullptr) no_egl("libEGL.so.1 is missing");  // libepoxy would abort
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    no_egl("EGL has no surfaceless platform");
  display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) == EGL_FALSE)
    no_egl("EGL does not start");
  const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
      eglChooseConfig(display_, wanted, &config, 1, &configs) == EGL_FALSE || configs == 0)
    no_egl("EGL has no desktop OpenGL");
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                            4,
                            EGL_CONTEXT_MINOR_VERSION,
                            5,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
  if (context_ == EGL_NO_CONTEXT ||
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
    no_egl("EGL has no OpenGL 4.5");
}

GlCompute::~GlCompute() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

void GlCompute::add_texture(const std::string& name, const FloatImage& image, Border border) {
  std::erase_if(textures_, [&](const Texture& texture) {
    if (texture.name == name) glDeleteTextures(1, &texture.id);
    return texture.name == name;
  });
  Texture texture{name, 0};
  glGenTextures(1, &texture.id);
  glBindTexture(GL_TEXTURE_2D, texture.id);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, axis, border == Border::wrap ? GL_REPEAT : GL_CLAMP_TO_EDGE);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, image.width(), image.height(), 0, GL_RGB, GL_FLOAT,
               image.data().data());
  textures_.push_back(texture);
}

std::vector<Vec3> GlCompute::run(const std::string& source, const std::string& body, std::size_t width,
                                 std::span<const Vec3> inputs) {
  const std::size_t cases = inputs.size() / width;
  std::string declarations;
  for (const Texture& texture : textures_) declarations += "uniform sampler2D " + texture.name + ";\n";
  const GLuint program = built_program(around(declarations, source, body, width));
  glUseProgram(program);
  glUniform1i(glGetUniformLocation(program, "test_cases"), static_cast<GLint>(cases));
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    glBindTexture(GL_TEXTURE_2D, textures_[i].id);
    glUniform1i(glGetUniformLocation(program, textures_[i].name.c_str()), static_cast<GLint>(i));
  }
  const GLuint buffers[] = {bound_buffer(0, inputs.size() * 3, inputs.data()),
                            bound_buffer(1, cases * 3, nullptr)};
  glDispatchCompute(static_cast<GLuint>((cases + group_size - 1) / group_size), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<Vec3> results(cases);
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(cases * sizeof(Vec3)),
                     results.data());
  glDeleteBuffers(2, buffers);
  glDeleteProgram(program);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    throw std::runtime_error("OpenGL error " + std::to_string(error));
  return results;
}

}  // namespace rnmbake
