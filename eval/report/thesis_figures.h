#pragma once
// What the thesis measured: its tables 4 to 7 and 9 to 15, as they are printed. Shirts, trousers and skirts are
// numbered as there; group 4 wears shirt 1, and the skirt stands last among the bottoms.
namespace dressform::thesis_figures {

constexpr int kGroups = 4, kKinects = 4;

struct Intrinsics {
  double fx, fy, cx, cy;
};
constexpr Intrinsics kColor[kKinects] = {{1073.42712, 1068.65364, 940.55748, 531.24323},
                                         {1060.82164, 1058.11634, 1015.60097, 534.45790},
                                         {1080.00537, 1076.44882, 928.65347, 548.47715},
                                         {1123.59558, 1118.93570, 913.59859, 540.25560}};
constexpr Intrinsics kInfrared[kKinects] = {{371.21951, 369.969945, 246.14200, 199.23853},
                                            {365.39024, 364.14578, 268.24005, 211.22079},
                                            {374.46472, 373.23883, 250.24772, 198.72218},
                                            {386.51720, 385.42395, 248.92427, 198.33406}};

struct Step {
  double rotation[9], translation_mm[3];  // infrared to colour, by rows
};
constexpr Step kColorFromInfrared[kKinects] = {
    {{1, -0.0016, -0.0021, 0.0016, 1, -0.0026, 0.0021, 0.0026, 1}, {51.2367, 0.0343, -2.3366}},
    {{1, 0.0035, -0.0074, -0.0035, 1, -0.0018, 0.0074, 0.0018, 1}, {50.4508, -0.3825, 2.8473}},
    {{1, -0.0007, 0.0070, 0.0008, 1, -0.0020, -0.0070, 0.0020, 1}, {51.5690, 0.8662, -2.2158}},
    {{1, 0.0012, 0.0075, -0.0013, 1, 0.0041, -0.0075, -0.0041, 1}, {51.0942, 0.0520, -0.7606}}};

// Model from Kinect, the upper three rows. The frame is that of the thesis's own scan.
constexpr double kModelFromKinect[kKinects][12] = {{0.804483, -0.154376, -0.573563, 0.986309, -0.25353, -0.962498,
                                                    -0.096545, 0.263295, -0.537149, 0.223084, -0.813452, 0.933585},
                                                   {0.608826, -0.195429, 0.768855, -2.03587, -0.0148175, -0.971814,
                                                    -0.235284, 0.662729, 0.793165, 0.131854, -0.594561, 0.192963},
                                                   {-0.819815, -0.205271, 0.534572, -1.6118, 0.220008, -0.974799,
                                                    -0.0369131, 0.219684, 0.528677, 0.0873479, 0.844317, -2.75818},
                                                   {-0.493953, -0.167082, -0.853284, 1.48973, -0.0492965, -0.974403,
                                                    0.219335, -0.365104, -0.86809, 0.150405, 0.473073, -2.21439}};

// Views in the order of the tables.
constexpr const char* kViews[] = {"Front", "Back", "Left", "Right"};
constexpr int kImagePixels = 2073600;
constexpr int kMannequinPixels[kGroups][4] = {{157752, 152397, 325796, 304750},
                                              {146489, 141133, 320119, 282845},
                                              {164941, 156052, 306653, 299784},
                                              {120915, 114728, 271068, 258763}};

struct Garment {
  const char* name;
  int pixels[4], filled_pixels[4];  // tables 10 and 11, by view
  int points, cleaned_points;       // 12 and 13; vertices after Poisson are those of the closed mesh
  int closed_vertices, closed_faces, open_vertices, open_faces;  // 14 and 15
};
constexpr Garment kShirts[] = {
    {"Shirt 1", {65529, 75535, 44521, 39268}, {65529, 75535, 53818, 46448}, 23871, 23555, 21163, 42322, 19089, 37935},
    {"Shirt 2", {63367, 71689, 38463, 38390}, {63367, 71689, 46627, 45224}, 23297, 22699, 21580, 43156, 19595, 39006},
    {"Shirt 3", {79659, 86967, 48921, 44203}, {79659, 86967, 48921, 44203}, 28852, 28288, 23941, 47878, 22321, 44485}};
constexpr Garment kBottoms[] = {
    {"Trouser 1", {58515, 48702, 46295, 38198}, {58515, 48702, 48732, 40251}, 21769, 20787, 15473, 30942, 14165, 28170},
    {"Trouser 2", {39893, 35195, 26347, 22102}, {39893, 35195, 28663, 24509}, 13047, 12965, 13181, 26358, 11895, 23669},
    {"Trouser 3", {62298, 58711, 50474, 45694}, {62298, 58711, 52983, 48852}, 23774, 23232, 16325, 32646, 14807, 29510},
    {"Skirt", {26609, 22060, 19620, 15906}, {26609, 22060, 22771, 18186}, 9360, 9307, 7117, 14230, 6026, 11802}};
constexpr int kShirtOfGroup[kGroups] = {0, 1, 2, 0}, kBottomOfGroup[kGroups] = {0, 1, 2, 3};

}  // namespace dressform::thesis_figures
