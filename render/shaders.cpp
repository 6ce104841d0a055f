#include "render/shaders.h"

#include <stdexcept>

namespace dressform {
namespace {

constexpr char kVertex[] = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 extra;
uniform mat4 clip_from_item;
uniform mat4 camera_from_item;
uniform mat3 camera_from_item_rotation;
uniform float point_size_px_m;
centroid out vec3 camera_normal;
centroid out vec3 camera_position;
centroid out vec3 value;
void main() {
  gl_Position = clip_from_item * vec4(position, 1.0);
  camera_position = (camera_from_item * vec4(position, 1.0)).xyz;
  camera_normal = camera_from_item_rotation * normal;
  value = extra;
  gl_PointSize = clamp(point_size_px_m / max(camera_position.z, 0.01), 1.5, 12.0);
}
)";

// `shade` is the body of each shading. Light is added up in linear light; a soft key from the upper left, a weak fill
// from the right and light from all sides, all fixed to the camera, so that folds show without hard shadows.
constexpr char kFragmentHead[] = R"(#version 450 core
centroid in vec3 camera_normal;
centroid in vec3 camera_position;
centroid in vec3 value;
uniform sampler2D image;
uniform vec3 color;
uniform float opacity;
uniform float scalar_grey;
layout(location = 0) out vec4 result;
vec3 linear_from_srgb(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }
vec3 srgb_from_linear(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
float wrapped(vec3 n, vec3 light) {
  float cosine = 0.5 + 0.5 * dot(n, normalize(light));
  return cosine * cosine;
}
float light_on(vec3 n) {
  float sky = 0.5 - 0.5 * n.y;
  return 0.10 + 0.14 * sky + 0.78 * wrapped(n, vec3(-0.75, -0.8, -1.0)) + 0.14 * wrapped(n, vec3(1.0, -0.1, -0.4));
}
vec3 facing_normal(bool front) { return normalize(front ? camera_normal : -camera_normal); }
float inside(bool front) { return front ? 1.0 : 0.42; }
vec3 lit(vec3 srgb, bool front) {
  return srgb_from_linear(linear_from_srgb(srgb) * light_on(facing_normal(front)) * inside(front));
}
)";
constexpr char kFragmentTail[] = R"(
void main() { result = vec4(shade(gl_FrontFacing), opacity); }
)";
// Points are discs, always seen from the front.
constexpr char kPointTail[] = R"(
void main() {
  if (length(gl_PointCoord - 0.5) > 0.5) discard;
  result = vec4(shade(true), opacity);
}
)";

constexpr char kTextured[] = "vec3 shade(bool front) { return lit(texture(image, value.xy).rgb, front); }";
constexpr char kUnlit[] = "vec3 shade(bool front) { return texture(image, value.xy).rgb; }";
constexpr char kShaded[] = "vec3 shade(bool front) { return lit(color, front); }";
// x right, y up, z to the viewer as red, green, blue.
constexpr char kNormals[] = R"(
vec3 shade(bool front) {
  return (0.5 + 0.5 * vec3(1.0, -1.0, -1.0) * facing_normal(front)) * (front ? 1.0 : 0.6);
})";
// The line is one pixel wide wherever the edge lies, and fainter where triangles are only a few pixels high; the faces
// are a pale tint of it and hide what is behind.
constexpr char kWireframe[] = R"(
vec3 shade(bool front) {
  vec3 edge = smoothstep(vec3(0.4), vec3(1.2), value / fwidth(value));
  vec3 face = lit(mix(vec3(1.0), color, 0.15), front);
  vec3 height_px = 1.0 / fwidth(value);
  float strength = clamp(min(height_px.x, min(height_px.y, height_px.z)) / 6.0, 0.2, 1.0);
  return mix(face, color * 0.6, strength * (1.0 - min(edge.x, min(edge.y, edge.z))));
})";
// Faces turned away from the viewer are a little darker, those towards it have exactly the colour of the bar.
constexpr char kScalar[] = R"(
vec3 shade(bool front) {
  float row = (clamp(value.x, 0.0, 1.0) * 255.0 + 0.5) / 256.0;
  vec3 srgb = value.y > 0.999 ? texture(image, vec2(0.5, row)).rgb : vec3(scalar_grey);
  float facing = abs(dot(normalize(camera_normal), normalize(camera_position)));
  return srgb * (0.7 + 0.3 * smoothstep(0.0, 0.8, facing)) * (front ? 1.0 : 0.7);
})";
constexpr char kScalarPoints[] = R"(
vec3 shade(bool front) {
  float row = (clamp(value.x, 0.0, 1.0) * 255.0 + 0.5) / 256.0;
  return value.y > 0.999 ? texture(image, vec2(0.5, row)).rgb : vec3(scalar_grey);
})";
constexpr char kPoints[] = R"(
vec3 shade(bool front) {
  float facing = length(camera_normal) > 0.5 ? abs(dot(normalize(camera_normal), normalize(camera_position))) : 1.0;
  return value * (0.6 + 0.4 * facing);
})";
constexpr char kCoverage[] = "vec3 shade(bool front) { return vec3(1.0); }";

