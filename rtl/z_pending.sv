// Pending store of early_z: bursts from their lookup until all their beats have gone to the interpolator. What a burst
// has once is kept apart from its beats, of which TestWidth quads go in a cycle; slices without a quad at the end of a
// beat do not go.

module z_pending
  import raster_pkg::*;
#(
  /// Bursts, 2 or more.
  parameter int unsigned PendingDepth = 32,
  localparam int unsigned BurstBits = $clog2(PendingDepth)
) (
  input  logic                                     clk_i,
  input  logic                                     rst_ni,

  input  logic                                     take_i,   // a beat, of burst_i
  input  logic                                     first_i,  // it is the first of its burst
  input  logic [BurstBits-1:0]                     burst_i,
  input  quad_beat_t                               beat_i,
  input  logic                                     found_i,  // the next burst is looked up

  // A slice, when there is one: the next follows where ready_i is 1.
  output logic                                     valid_o,
  input  logic                                     ready_i,
  output logic                                     first_o,
  output logic                                     last_o,
  output logic [BurstBits-1:0]                     burst_o,
  output logic [SlotBits-1:0]                      slot_o,
  output logic [TileColumnBits-1:0]                tile_x_o,
  output logic [TileCoordBits-1:0]                 tile_y_o,
  output edge_t [1:0]                              e_o,
  output logic [TestWidth-1:0] [QuadIndexBits-1:0] index_o,
  output logic [TestWidth-1:0] [QuadMaskBits-1:0]  mask_o
);

  localparam int unsigned Beats = TileQuads / QuadWidth; // of the largest burst
  localparam int unsigned BeatBits = Beats > 1 ? $clog2(Beats) : 1;
  localparam int unsigned Slices = QuadWidth / TestWidth;
  localparam int unsigned SliceBits = Slices > 1 ? $clog2(Slices) : 1;

  typedef logic [BurstBits-1:0] burst_t;
  typedef logic [BeatBits-1:0] beat_number_t;
  typedef logic [SliceBits-1:0] slice_t;
  typedef logic [$clog2(PendingDepth+1)-1:0] count_t;

  typedef struct packed {
    logic [SlotBits-1:0]      slot;
    logic [TileColumnBits-1:0] tile_x;
    logic [TileCoordBits-1:0] tile_y;
    edge_t [1:0]              e;
  } head_t;

  typedef struct packed {
    logic                                     last;
    slice_t                                   last_slice; // the last with a quad
    logic [QuadWidth-1:0] [QuadIndexBits-1:0] index;
    logic [QuadWidth-1:0] [QuadMaskBits-1:0]  mask;
  } beat_t;

  head_t        heads_q [PendingDepth];
  beat_t        beats_q [PendingDepth*Beats];
  beat_t        new_beat, beat;
  beat_number_t new_number_q, new_number;

  logic unused_beat;
  assign unused_beat = ^beat_i;

  assign new_number = first_i ? '0 : new_number_q;

  always_comb begin
    new_beat = '{last: beat_i.last, last_slice: '0, index: beat_i.index, mask: beat_i.mask};
    for (int unsigned i = 0; i < Slices; i++) begin
      if (beat_i.mask[i*TestWidth+:TestWidth] != '0) begin
        new_beat.last_slice = slice_t'(i);
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (take_i) begin
      new_number_q <= new_number + beat_number_t'(1);
      beats_q[int'(burst_i)*int'(Beats)+int'(new_number)] <= new_beat;
      if (first_i) begin
        heads_q[burst_i] <= '{
          slot: beat_i.slot, tile_x: beat_i.tile_x, tile_y: beat_i.tile_y, e: beat_i.e};
      end
    end
  end

  count_t       pending_q; // bursts found, not all of whose beats have gone
  burst_t       burst_q;
  beat_number_t number_q;
  slice_t       slice_q;
  logic         go, beat_end;
  head_t        head;

  assign head     = heads_q[burst_q];
  assign beat     = beats_q[int'(burst_q)*int'(Beats)+int'(number_q)];
  assign valid_o  = pending_q != '0;
  assign go       = valid_o & ready_i;
  assign beat_end = slice_q == beat.last_slice;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      pending_q <= '0;
      burst_q   <= '0;
      number_q  <= '0;
      slice_q   <= '0;
    end else begin
      pending_q <= pending_q + count_t'(found_i) - count_t'(go && last_o);
      if (go) begin
        slice_q <= beat_end ? '0 : slice_q + slice_t'(1);
        if (last_o) begin
          number_q <= '0;
          burst_q  <= burst_q == burst_t'(PendingDepth - 1) ? '0 : burst_q + burst_t'(1);
        end else if (beat_end) begin
          number_q <= number_q + beat_number_t'(1);
        end
      end
    end
  end

  assign first_o  = number_q == '0 && slice_q == '0;
  assign last_o   = beat_end & beat.last;
  assign burst_o  = burst_q;
  assign slot_o   = head.slot;
  assign tile_x_o = head.tile_x;
  assign tile_y_o = head.tile_y;
  assign e_o      = head.e;
  assign index_o  = beat.index[int'(slice_q)*TestWidth+:TestWidth];
  assign mask_o   = beat.mask[int'(slice_q)*TestWidth+:TestWidth];

endmodule
