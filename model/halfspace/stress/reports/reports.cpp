#include <array>

#include "halfspace/stress/family.hpp"
#include "halfspace/stress/reports/scenes.hpp"

namespace halfspace::stress {
namespace {

constexpr std::string_view kOnce = "each sample exactly once";
constexpr std::string_view kDefinition = "each sample as the definition has it";
constexpr std::string_view kInside = "each sample inside exactly once, none outside";

// clang-format off
constexpr std::array kReports{
    Family{"shared_diagonal", "a square of two triangles whose diagonal passes through samples, the vertices as published", kInside, report::shared_diagonal,
           "https://github.com/facebookresearch/DRTK/issues/9", "owns_nothing"},
    Family{"fading_screen", "a transparent rectangle over the whole screen, of two triangles", kOnce, report::fading_screen,
           "https://github.com/JaCzekanski/Avocado/issues/18", "owns_everything"},
    Family{"polygon_strip", "strips of triangles with vertices on samples", kOnce, report::polygon_strip,
           "https://github.com/nesbox/TIC-80/issues/776", "owns_nothing"},
    Family{"far_edges", "pairs of triangles whose edge comes from far off the screen and passes within 0.002 pixels of a sample", "each sample once by each pair", report::far_edges,
           "https://github.com/h0MER247/swGL/issues/4", "float_edges"},
    Family{"lod_border", "a coarse cell beside four fine ones, T-junctions on the border", kOnce, report::lod_border,
           "https://github.com/PixelGuys/Cubyz/issues/92", "coarse_grid"},
    Family{"fractional_rows", "every other cell of a mesh whose vertices lie between rows", kDefinition, report::fractional_rows,
           "https://github.com/gonetz/GLideN64/issues/1731", "no_prestep"},
    Family{"distant_mesh", "a mesh so far away that its cells are two sub-pixels", "the sample in the middle exactly once; each as the definition has it", report::distant_mesh,
           "https://github.com/trianglesplatting/triangle-splatting/issues/24", "drops_tiny"},
    Family{"screen_border", "a fan that ends on the borders of the screen", kOnce, report::screen_border,
           "https://github.com/Marzac/le3d/issues/38", "short_box"},
    Family{"sixteen_bits", "one triangle on a screen of 320x240, the vertices as published", kDefinition, report::sixteen_bits,
           "https://github.com/adafruit/Adafruit-GFX-Library/issues/164", "saturates_to_16_bits"},
    Family{"pixel_centres", "triangles whose left edges pass between the corner of a pixel and its middle", kDefinition, report::pixel_centres,
           "https://github.com/hrydgard/ppsspp/pull/9681", "corner_samples"},
    Family{"near_camera", "triangles so near that their vertices are beyond 32,767 pixels", kOnce, report::near_camera,
           "https://github.com/dkfans/keeperfx/pull/4668", "edges_of_32_bits"},
    Family{"across_near", "a floor of two triangles that reaches behind the near plane", kInside, report::across_near,
           "https://github.com/bulletphysics/bullet3/issues/1006", "drops_cut"},
    Family{"corner_cut_off", "a wall that loses corners to the near plane, so that one triangle becomes two", kInside, report::corner_cut_off,
           "https://github.com/bochs-emu/Bochs/pull/621", "draws_first_piece"},
    Family{"cut_apart", "a fan around a point in front of the camera, its other vertices far off in all directions, so that every triangle is cut", kInside, report::cut_apart,
           "https://github.com/NVlabs/nvdiffrast/issues/225", "cuts_in_float"},
    Family{"vertex_behind_eye", "a floor of one triangle with a vertex behind the eye", "samples two sub-pixels from every edge as exact arithmetic has them", report::vertex_behind_eye,
           "https://github.com/vindar/tgx/issues/47", "discards_by_division"},
    Family{"hidden_by_near", "a wall of which a part is nearer than the near plane", kInside, report::hidden_by_near,
           "https://github.com/Vita3K/Vita3K/issues/4110", "no_near_plane"},
    Family{"beyond_far", "a wall of which a part is beyond the far plane", kInside, report::beyond_far,
           "https://github.com/SaschaWillems/Vulkan/issues/217", "no_far_plane"},
    Family{"odd_scissor", "a screen drawn in nine pieces by scissors with odd corners", kOnce, report::odd_scissor,
           "https://github.com/dolphin-emu/dolphin/pull/10251", "even_scissor"},
    Family{"viewport_above", "a viewport that begins above the target, or left of it", kDefinition, report::viewport_above,
           "https://github.com/citra-emu/citra/issues/1633", "unsigned_box"},
    Family{"flipped_culling", "a mesh, some of it in both windings, with back faces culled and the viewport either way up", kOnce, report::flipped_culling,
           "https://github.com/dolphin-emu/dolphin/pull/9350", "faces_before_viewport"},
    Family{"overlay_tile", "a tile drawn twice with LEQUAL, its vertices in another order", "every fragment passes", report::overlay_tile,
           "https://github.com/luanti-org/luanti/issues/15632", "swapped_depths"},
    Family{"depth_prepass", "a mesh drawn for depth, and again with EQUAL in another order", "every fragment passes", report::depth_prepass,
           "https://github.com/google/filament/issues/293", "depth_of_float_plane"},
    Family{"floor_decal", "a decal in the plane of a sloping floor, moved by the factor of polygon offset", "the floor passes, and all of the decal", report::floor_decal,
           "https://github.com/SerenityOS/serenity/pull/13998", "no_slope"},
};
// clang-format on

}  // namespace

std::span<const Family> reports() { return kReports; }

}  // namespace halfspace::stress
