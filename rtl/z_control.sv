// Clears and flushes of the z cache, which are done when nothing else is: a clear drops the lines of a range of tiles,
// one set a cycle, and marks them cleared, ClearTiles a cycle; a flush looks at the slots in order, one a cycle, and
// writes back the dirty ones.

module z_control
  import raster_pkg::*;
#(
  /// Lines of the z cache, a power of two, at least ZParts * Ways.
  parameter int unsigned Lines = 128,
  /// Lines of a set: a power of two.
  parameter int unsigned Ways = 4,
  /// Tiles that a clear marks in a cycle: a power of two.
  parameter int unsigned ClearTiles = 64,
  /// Tiles of all surfaces, 2 or more.
  parameter int unsigned MemoryTiles = 1024,
  localparam int unsigned TileBits = $clog2(MemoryTiles),
  localparam int unsigned PartLines = Lines / ZParts,
  localparam int unsigned PartLineBits = PartLines > 1 ? $clog2(PartLines) : 1
) (
  input  logic                    clk_i,
  input  logic                    rst_ni,

  input  logic                    idle_i,
  input  logic                    written_i,     // the write buffer is empty
  output logic                    idle_o,

  input  logic                    clear_valid_i,
  input  logic [TileBits-1:0]     clear_first_i,
  input  logic [TileBits-1:0]     clear_last_i,
  output logic                    clear_done_o,
  input  logic                    flush_i,
  output logic                    flush_done_o,

  // A slot of the parts, or the first of a set.
  output logic                    inspect_o,
  output logic [PartLineBits-1:0] line_o,

  output logic                    drop_o,
  output logic                    mark_o,
  output logic [TileBits-1:0]     first_o,
  output logic [TileBits-1:0]     last_o,
  output logic [TileBits-1:0]     mark_from_o,

  output logic                    scan_o,
  output logic [ZParts-1:0]       scan_part_o,
  output logic [PartLineBits-1:0] next_line_o,   // in line_o in the next cycle
  input  logic                    scan_done_i
);

  localparam int unsigned Sets = PartLines / Ways;

  typedef logic [TileBits-1:0] tile_t;
  typedef logic [TileBits:0] wide_t; // holds the sum of a tile and ClearTiles, where that matters
  typedef logic [PartLineBits-1:0] line_index_t;

  logic clearing_q, scanning_q, draining_q;
  logic begin_clear, begin_scan;
  assign idle_o      = idle_i & ~clearing_q & ~scanning_q;
  assign begin_clear = clear_valid_i & idle_o;
  assign begin_scan  = flush_i & idle_o & ~clear_valid_i;

  // Clear.
  logic        clear, last_set, last_mark, clear_end, clear_done_q;
  logic        drop_left_q, mark_left_q;
  tile_t       first_q, last_q, mark_q;
  line_index_t line_q; // of the set, or of the slot

  assign clear       = begin_clear | clearing_q;
  assign first_o     = begin_clear ? clear_first_i : first_q;
  assign last_o      = begin_clear ? clear_last_i : last_q;
  assign mark_from_o = begin_clear ? clear_first_i : mark_q;
  assign drop_o      = begin_clear | (clearing_q & drop_left_q);
  assign mark_o      = begin_clear | (clearing_q & mark_left_q);
  assign last_set    = line_q == line_index_t'((Sets - 1) * Ways);
  assign last_mark   = wide_t'(last_o) - wide_t'(mark_from_o) < wide_t'(ClearTiles)
                       || ClearTiles >= 2 ** TileBits;
  assign clear_end   = (~drop_o | last_set) & (~mark_o | last_mark);

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      clearing_q   <= 1'b0;
      clear_done_q <= 1'b0;
    end else begin
      clearing_q   <= clear & ~clear_end;
      clear_done_q <= clear & clear_end;
    end
  end

  always_ff @(posedge clk_i) begin
    if (clear) begin
      first_q     <= first_o;
      last_q      <= last_o;
      mark_q      <= mark_from_o + tile_t'(ClearTiles);
      drop_left_q <= drop_o & ~last_set;
      mark_left_q <= mark_o & ~last_mark;
    end
  end

  assign clear_done_o = clear_done_q;

  // Flush: slots of part 0 first.
  logic [ZParts-1:0] part_q;
  logic              scan, last_line, last_slot;

  assign scan      = begin_scan | scanning_q;
  assign last_line = line_q == line_index_t'(PartLines - 1);
  assign last_slot = last_line & part_q[ZParts-1];

  always_comb begin
    next_line_o = line_q;
    if (clear) begin
      next_line_o = clear_end || !drop_o || last_set ? '0 : line_q + line_index_t'(Ways);
    end else if (scan && scan_done_i) begin
      next_line_o = last_line ? '0 : line_q + line_index_t'(1);
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      line_q     <= '0;
      part_q     <= ZParts'(1);
      scanning_q <= 1'b0;
      draining_q <= 1'b0;
    end else begin
      line_q <= next_line_o;
      if (scan && scan_done_i && last_line) begin
        part_q <= last_slot ? ZParts'(1) : part_q + part_q;
      end
      scanning_q <= scan & ~(scan_done_i & last_slot);
      draining_q <= (scan & scan_done_i & last_slot) | (draining_q & ~written_i);
    end
  end

  assign flush_done_o = draining_q & written_i;
  assign scan_o       = scan;
  assign scan_part_o  = part_q;
  assign line_o       = line_q;
  // From registers: a slot is looked at in the cycle in which a clear or a flush is taken, and in an idle unit nobody
  // looks at another.
  assign inspect_o    = idle_i | clearing_q | scanning_q;

endmodule
