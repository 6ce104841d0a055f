#include "pipeline/multipath/multipath.h"

namespace dressform {
namespace {

struct NoneParams {};
template <class V>
void fields(V&, NoneParams&) {}

// Depth is taken as it was measured.
Multipath none(const CaptureSession&, const Calibration&, const NoneParams&) { return {}; }

const EstimateMultipath::Variant none_variant{"none", none};

}  // namespace
}  // namespace dressform
