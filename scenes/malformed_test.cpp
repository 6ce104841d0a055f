// Malformed inputs made by seed from sound ones: every reader answers with an InputError that names the file, or reads
// something whole, and leaves nothing behind.
#include <functional>
#include <opencv2/imgcodecs.hpp>

#include "scenes/file_bytes.h"
#include "scenes/image_file.h"
#include "scenes/mesh_io.h"
#include "scenes/random.h"
#include "scenes/scene.h"
#include "scenes/testing/mesh_files.h"

namespace dressform {
namespace {

// Random whole numbers below a bound, in a fixed order.
class Dice {
 public:
  explicit Dice(Seed seed) : seed_(seed) {}
  std::size_t below(std::size_t bound) {
    return std::min(bound - 1, static_cast<std::size_t>(uniform(seed_, stream_of("malformed"), count_++) *
                                                        static_cast<double>(bound)));
  }

 private:
  Seed seed_;
  std::uint64_t count_ = 0;
};

// One fault, of the kinds that broken disks, programs and people make.
std::string mutated(std::string bytes, Dice& dice) {
  const std::size_t at = dice.below(bytes.size()), size = 1 + dice.below(std::min<std::size_t>(40, bytes.size() - at));
  static const char* const words[] = {
      "-1",  "99999999999999999999", "nan", "1e999", "-0.0", "\"", "{",  "]", "\xFF\xFE",
      "abc", "4294967295",           "\\",  "<",     "0x7f", "=",  "\n", ""};
  switch (dice.below(7)) {
    case 0:
      return bytes.substr(0, at);
    case 1:
      return bytes.erase(at, size);
    case 2:
      return bytes.insert(at, bytes.substr(at, size));
    case 3:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice.below(8)));
      return bytes;
    case 4:
      return bytes.replace(at, size, std::string(size, static_cast<char>(dice.below(256))));
    default: {  // a number or word becomes another
      const std::size_t start = bytes.find_first_of("0123456789", at);
      if (start == std::string::npos) return bytes.erase(at, size);
      const std::size_t end = std::min(bytes.find_first_not_of("0123456789.-+e", start), bytes.size());
      return bytes.replace(start, end - start, words[dice.below(std::size(words))]);
    }
  }
}

class Malformed : public FilesTest {
 protected:
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::recursive_directory_iterator(folder_), {}));
  }

  // Reads `count` mutations of a file; `least` of them must be refused.
  void expect_answers(const std::string& name, int count, int least,
                      const std::function<void(const std::filesystem::path&)>& read) {
    const std::string sound = read_file_bytes(file(name));
    ASSERT_NO_THROW(read(file(name)));
    const std::size_t before = files();
    Dice dice(stream_of(name.c_str()));
    int refused = 0;
    for (int i = 0; i < count; ++i) {
      text(name, mutated(sound, dice));
      try {
        read(file(name));
      } catch (const InputError& error) {
        ++refused;
        // A picture that the file names may be what is not there.
        EXPECT_THAT(error.what(), testing::AnyOf(testing::HasSubstr(name), testing::HasSubstr("found no such file")))
            << "mutation " << i;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "mutation " << i << ": " << error.what();
      }
    }
    EXPECT_GE(refused, least) << name;
    EXPECT_EQ(files(), before) << name;
    text(name, sound);
  }

  static void read_whole(const std::filesystem::path& path) {
    const TexturedMesh mesh = read_mesh_as_it_looks(path);
    for (const auto& v : mesh.mesh.vertices) ASSERT_TRUE(v.allFinite());
    for (const auto& t : mesh.mesh.triangles)
      for (int k = 0; k < 3; ++k) ASSERT_TRUE(t[k] >= 0 && t[k] < static_cast<int>(mesh.mesh.vertices.size()));
    if (mesh.texture.empty()) return;
    ASSERT_EQ(mesh.corner_uv.size(), mesh.mesh.triangles.size());
    for (const auto& corners : mesh.corner_uv)
      for (const auto& uv : corners) ASSERT_TRUE(uv.allFinite());
  }
};

TEST_F(Malformed, Meshes) {
  write_obj(file("a.obj"), tube(6, 2));
  write_glb(file("b.glb"), tube(6, 2));
  PlyExtras extras;
  extras.corner_uv = tube(6, 2).corner_uv;
  extras.texture_file = "a.png";
  extras.colors.assign(tube(6, 2).mesh.vertices.size(), Vector3f(1, 0.5f, 0));
  write_ply(file("c.ply"), tube(6, 2).mesh, extras);
  text("d.ply",
       "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 5\nproperty float x\nproperty float y\n"
       "property float z\nproperty float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\n"
       "end_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n0.5 1.5 0 1 1\n4 0 1 2 3\n5 0 1 2 4 3\n");
  expect_answers("a.obj", 150, 60, read_whole);
  expect_answers("b.glb", 150, 60, read_whole);
  expect_answers("c.ply", 150, 30, read_whole);
  expect_answers("d.ply", 150, 80, read_whole);
}

TEST_F(Malformed, LooksOfMeshes) {
  write_obj(file("a.obj"), tube(6, 2));
  const auto read = [&](const std::filesystem::path&) { read_whole(file("a.obj")); };
  text("a.mtl", "newmtl cloth\nKd 1 1 1\nd 1.0\nmap_Kd -s 1 1 1 -o 0 0 0 -bm 1.0 a.png\n");
  const std::string library = read_file_bytes(file("a.mtl"));
  Dice dice(7);
  int refused = 0;
  for (int i = 0; i < 100; ++i) {
    text("a.mtl", mutated(library, dice));
    const std::string message = refusal([&] { read(file("a.mtl")); });
    if (message.empty()) continue;
    ++refused;
    EXPECT_THAT(message, testing::AnyOf(testing::HasSubstr(folder_.string()), testing::HasSubstr("found no such file")))
        << i;
  }
  EXPECT_GE(refused, 40);
  text("a.mtl", library);
  expect_answers("a.png", 100, 90, read);
}

TEST_F(Malformed, Textures) {
  cv::Mat image(40, 60, CV_8UC3);
  cv::randu(image, 0, 256);
  cv::imwrite(file("a.jpg").string(), image);
  cv::imwrite(file("b.png").string(), image);
  const auto read = [](const std::filesystem::path& path) {
    const TextureImage found = decode_texture(path.string(), read_file_bytes(path));
    ASSERT_EQ(found.bgr.type(), CV_8UC3);
  };
  expect_answers("a.jpg", 100, 10, read);  // much damage within a JPEG is still an image
  expect_answers("b.png", 100, 95, read);
}

TEST_F(Malformed, Scenes) {
  text("a.toml",
       "name = \"a\"\n[scan]\nframes = 4\n[scan.sensor]\nir = {width = 512, height = 424, fx = 365.0, fy = 365.0, cx = "
       "256.0, cy = 208.0}\n[[rig.sensor]]\nname = \"k1\"\nazimuth_deg = 0.0\ndistance_m = 2.1\nir = {width = 512, "
       "height "
       "= 424, fx = 365.0, fy = 365.0, cx = 256.0, cy = 208.0}\n[user]\nstature_m = 1.73\n[[garment]]\nkind = "
       "\"shirt\"\n");
  expect_answers("a.toml", 200, 100, [](const std::filesystem::path& path) { read_scene(path); });
}

}  // namespace
}  // namespace dressform
