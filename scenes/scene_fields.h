#pragma once
#include "scenes/scene.h"

namespace dressform {

// The plain fields of a scene, each described once (scenes/fields.h). Paths and vectors are read in scene.cpp.

template <class V>
void fields(V& v, BodySpec& body) {
  v("sex", body.sex, {"male", "female"}, "proportions of the procedural body");
  v("stature_m", body.stature_m, 1.0, 2.3, "m", "height from floor to crown");
  v("chest_m", body.chest_m, 0.5, 1.8, "m", "tape girth round the chest, arms left out");
  v("waist_m", body.waist_m, 0.4, 1.8, "m", "tape girth round the waist");
  v("hip_m", body.hip_m, 0.5, 1.8, "m", "tape girth round the hip");
  v("inseam_m", body.inseam_m, 0.0, 1.3, "m", "height of the crotch; 0: what people of these measures have");
  v("knee_height_m", body.knee_height_m, 0.0, 0.8, "m", "height of the middle of the kneecap; 0: likewise");
  v("upper_arm_m", body.upper_arm_m, 0.0, 0.6, "m", "shoulder point to elbow; 0: likewise");
  v("forearm_m", body.forearm_m, 0.0, 0.5, "m", "elbow to wrist; 0: likewise");
  v("neck_m", body.neck_m, 0.0, 0.6, "m", "girth of the neck; 0: likewise");
  v("chin_m", body.chin_m, 0.0, 0.08, "m", "how far jaw and chin jut forward and down, beyond the usual");
  v("bow_deg", body.bow_deg, 0.0, 35.0, "deg", "how far the head is bowed");
  v("hunch_m", body.hunch_m, 0.0, 0.15, "m", "how far neck and head stand forward of an upright back");
  v("sample", body.sample, {"", "man", "woman"}, "draws stature and girths from the survey instead of asking for them");
  v("sample_seed", body.sample_seed, 0, 1000000000, "", "number of the drawn customer");
  v("pose", body.pose, {"mannequin", "a_pose", "bent_arms", "one_arm_bent"}, "how the arms are held");
  v("arm_angle_deg", body.arm_angle_deg, 0.0, 60.0, "deg", "upper arms out from the vertical; 0: the pose's own");
}

template <class V>
void fields(V& v, PrintSpec& print) {
  v("kind", print.kind, {}, "plain, stars, characters, stripes, plaid, denim, weave, all_over, complex or noise");
  v("text", print.text, {}, "characters to print, for kinds that print text");
}

template <class V>
void fields(V& v, GarmentSpec& garment) {
  v("name", garment.name, {}, "for the report: \"shirt 1\"");
  v("kind", garment.kind, {"shirt", "trousers", "skirt", "dress"}, "what it is; tells the slot and the openings");
  v("sleeve", garment.sleeve, 0.0, 1.0, "", "part of the arm from shoulder to wrist that is covered");
  v("length", garment.length, 0.25, 1.1, "",
    "trousers, skirts, dresses: part of the way from waist to ankle; trousers beyond 1 fall on the foot");
  v("hem_below_waist_m", garment.hem_below_waist_m, 0.0, 0.6, "m", "shirts: how far the hem hangs below the waist");
  v("neck", garment.neck, {"round", "v"}, "shirts, dresses: form of the neckline");
  v("neck_depth_m", garment.neck_depth_m, 0.04, 0.25, "m",
    "shirts, dresses: how deep the neckline or a hood's opening is in front; polo: length of the slit");
  v("collar", garment.collar, {"none", "polo", "hood"},
    "shirts, dresses: what is sewn to the neck; none, a turned-down collar, a hood worn up");
  v("tucked", garment.tucked, "shirts: worn inside the trousers or the skirt");
  v("hem_slant", garment.hem_slant, -0.5, 0.5, "", "rise of the hem per metre towards the front");
  v("waist_offset_m", garment.waist_offset_m, -0.12, 0.06, "m",
    "trousers, skirts: how far above the waist they are worn");
  v("ease_m", garment.ease_m, 0.0, 0.5, "m", "garment girth minus body girth, at chest (tops) or hip (bottoms)");
  v("fullness", garment.fullness, 0.0, 0.3, "", "cloth beyond the smooth shape, part of its width: it falls in folds");
  v("flare", garment.flare, 0.0, 1.5, "", "skirts, dresses: how much wider the hem is cut than it hangs");
  v("bending_length_m", garment.bending_length_m, 0.01, 0.08, "m",
    "over which a strip of the cloth bends by its weight");
  v("cloth_edge_m", garment.cloth_edge_m, 0.005, 0.02, "m", "edge of the triangles that the cloth is made of");
}

template <class V>
void fields(V& v, RoomSpec& room) {
  v("width_m", room.width_m, 2.0, 20.0, "m", "size along x");
  v("depth_m", room.depth_m, 2.0, 20.0, "m", "size along z");
  v("height_m", room.height_m, 2.0, 10.0, "m", "size along y");
  v("furniture", room.furniture, "whether things stand along the walls");
}

template <class V>
void fields(V& v, ScanSpec& scan) {
  v("frames", scan.frames, 1, 2000, "", "depth frames of one walk round the body");
  v("radius_m", scan.radius_m, 0.6, 4.0, "m", "distance of the hand-held sensor from the body's axis");
  v("height_m", scan.height_m, 0.2, 2.5, "m", "mean height of the hand-held sensor");
}

template <class V>
void fields(V& v, PriorSpec& prior) {
  v("rotation_deg", prior.rotation_deg, 0.0, 60.0, "deg", "sigma of the rig prior's error, cut at twice that");
  v("translation_m", prior.translation_m, 0.0, 1.0, "m", "sigma of the rig prior's error, cut at twice that");
}

template <class V>
void fields(V& v, BoardsSpec& boards) {
  v("squares_x", boards.squares_x, 3, 100, "", "squares of the pattern along its first side");
  v("squares_y", boards.squares_y, 3, 100, "", "squares of the pattern along its second side");
  v("square_m", boards.square_m, 0.005, 0.5, "m", "edge of one square");
  v("views", boards.views, 1, 100, "", "poses of the board before each sensor");
  v("nearest_m", boards.nearest_m, 0.3, 10.0, "m", "least distance of the board's centre");
  v("farthest_m", boards.farthest_m, 0.3, 10.0, "m", "largest distance of the board's centre");
  v("tilt_deg", boards.tilt_deg, 0.0, 70.0, "deg", "largest angle between the board and the image plane");
}

template <class V>
void fields(V& v, GivenCalibrationSpec& given) {
  v("focal_percent", given.focal_percent, 0.0, 20.0, "%", "sigma of each camera's focal length");
  v("principal_px", given.principal_px, 0.0, 100.0, "px", "sigma of the principal points in x and y");
  v("rotation_deg", given.rotation_deg, 0.0, 20.0, "deg", "sigma of the rotation from infrared to colour");
  v("translation_mm", given.translation_mm, 0.0, 100.0, "mm", "sigma of the step from infrared to colour, each axis");
  v("depth_offset_mm", given.depth_offset_mm, 0.0, 100.0, "mm", "sigma of the depth offset");
  v("distortion", given.distortion, "whether it knows the distortion");
}

template <class V>
void fields(V& v, PickingSpec& picking) {
  v("picks", picking.picks, "whether the session holds what an operator picks by hand");
  v("click_px", picking.click_px, 0.0, 50.0, "px", "sigma of a click on coloured things, in the colour image");
  v("click_mm", picking.click_mm, 0.0, 50.0, "mm", "sigma of a click on bodies");
}

template <class V>
void fields(V& v, Camera& camera) {
  v("width", camera.width, 1, 8192, "px", "columns");
  v("height", camera.height, 1, 8192, "px", "rows");
  v("fx", camera.fx, 1.0, 1e5, "px", "focal length in x");
  v("fy", camera.fy, 1.0, 1e5, "px", "focal length in y");
  v("cx", camera.cx, -8192.0, 16384.0, "px", "principal point, column");
  v("cy", camera.cy, -8192.0, 16384.0, "px", "principal point, row");
}

// Where a sensor stands: round the mannequin's axis, and how it deviates from looking at that axis level.
struct SensorPlace {
  double azimuth_deg = 0, distance_m = 2.1, height_m = 1.25, yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};

template <class V>
void fields(V& v, SensorPlace& place) {
  v("azimuth_deg", place.azimuth_deg, -360.0, 360.0, "deg", "round the axis: 0 in front (+z), 90 at +x");
  v("distance_m", place.distance_m, 0.3, 10.0, "m", "from the axis, level");
  v("height_m", place.height_m, 0.0, 5.0, "m", "above the floor");
  v("yaw_deg", place.yaw_deg, -180.0, 180.0, "deg", "turned to its left, about y");
  v("pitch_deg", place.pitch_deg, -90.0, 90.0, "deg", "looking up");
  v("roll_deg", place.roll_deg, -180.0, 180.0, "deg", "its right side down");
}

// Where the sensor's IR camera stands: on the circle round the world's vertical axis, looking at the axis.
Isometry3d world_from_placed_sensor(const SensorPlace& place);

}  // namespace dressform
