#include "halfspace/scene/gltf/primitive.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace halfspace::gltf {
namespace {

/// glTF 2.0, 5.24.4.
enum class Topology : std::uint8_t {
  kPoints = 0,
  kLines = 1,
  kLineLoop = 2,
  kLineStrip = 3,
  kTriangles = 4,
  kStrip = 5,
  kFan = 6
};

halfspace::Primitive kind_of(Topology topology) {
  switch (topology) {
    case Topology::kPoints:
      return halfspace::Primitive::kPoints;
    case Topology::kLines:
      return halfspace::Primitive::kLines;
    case Topology::kLineLoop:
    case Topology::kLineStrip:
      return halfspace::Primitive::kLineStrip;
    case Topology::kTriangles:
    case Topology::kStrip:
    case Topology::kFan:
      break;
  }
  return halfspace::Primitive::kTriangles;
}

/// The corners of points and lines as they are; those of a list that make no line are left out.
std::vector<std::uint32_t> list_others(std::vector<std::uint32_t> order, Topology topology,
                                       MeshBuilder& mesh) {
  if (topology == Topology::kLines && order.size() % 2 != 0) {
    mesh.leave_out("corners that make no line");
    order.pop_back();
  }
  return order;
}

constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Three corners a triangle; the order of a strip's and a fan's corners as in glTF 2.0, 3.7.2.1.
std::vector<std::uint32_t> list_triangles(std::vector<std::uint32_t> order, Topology topology,
                                          MeshBuilder& mesh) {
  const std::size_t rest = topology == Topology::kTriangles ? order.size() % 3
                           : order.size() < 3               ? order.size()
                                                            : 0;
  if (rest > 0) mesh.leave_out("corners that make no triangle", rest);
  order.resize(order.size() - rest);
  if (topology == Topology::kTriangles) return order;
  std::vector<std::uint32_t> out;
  out.reserve(order.empty() ? 0 : 3 * (order.size() - 2));
  for (std::size_t i = 0; i + 2 < order.size(); ++i) {
    const std::size_t odd = i % 2;
    if (topology == Topology::kStrip) {
      out.insert(out.end(), {order[i + odd], order[i + 1 - odd], order[i + 2]});
    } else {
      out.insert(out.end(), {order[0], order[i + 1], order[i + 2]});
    }
  }
  return out;
}

class PrimitiveReader {
 public:
  PrimitiveReader(Source& source, const Object& primitive, std::size_t copies)
      : source_(source), object_(primitive), attributes_(primitive.object("attributes")), copies_(copies) {}

  std::optional<Primitive> run() {
    const std::uint64_t mode = object_.number_or("mode", static_cast<std::uint64_t>(Topology::kTriangles));
    if (mode > static_cast<std::uint64_t>(Topology::kFan)) {
      source_.document.fail("primitive mode is {}; legal: 0 to 6", mode);
    }
    if (!attributes_.has("POSITION")) {
      source_.mesh.leave_out("primitives without positions");
      return std::nullopt;
    }
    open_draco();
    Accessor positions = attribute("POSITION", kPositionUse);
    const auto topology = static_cast<Topology>(mode);
    const bool is_triangles = kind_of(topology) == halfspace::Primitive::kTriangles;
    if (!is_triangles && draco_ != nullptr) {  // the extension has triangles alone
      source_.mesh.leave_out("primitives of points or lines that Draco packs");
      return std::nullopt;
    }
    std::vector<std::uint32_t> corners = draco_ != nullptr ? draco_->corners()
                                         : is_triangles
                                             ? list_triangles(read_order(positions), topology, source_.mesh)
                                             : list_others(read_order(positions), topology, source_.mesh);
    Primitive out{{}, std::move(corners), positions, read_influences(positions.count()), {}, {}};
    out.kind = kind_of(topology);
    out.closed = topology == Topology::kLineLoop;
    if (source_.attributes != nullptr) out.attributes = read_attributes(positions.count());
    out.unpacked = std::move(unpacked_);
    renumber(out);
    return out;
  }

 private:
  /// Compressed data is used where there is no plain data beside it.
  void open_draco() {
    packed_ = object_.extension(kDraco);
    if (!packed_) return;
    const auto is_plain = [&](std::uint64_t accessor) {
      return Accessor::has_view(source_.document, accessor);
    };
    if (is_plain(attributes_.number("POSITION")) &&
        (!object_.has("indices") || is_plain(object_.number("indices")))) {
      return;
    }
    const std::uint64_t view = packed_->number("bufferView");
    std::unique_ptr<DracoMesh>& mesh = source_.unpacked[view];
    if (!mesh) mesh = std::make_unique<DracoMesh>(*packed_, source_.buffers.view(view).bytes);
    draco_ = mesh.get();
    source_.mesh.check_room(draco_->vertices(), 0);
  }

  Accessor attribute(const std::string& name, const Use& use) {
    const std::uint64_t index = attributes_.number(name.c_str());
    if (draco_ != nullptr) {
      if (const auto id = packed_->object("attributes").find_number(name.c_str())) {
        const Accessor declared = Accessor::declared(source_.document, index, use);
        unpacked_.push_back(draco_->attribute(*id, declared.component(), declared.width()));
        return {source_.document, index, use, unpacked_.back()};
      }
    }
    return {source_.document, source_.buffers, index, use};
  }

