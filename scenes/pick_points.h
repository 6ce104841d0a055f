#pragma once
#include <string>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

// Texts of the programs that points are picked with. Numbers are read whatever the locale. `where` names the file in
// errors; each throws InputError with line, what was found and what was expected. At most kMostPickedPoints points.
constexpr int kMostPickedPoints = 100000;
constexpr std::size_t kMostPickBytes = std::size_t(1) << 24;  // of a file of points

// MeshLab's PickPoints (.pp, XML). Points of a template that were not placed (active="0") are left out.
std::vector<Vector3d> points_of_pick_points(const std::string& where, const std::string& text);

// CloudCompare's point lists and ASCII clouds: lines `x,y,z` or `label,x,y,z`, separated by commas, semicolons, tabs or
// blanks; empty lines and those that begin with // are passed over.
std::vector<Vector3d> points_of_list(const std::string& where, const std::string& text);

// The same points as MeshLab writes them; they read back bit for bit.
std::string pick_points_text(const std::vector<Vector3d>& points);

}  // namespace dressform
