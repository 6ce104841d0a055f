#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "render/renderer.h"

namespace dressform {

// One vertex as OpenGL reads it. `extra` is texture coordinates (textured, unlit), value and validity (scalar),
// barycentric coordinates (wireframe) or an RGB colour (points).
struct DrawVertex {
  Eigen::Vector3f position, normal, extra;
};

// What is sent to OpenGL for one item: triangles, or points when there are no indices. Positions are relative to
// the `origin` passed to draw_data, so that single precision suffices far from the world's origin.
struct DrawData {
  std::vector<DrawVertex> vertices;
  std::vector<std::uint32_t> indices;
};

// The mesh of an item, nullptr for points.
const Mesh* mesh_of(const RenderItem& item);

// Throws std::invalid_argument when the members of the item do not belong together (see RenderItem).
void check_item(const RenderItem& item);

// Triangles with an index out of range throw std::invalid_argument; those with a coordinate that is not finite are
// left out.
DrawData draw_data(const RenderItem& item, const Vector3d& origin);

// Box of all finite points of the items; empty (isEmpty()) when there is none.
Eigen::AlignedBox3d bounding_box(const std::vector<RenderItem>& items);

}  // namespace dressform
