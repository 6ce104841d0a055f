#pragma once
#include <map>
#include <string>

#include "render/gl_context.h"
#include "render/renderer.h"

namespace dressform {

// A linked program; uniforms that the program does not use are ignored.
class Program {
 public:
  Program(GlContext& context, const std::string& vertex_source, const std::string& fragment_source);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use();
  void set(const char* name, float value);
  void set(const char* name, const Eigen::Vector3f& value);
  void set(const char* name, const Eigen::Matrix3f& value);
  void set(const char* name, const Eigen::Matrix4f& value);

 private:
  int location(const char* name) const { return context_.gl.GetUniformLocation(program_, name); }
  GlContext& context_;
  unsigned program_ = 0;
};

// The programs of all shadings, compiled when first asked for.
class Programs {
 public:
  explicit Programs(GlContext& context) : context_(context) {}
  Program& shading(Shading shading, bool of_points);
  Program& coverage(bool of_points);

 private:
  Program& program(const std::string& name, const std::string& fragment_body, bool of_points);
  GlContext& context_;
  std::map<std::string, std::unique_ptr<Program>> programs_;
};

}  // namespace dressform
