// Do animations put a glTF scene's nodes where they start, and do its cameras see what they should?
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "gltf_sample.hpp"

using namespace halfspace;
using namespace halfspace::test;
using nlohmann::json;

namespace {

using Lines = std::vector<std::string>;

struct AnimatedSample : GltfSample {
  AnimatedSample() : GltfSample(quad_sample()) {}

  /// One more animation, of one channel.
  void animate(const std::string& path, int times, int values, const std::string& interpolation = "LINEAR",
               int animated_node = 0) {
    const json target = {{"node", animated_node}, {"path", path}};
    const json sampler = {{"input", times}, {"output", values}, {"interpolation", interpolation}};
    root["animations"].push_back({{"channels", json::array({{{"sampler", 0}, {"target", target}}})},
                                  {"samplers", json::array({sampler})}});
  }

  void check(const Rect& rect) const {
    const Mesh mesh = read();
    CHECK(drawn(mesh) == corners_of({rect}));
    CHECK(picture(mesh) == picture_of({rect}));
  }
};

Camera camera_of(const std::string& name, std::uint32_t width, std::uint32_t height) {
  Camera camera;
  camera.of_mesh = name;
  camera.width = width;
  camera.height = height;
  return camera;
}

/// Clip coordinates of the corners, by the file's camera.
std::vector<glm::vec4> seen_by(const Mesh& mesh, const std::string& camera, std::uint32_t width,
                               std::uint32_t height) {
  const Frame frame = frame_from_mesh(mesh, camera_of(camera, width, height), "f");
  std::vector<glm::vec4> out;
  for (const std::uint32_t index : frame.indices) out.push_back(frame.vertices.at(index));
  return out;
}

GltfSample camera_sample(const json& camera, const json& node) {
  GltfSample sample = quad_sample();
  json object = node;
  object["camera"] = 0;
  sample.root["nodes"].push_back(object);
  sample.root["scenes"][0]["nodes"] = {0, 1};
  sample.root["cameras"] = json::array({camera});
  return sample;
}

const json kPerspective = {
    {"type", "perspective"},
    {"perspective", {{"yfov", 2 * std::atan(1.0)}, {"aspectRatio", 1}, {"znear", 1}, {"zfar", 9}}}};

std::string camera_error(const GltfSample& sample, const std::string& camera) {
  return error_of([&] { return frame_from_mesh(sample.read(), camera_of(camera, 100, 100), "f"); });
}

}  // namespace

TEST_CASE("glTF animations: a node's properties at t = 0") {
  AnimatedSample sample;
  sample.node()["translation"] = {9, 9, 9};
  const int times = sample.add("SCALAR", std::vector<float>{0, 1});
  SECTION("the first key is at 0") {
    sample.animate("translation", times, sample.add("VEC3", std::vector<float>{1, -1, 0, 5, 5, 5}));
    sample.check({0, -2, 2, 0});
  }
  SECTION("the first key is later: its value holds before") {
    const int later = sample.add("SCALAR", std::vector<float>{10, 11});
    const std::string interpolation = GENERATE("LINEAR", "STEP");
    sample.animate("translation", later, sample.add("VEC3", std::vector<float>{1, -1, 0, 5, 5, 5}),
                   interpolation);
    sample.check({0, -2, 2, 0});
  }
  SECTION("a cubic spline: a key is a tangent, a value and a tangent") {
    const std::vector<float> keys{7, 7, 7, 1, -1, 0, 8, 8, 8, 7, 7, 7, 5, 5, 5, 8, 8, 8};
    sample.animate("translation", times, sample.add("VEC3", keys), "CUBICSPLINE");
    sample.check({0, -2, 2, 0});
  }
  SECTION("scale and rotation, as floats and as fractions; what is not animated stays") {
    sample.animate("scale", times, sample.add("VEC3", std::vector<float>{2, 0.5f, 1, 1, 1, 1}));
    sample.node()["translation"] = {1, 0, 0};
    sample.check({-1, -0.5, 3, 0.5});
    sample.animate("rotation", times, sample.add("VEC4", std::vector<float>{0, 0, 1, 0, 0, 0, 0, 1}));
    const std::vector<glm::dvec3> half_turn{{3, 0.5, 0}, {-1, 0.5, 0},  {-1, -0.5, 0},
                                            {3, 0.5, 0}, {-1, -0.5, 0}, {3, -0.5, 0}};
    CHECK(drawn(sample.read()) == half_turn);
    sample.root["animations"][1]["samplers"][0]["output"] =
        sample.add("VEC4", std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 0, 127}, {{"normalized", true}});
    CHECK(drawn(sample.read()) == half_turn);
  }
  SECTION("weights of morph targets") {
    sample.node()["translation"] = {0, 0, 0};
    sample.node()["weights"] = {0, 0};
    const auto all = [&](float x, float y) {
      return sample.add("VEC3", std::vector<float>{x, y, 0, x, y, 0, x, y, 0, x, y, 0});
    };
    const int first = all(1, 0);
    const int second = all(0, 1);
    sample.primitive()["targets"] = {{{"POSITION", first}}, {{"POSITION", second}}};
    sample.animate("weights", times, sample.add("SCALAR", std::vector<float>{1, -2, 0, 0}));
    sample.check({0, -3, 2, -1});
    sample.root["animations"][0]["samplers"][0] = {
        {"input", times},
        {"output", sample.add("SCALAR", std::vector<float>{9, 9, 1, -2, 9, 9, 9, 9, 0, 0, 9, 9})},
        {"interpolation", "CUBICSPLINE"}};
    sample.check({0, -3, 2, -1});
  }
  SECTION("joints of a skin") {
    sample.root["nodes"].push_back(json::object());
    sample.root["scenes"][0]["nodes"] = {0, 1};
    sample.attributes()["JOINTS_0"] = sample.add_bare<std::uint8_t>("VEC4", 4);  // zeros
    sample.attributes()["WEIGHTS_0"] =
        sample.add("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    sample.node()["skin"] = 0;
    sample.root["skins"] = json::array({{{"joints", json::array({1})}}});
    sample.animate("translation", times, sample.add("VEC3", std::vector<float>{2, 0, 0, 0, 0, 0}), "LINEAR",
                   1);
    sample.check({1, -1, 3, 1});
  }
}