  PrimitiveAttributes read_attributes(std::size_t vertices) {
    PrimitiveAttributes out;
    out.material = source_.attributes->materials.use(object_);
    out.normals = find_attribute("NORMAL", kNormalUse, vertices);
    out.uvs = find_attribute(fmt::format("TEXCOORD_{}", out.material.uv_set), kTextureUse, vertices);
    out.colors = find_attribute("COLOR_0", color_use(), vertices);
    return out;
  }

  [[nodiscard]] const Use& color_use() const {
    const auto index = attributes_.find_number("COLOR_0");
    const bool is_vec3 = index && *index < source_.document.size(kAccessors) &&
                         source_.document.get(kAccessors, *index).text_or("type", "") == "VEC3";
    return is_vec3 ? kColor3Use : kColor4Use;
  }

  /// An attribute that a picture can do without: one that cannot be read is left out.
  std::optional<Accessor> find_attribute(const std::string& name, const Use& use, std::size_t vertices) {
    if (!attributes_.has(name.c_str())) return std::nullopt;
    try {
      const Accessor found = attribute(name, use);
      if (found.count() == vertices) return found;
    } catch (const InputError&) {  // said below
    }
    source_.mesh.leave_out(fmt::format("attributes {} that cannot be read", name));
    return std::nullopt;
  }

  std::vector<Influences> read_influences(std::size_t vertices) {
    std::vector<Influences> influences;
    for (int set = 0;; ++set) {
      const std::string joints = fmt::format("JOINTS_{}", set);
      const std::string weights = fmt::format("WEIGHTS_{}", set);
      if (attributes_.has(joints.c_str()) != attributes_.has(weights.c_str())) {
        object_.fail("one of {} and {} is missing; legal: both or none", joints, weights);
      }
      if (!attributes_.has(joints.c_str())) return influences;
      influences.push_back({attribute(joints, kJointUse), attribute(weights, kWeightUse)});
      for (const Accessor& accessor : {influences.back().joints, influences.back().weights}) {
        if (accessor.count() != vertices) {
          source_.document.fail("accessor {} has {} elements; legal: {}, as the primitive's POSITION",
                                accessor.index(), accessor.count(), vertices);
        }
      }
    }
  }

  /// The vertices in the order of drawing, each below the number of positions.
  std::vector<std::uint32_t> read_order(const Accessor& positions) {
    if (!object_.has("indices")) {
      source_.mesh.check_room(positions.count(), 0);
      source_.add_bare(positions.bare(), copies_);
      std::vector<std::uint32_t> order(positions.count());
      std::iota(order.begin(), order.end(), 0u);
      return order;
    }
    const Accessor indices(source_.document, source_.buffers, object_.number("indices"), kIndexUse);
    source_.mesh.check_room(0, indices.count() / 3);
    source_.add_bare(indices.bare(), copies_);
    std::vector<std::uint32_t> order(indices.count());
    for (std::size_t i = 0; i < order.size(); ++i) {
      order[i] = indices.whole(i);
      if (order[i] >= positions.count()) {
        source_.document.fail("accessor {}: index {} is {}; legal: below {}, the number of positions",
                              indices.index(), i, order[i], positions.count());
      }
    }
    return order;
  }

  /// Makes the corners count among the vertices that are used: buffers are often shared by many primitives.
  void renumber(Primitive& primitive) {
    if (primitive.corners.empty()) return;
    const auto [low, high] = std::minmax_element(primitive.corners.begin(), primitive.corners.end());
    const std::uint32_t first = *low;
    const std::size_t range = std::size_t{*high} - first + 1;
    if (object_.has("indices") && primitive.positions.bare() > 0) source_.add_bare(range, copies_);
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(range, kUnused);
    for (const std::uint32_t corner : primitive.corners) number[corner - first] = 0;
    for (std::size_t i = 0; i < range; ++i) {
      if (number[i] == kUnused) continue;
      number[i] = static_cast<std::uint32_t>(primitive.vertices.size());
      primitive.vertices.push_back(first + static_cast<std::uint32_t>(i));
    }
    for (std::uint32_t& corner : primitive.corners) corner = number[corner - first];
  }

  Source& source_;
  const Object& object_;
  Object attributes_;
  std::size_t copies_;
  std::optional<Object> packed_;
  const DracoMesh* draco_ = nullptr;
  std::vector<std::vector<std::byte>> unpacked_;
};

}  // namespace

void Source::add_bare(std::uint64_t elements, std::uint64_t copies) {
  const std::uint64_t most = kMaxBareElements - bare;
  if (copies != 0 && elements > most / copies) {
    document.fail("accessors without data are used for {} elements, {} times; legal: at most {} in all",
                  elements, copies, kMaxBareElements);
  }
  bare += elements * copies;
}

std::optional<Primitive> read_primitive(Source& source, const Object& primitive, std::size_t copies) {
  return PrimitiveReader(source, primitive, copies).run();
}

}  // namespace halfspace::gltf
