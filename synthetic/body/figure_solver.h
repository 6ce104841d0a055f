#pragma once
#include "synthetic/body/mannequin.h"

namespace dressform {

// Corrections to what is asked of the figure's field, for what the mesh cut from it loses. Metres.
struct SolverOffsets {
  double chest = 0, waist = 0, hip = 0, crotch = 0;
};

// The figure whose chest, waist and hip girths and crotch height are those of `sizes.mean` plus the offsets, and whose
// breadths, depths and limb girths are those of `sizes.mean` as nearly as the girths let them. Throws InputError
// when no figure has such girths.
Mannequin solve_figure(const BodySpec& spec, const Prediction& sizes, const SolverOffsets& offsets, FigureShape& shape);

}  // namespace dressform
