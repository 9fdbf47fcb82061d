/// The accounts of the ledger: for each kind of thing how many there were, and what became of them. In an
/// account all that follows `all` adds up to it, because every thing ends in exactly one way.
#pragma once

#include "halfspace/units/counter_struct.hpp"

namespace halfspace::ledger {

// clang-format off
#define HALFSPACE_TRIANGLE_ACCOUNT(C)                                                        \
  C(all,          "in the draws")                                                            \
  C(not_filled,   "their draw is skipped: its polygons are drawn as lines or points")        \
  C(non_finite,   "a position is NaN or infinite")                                           \
  C(clipped_away, "nothing is left inside the clip volume")                                  \
  C(degenerate,   "w is not positive after clipping")                                        \
  C(no_piece,     "resolved sample by sample, and none of the samples is on the target")     \
  C(set_up,       "go on to setup, as one piece or more")

#define HALFSPACE_PIECE_ACCOUNT(C)                                                           \
  C(all,          "taken by setup; cutting makes several of a triangle")                     \
  C(zero_area,    "no area on the sub-pixel grid")                                           \
  C(culled,       "face away")                                                               \
  C(no_sample,    "the bounding box holds no pixel centre")                                  \
  C(outside,      "the bounding box misses scissor, viewport or target")                     \
  C(uncovered,    "drawn, but cover no sample")                                              \
  C(hi_z,         "hi_z rejects all of their samples")                                       \
  C(hi_z_early_z, "hi_z rejects some of their samples, early_z the others")                  \
  C(early_z,      "early_z rejects all of their samples")                                    \
  C(late,         "the shader discards all that passes")                                     \
  C(survive,      "a sample passes and is kept")

#define HALFSPACE_BLOCK_ACCOUNT(C)                                                           \
  C(all,          "that the bounds of drawn pieces touch")                                   \
  C(edges,        "block_walker rejects each tile")                                          \
  C(hi_z,         "hi_z rejects every tile that is left")                                    \
  C(live,         "go on to the tile walker")

#define HALFSPACE_TILE_ACCOUNT(C)                                                            \
  C(all,          "that the bounds of drawn pieces touch")                                   \
  C(edges_block,  "block_walker rejects them with all others of the block")                  \
  C(edges_tile,   "block_walker rejects them, in a block that has others")                   \
  C(hi_z_block,   "hi_z rejects them with all that is left of the block")                    \
  C(hi_z_tile,    "hi_z rejects them, in a block that goes on")                              \
  C(empty,        "evaluated, and no sample is covered")                                     \
  C(early_z,      "none of their samples passes early_z")                                    \
  C(late,         "the shader discards all that passes")                                     \
  C(survive,      "a sample passes and is kept")

#define HALFSPACE_SAMPLE_ACCOUNT(C)                                                          \
  C(all,          "covered by drawn pieces on the target, inside scissor and viewport")       \
  C(hi_z_block,   "in tiles that hi_z rejects with all that is left of the block")           \
  C(hi_z_tile,    "in tiles that hi_z rejects, in a block that goes on")                     \
  C(early_z,      "do not pass early_z")                                                     \
  C(late,         "pass, and the shader discards them")                                      \
  C(survive,      "pass, and are kept")

#define HALFSPACE_LINE_ACCOUNT(C)                                                            \
  C(all,          "looked up in the z cache: parts of tiles, for each burst")                \
  C(hit,          "are in the cache")                                                        \
  C(overwritten,  "not fetched: the burst overwrites them whole")                            \
  C(cleared,      "not fetched: made from the clear value")                                  \
  C(fetched,      "fetched from memory")

#define HALFSPACE_READ_ACCOUNT(C)                                                            \
  C(all,          "of the lines that were not in the cache, uncompressed")                   \
  C(overwritten,  "not fetched: of lines that a burst overwrites whole")                     \
  C(cleared,      "not fetched: of lines that are made from the clear value")                \
  C(compressed,   "not fetched: of lines that memory has compressed")                        \
  C(fetched,      "fetched from memory")

#define HALFSPACE_WRITE_BACK_ACCOUNT(C)                                                      \
  C(all,          "dirty lines that leave the cache")                                        \
  C(evicted,      "because others take their place")                                         \
  C(flushed,      "at the end of the frame")

#define HALFSPACE_WRITE_ACCOUNT(C)                                                           \
  C(all,          "of the dirty lines that leave the cache, uncompressed")                   \
  C(compressed,   "not written: memory has the line compressed")                             \
  C(evicted,      "written because others take their place")                                 \
  C(flushed,      "written at the end of the frame")
// clang-format on

HALFSPACE_COUNTER_STRUCT(TriangleAccount, HALFSPACE_TRIANGLE_ACCOUNT)
HALFSPACE_COUNTER_STRUCT(PieceAccount, HALFSPACE_PIECE_ACCOUNT)
HALFSPACE_COUNTER_STRUCT(BlockAccount, HALFSPACE_BLOCK_ACCOUNT)
HALFSPACE_COUNTER_STRUCT(TileAccount, HALFSPACE_TILE_ACCOUNT)
HALFSPACE_COUNTER_STRUCT(SampleAccount, HALFSPACE_SAMPLE_ACCOUNT)
HALFSPACE_COUNTER_STRUCT(LineAccount, HALFSPACE_LINE_ACCOUNT)
HALFSPACE_COUNTER_STRUCT(ReadAccount, HALFSPACE_READ_ACCOUNT)
HALFSPACE_COUNTER_STRUCT(WriteBackAccount, HALFSPACE_WRITE_BACK_ACCOUNT)
HALFSPACE_COUNTER_STRUCT(WriteAccount, HALFSPACE_WRITE_ACCOUNT)

/// What an account's causes add up to.
template <class Account>
std::uint64_t explained(const Account& account) {
  std::uint64_t sum = 0;
  Account::fields([&](auto, auto, auto member) { sum += account.*member; });
  return sum - account.all;
}

/// All accounts of a draw or a frame.
struct Accounts {
  TriangleAccount triangles;
  PieceAccount pieces;
  BlockAccount blocks;
  TileAccount tiles;
  SampleAccount quads;  ///< a quad is dead when all of its covered samples are
  SampleAccount fragments;
  LineAccount lines;
  ReadAccount read;
  WriteBackAccount write_backs;
  WriteAccount written;

  /// Calls visit(name, member) for each account.
  template <class Visit>
  static void each(Visit&& visit) {
    visit("triangles", &Accounts::triangles);
    visit("pieces", &Accounts::pieces);
    visit("blocks", &Accounts::blocks);
    visit("tiles", &Accounts::tiles);
    visit("quads", &Accounts::quads);
    visit("fragments", &Accounts::fragments);
    visit("lines", &Accounts::lines);
    visit("read", &Accounts::read);
    visit("write_backs", &Accounts::write_backs);
    visit("written", &Accounts::written);
  }

  Accounts& operator+=(const Accounts& other) {
    each([&](auto, auto account) { this->*account += other.*account; });
    return *this;
  }
};

}  // namespace halfspace::ledger
