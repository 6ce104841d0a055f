#pragma once
#include <array>

#include "pipeline/calibrate/board_adjustment.h"
#include "pipeline/calibrate/projection.h"

// Normal equations of board_adjustment.h.
namespace dressform::board_equations {

// Unknowns that all views share: infrared camera, colour camera, step from infrared to colour, depth offset. A view's
// pose comes after them.
constexpr int ir_at = 0, color_at = 9, step_at = 18, offset_at = 24, shared = 25, pose_at = shared;

using Vector = Eigen::Matrix<double, shared + 6, 1>;

// Of one view.
struct ViewEquations {
  Eigen::Matrix<double, shared + 6, shared + 6> matrix;
  Vector right;
  double cost = 0;

  ViewEquations() { matrix.setZero(), right.setZero(); }

  // One scalar residual with its gradient.
  void add(double residual, const Vector& gradient, double weight) {
    matrix.selfadjointView<Eigen::Lower>().rankUpdate(gradient, weight);
    right -= weight * residual * gradient;
  }
};

// Scatter of the corners in each camera, by which they are weighted.
struct CornerSigmas {
  double ir_px = 1, color_px = 1;
};

// One for each view, on all threads.
std::vector<ViewEquations> view_equations(const SensorBoards& boards, const AdjustOptions& options,
                                          const CornerSigmas& sigmas, const BoardSolution& at);

// What is believed of Kinects before any board is seen, as equations without a pose.
ViewEquations prior_equations(const AdjustOptions& options, const BoardSolution& at);

// Which of the shared unknowns move.
std::array<bool, shared> moving_unknowns(const AdjustOptions& options, const BoardSolution& at);

}  // namespace dressform::board_equations