TEST_CASE("glTF animations: those that do not contradict play at once, the others are left out and said") {
  AnimatedSample sample;
  const int times = sample.add("SCALAR", std::vector<float>{0});
  sample.animate("translation", times, sample.add("VEC3", std::vector<float>{1, 0, 0}));
  sample.animate("translation", times, sample.add("VEC3", std::vector<float>{5, 5, 5}));
  sample.animate("scale", times, sample.add("VEC3", std::vector<float>{2, 1, 1}));
  sample.root["animations"][2]["channels"].push_back(
      {{"sampler", 0}, {"target", {{"path", "pointer"}}}});  // KHR_animation_pointer
  sample.root["animations"][2]["channels"].push_back({{"sampler", 0}, {"target", {{"path", "rotation"}}}});
  sample.check({-1, -1, 3, 1});
  CHECK(sample.read().left_out == Lines{"animation channels that name their target by a pointer (1)",
                                        "animations that move what an earlier one moves (1)"});
}

TEST_CASE("glTF cameras: perspectives are the specification's matrices") {
  json camera = kPerspective;
  const json node = {
      {"name", "front"}, {"translation", {0, 0, 4}}, {"scale", {5, 5, 5}}};  // scale is ignored
  const glm::vec4 corner(-1, -1, 0, 4);  // of the square: (-1, -1, -4) seen from the camera
  SECTION("finite: z = (-4 (f + n) / (n - f) + 2 f n / (n - f)") {
    const auto seen = seen_by(camera_sample(camera, node).read(), "front", 100, 100);
    CHECK(seen[0].x == Approx(corner.x));
    CHECK(seen[0].y == Approx(corner.y));
    CHECK(seen[0].w == Approx(corner.w));
    CHECK(seen[0].z == Approx((-4.0 * 10 + 18) / -8));
  }
  SECTION("infinite: z = 4 - 2 n") {
    camera["perspective"].erase("zfar");
    const auto seen = seen_by(camera_sample(camera, node).read(), "0", 100, 100);
    CHECK(seen[0].z == Approx(2));
    CHECK(seen[0].w == Approx(4));
  }
  SECTION("another aspect ratio than the picture's shows more at two sides") {
    const Mesh mesh = camera_sample(camera, node).read();
    CHECK(seen_by(mesh, "front", 200, 100)[0].x == Approx(-0.5));
    CHECK(seen_by(mesh, "front", 200, 100)[0].y == Approx(-1));
    CHECK(seen_by(mesh, "front", 100, 200)[0].x == Approx(-1));
    CHECK(seen_by(mesh, "front", 100, 200)[0].y == Approx(-0.5));
  }
  SECTION("none: the picture's") {
    camera["perspective"].erase("aspectRatio");
    CHECK(seen_by(camera_sample(camera, node).read(), "front", 100, 200)[0].x == Approx(-2));
    CHECK(seen_by(camera_sample(camera, node).read(), "front", 100, 200)[0].y == Approx(-1));
  }
  SECTION("a turned camera, below a parent: from (4, 0, 0) along -x") {
    GltfSample sample = camera_sample(camera, {{"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}});
    sample.root["nodes"].push_back({{"children", json::array({1})}, {"translation", {4, 0, 0}}});
    sample.root["scenes"][0]["nodes"] = {0, 2};
    const auto seen = seen_by(sample.read(), "camera 0", 100, 100);
    CHECK(seen[0].x == Approx(0).margin(1e-6));  // its x is the world's -z
    CHECK(seen[0].y == Approx(-1));
    CHECK(seen[0].w == Approx(5));  // (-1, -1, 0)
    CHECK(seen[1].w == Approx(3));  // (1, -1, 0)
  }
}

TEST_CASE("glTF cameras: parallel projections, and a picture") {
  const json camera = {{"type", "orthographic"},
                       {"orthographic", {{"xmag", 4}, {"ymag", 2}, {"znear", 1}, {"zfar", 5}}}};
  const Mesh mesh = camera_sample(camera, {{"translation", {0, 0, 4}}}).read();
  const auto seen = seen_by(mesh, "camera 0", 200, 100);
  CHECK(seen[0].x == Approx(-0.25));
  CHECK(seen[0].y == Approx(-0.5));
  CHECK(seen[0].z == Approx((2 * -4.0 + 6) / -4));  // 2 z / (n - f) + (f + n) / (n - f)
  CHECK(seen[0].w == 1);
  CHECK(seen_by(mesh, "camera 0", 100, 100)[0].y == Approx(-0.25));  // as wide, and twice as high
  CHECK(seen_by(mesh, "camera 0", 400, 100)[0].x == Approx(-0.125));

  // The camera of picture(), as one of the file.
  const Mesh same = camera_sample(kPerspective, {{"translation", {0, 0, 4}}}).read();
  const FrameResult result = run_functional(frame_from_mesh(same, camera_of("0", 32, 32), "f"), {});
  std::string pixels;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) pixels += result.surfaces.at(0).fragments.at(x, y) == 0 ? '.' : '1';
    pixels += '\n';
  }
  CHECK(pixels == picture_of({{-1, -1, 1, 1}}));
}

TEST_CASE("glTF cameras: names, numbers and what makes no picture") {
  GltfSample sample = camera_sample(kPerspective, {{"name", "a"}, {"translation", {0, 0, 4}}});
  sample.root["nodes"].push_back({{"camera", 1}, {"translation", {0, 0, -4}}});
  sample.root["nodes"].push_back({{"camera", 1}, {"translation", {0, 0, 9}}});
  sample.root["cameras"].push_back(kPerspective);
  sample.root["cameras"][1]["name"] = "b";
  sample.root["scenes"][0]["nodes"] = {0, 1, 2, 3};
  const Mesh mesh = sample.read();
  CHECK(frame_from_mesh(mesh, {}, "f").cameras == Lines{"a", "b", "b"});
  CHECK(camera_error(sample, "a") == "no error");
  CHECK(seen_by(mesh, "2", 100, 100)[0].w == Approx(9));
  CHECK(camera_error(sample, "b") == "f: camera is \"b\", the name of several; legal: a number of 1, 2");
  CHECK(camera_error(sample, "1") == "f: camera \"b\" has the whole mesh behind it; legal: some in front");
  for (const std::string wanted : {"c", "3", "-1", "1x", ""}) {
    CHECK(camera_error(sample, wanted) ==
          "f: camera is \"" + wanted + "\"; legal: 0 \"a\", 1 \"b\", 2 \"b\"");
  }
  CHECK(camera_error(quad_sample(), "0") == "f: camera is \"0\"; legal: none, since the file has no cameras");

  const auto with = [](const json& change) {
    json camera = kPerspective;
    camera.merge_patch({{"perspective", change}});
    return camera_error(camera_sample(camera, {{"translation", {0, 0, 4}}}), "0");
  };
  CHECK(with({{"yfov", 0}}) == "f: camera \"camera 0\": yfov is 0; legal: above 0 and below pi");
  CHECK(with({{"yfov", 4}}) == "f: camera \"camera 0\": yfov is 4; legal: above 0 and below pi");
  CHECK(with({{"aspectRatio", -1}}) == "f: camera \"camera 0\": aspectRatio is -1; legal: above 0");
  CHECK(with({{"znear", 0}}) == "f: camera \"camera 0\": znear is 0; legal: above 0");
  CHECK(with({{"zfar", 1}}) == "f: camera \"camera 0\": zfar is 1; legal: above znear, 1");
  CHECK(with({{"yfov", nullptr}}) == "f: camera 0 perspective: yfov is missing; legal: a number");
  const auto at = [](const json& node) { return camera_error(camera_sample(kPerspective, node), "0"); };
  CHECK(at({{"scale", {1, 0, 1}}}) ==
        "f: camera \"camera 0\": an axis is (0, 0, 0); legal: finite numbers, not all 0");
  CHECK(at({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 1}}}) ==
        "f: camera \"camera 0\": its y and z axis are parallel; legal: two directions");
  CHECK(at({{"translation", {1e308, 0, 4}}}).find("clip space") != std::string::npos);
}
