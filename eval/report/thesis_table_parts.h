#pragma once
#include <optional>
#include <string>
#include <vector>

#include "eval/report/thesis_figures.h"
#include "eval/report/thesis_tables.h"

namespace dressform {

// What the tables share; private to thesis_tables*.cpp.

// "group2" -> 1; -1 for a scene that is none of the thesis's.
int thesis_group_of(const RunCounts& run);
// The number of a sensor as one of the thesis's Kinects; -1 where the rig is not one of four.
int thesis_kinect_of(const RunCounts& run, const std::string& sensor);
// What the first columns of a sensor's row say: the run, and the sensor with its Kinect.
std::vector<std::string> sensor_names(const RunCounts& run, const std::string& sensor);

// Figures of one measure, the run's beside the thesis's; "-" where there is none, with the reason where the run has
// none.
ThesisTable::Figure number_figure(const std::string& measure, std::optional<double> value, int decimals,
                                  std::optional<double> thesis, const std::string& reason);
ThesisTable::Figure count_figure(const std::string& measure, std::optional<long long> value,
                                 std::optional<long long> thesis, const std::string& reason);

// Tables 4 to 7: what calibration and registration found.
std::vector<ThesisTable> calibration_tables(const std::vector<RunCounts>& runs);

}  // namespace dressform