const char* body_of(Shading shading, bool of_points) {
  static const std::map<Shading, const char*> bodies{{Shading::textured, kTextured},   {Shading::unlit, kUnlit},
                                                     {Shading::shaded, kShaded},       {Shading::normals, kNormals},
                                                     {Shading::wireframe, kWireframe}, {Shading::scalar, kScalar},
                                                     {Shading::points, kPoints}};
  return of_points && shading == Shading::scalar ? kScalarPoints : bodies.at(shading);
}

unsigned compile(GlContext& context, GLenum kind, const std::string& source) {
  const Gl& gl = context.gl;
  const unsigned shader = gl.CreateShader(kind);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  int good = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  char log[2048] = "";
  gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
  throw std::runtime_error(std::string("shader: ") + log);
}

}  // namespace

Program::Program(GlContext& context, const std::string& vertex_source, const std::string& fragment_source)
    : context_(context) {
  const Gl& gl = context.gl;
  const unsigned vertex = compile(context, GL_VERTEX_SHADER, vertex_source);
  const unsigned fragment = compile(context, GL_FRAGMENT_SHADER, fragment_source);
  program_ = gl.CreateProgram();
  gl.AttachShader(program_, vertex);
  gl.AttachShader(program_, fragment);
  gl.LinkProgram(program_);
  gl.DeleteShader(vertex);
  gl.DeleteShader(fragment);
  int good = 0;
  gl.GetProgramiv(program_, GL_LINK_STATUS, &good);
  if (good) return;
  char log[2048] = "";
  gl.GetProgramInfoLog(program_, sizeof log, nullptr, log);
  throw std::runtime_error(std::string("shader program: ") + log);
}

Program::~Program() { context_.gl.DeleteProgram(program_); }
void Program::use() { context_.gl.UseProgram(program_); }
void Program::set(const char* name, float value) { context_.gl.Uniform1f(location(name), value); }
void Program::set(const char* name, const Eigen::Vector3f& value) {
  context_.gl.Uniform3f(location(name), value.x(), value.y(), value.z());
}
void Program::set(const char* name, const Eigen::Matrix3f& value) {
  context_.gl.UniformMatrix3fv(location(name), 1, GL_FALSE, value.data());
}
void Program::set(const char* name, const Eigen::Matrix4f& value) {
  context_.gl.UniformMatrix4fv(location(name), 1, GL_FALSE, value.data());
}

Program& Programs::shading(Shading shading, bool of_points) {
  return program(std::to_string(static_cast<int>(shading)), body_of(shading, of_points), of_points);
}

Program& Programs::coverage(bool of_points) { return program("coverage", kCoverage, of_points); }

Program& Programs::program(const std::string& name, const std::string& fragment_body, bool of_points) {
  auto& slot = programs_[name + (of_points ? "_points" : "")];
  if (!slot)
    slot = std::make_unique<Program>(context_, kVertex,
                                     kFragmentHead + fragment_body + (of_points ? kPointTail : kFragmentTail));
  return *slot;
}

}  // namespace dressform
