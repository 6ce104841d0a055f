#include "pipeline/segment/jseg_views.h"

#include <tbb/parallel_for.h>

namespace dressform {

std::vector<LabelMap> jseg_views(const CaptureSession& session, const std::vector<ViewEvidence>& views,
                                 const JsegParams& params) {
  std::vector<LabelMap> maps(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t k) {
    if (views[k].box.empty()) return;
    const JsegResult found = jseg(session.dressed.at(session.sensors[k]).color(views[k].box), views[k].body, params);
    maps[k] = {found.regions, found.region_count};
  });
  return maps;
}

}  // namespace dressform
