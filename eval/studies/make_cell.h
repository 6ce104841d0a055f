#pragma once
#include "eval/studies/run_cells.h"

namespace dressform {

// Makes cells by the whole pipeline: capture (or the recording), stages, scores. All cells share the artifact store, so
// that variants of late stages share what lies before them.
MakeCell pipeline_cells(const std::filesystem::path& study, const std::filesystem::path& store, int threads);

}  // namespace dressform
