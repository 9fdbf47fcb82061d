// The slots of the triangles behind hi_z. A triangle gets one when its first block leaves: the next number, and what early_z
// keeps of it is written there. Until then it is here, in one of Triangles places by the slot of block_walker.

module hi_z_slots
  import raster_pkg::*;
#(
  /// Triangles of which a block may come to its cycle 4 when another is written. A power of two.
  parameter int unsigned Triangles = 16
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  // The end of a frame: the next slot is 0.
  input  logic                forget_i,

  // Each triangle from block_walker.
  input  logic                write_i,
  input  logic [SlotBits-1:0] slot_i,
  input  depth_equation_t     equation_i,
  input  draw_state_t         state_i,

  // A block in its cycle 4: the slot that it came with, and whether it leaves. The slot with which it leaves.
  input  logic                block_i,
  input  logic [SlotBits-1:0] block_slot_i,
  input  logic                leaves_i,
  output logic [SlotBits-1:0] leaves_slot_o,

  // In its cycle 5: what early_z keeps.
  output logic                slot_write_o,
  output logic [SlotBits-1:0] slot_o,
  output depth_equation_t     slot_equation_o,
  output draw_state_t         slot_state_o
);

  typedef logic [SlotBits-1:0] slot_t;
  typedef logic [$clog2(Triangles)-1:0] place_t;

  // The blocks of a triangle come one after the other.
  logic  walked_q; // a block came before
  slot_t walked_slot_q;
  logic  given_q;  // its triangle has a slot
  slot_t given_slot_q;
  logic  given, first;

  assign given         = walked_q & given_q && walked_slot_q == block_slot_i;
  assign first         = leaves_i & ~given;
  assign leaves_slot_o = given_slot_q + slot_t'(first);

  always_ff @(posedge clk_i) begin
    if (!rst_ni || forget_i) begin
      walked_q     <= 1'b0;
      given_slot_q <= '1;
    end else if (block_i) begin
      walked_q     <= 1'b1;
      given_slot_q <= leaves_slot_o;
    end
  end

  always_ff @(posedge clk_i) begin
    if (block_i) begin
      walked_slot_q <= block_slot_i;
      given_q       <= leaves_i | given;
    end
  end

  sync_ram #(
    .Width ($bits(depth_equation_t) + $bits(draw_state_t)),
    .Depth (Triangles)
  ) u_triangles (
    .clk_i           (clk_i),
    .write_i         (write_i),
    .write_address_i (place_t'(slot_i)),
    .data_i          ({equation_i, state_i}),
    .read_i          (first),
    .read_address_i  (place_t'(block_slot_i)),
    .data_o          ({slot_equation_o, slot_state_o})
  );

  logic slot_write_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      slot_write_q <= 1'b0;
    end else begin
      slot_write_q <= first;
    end
  end

  // In the cycle after, the last slot that was given is this triangle's.
  assign slot_write_o = slot_write_q;
  assign slot_o       = given_slot_q;

`ifndef SYNTHESIS
  logic [Triangles-1:0][SlotBits-1:0] written_q;
  slot_t                              here;

  assign here = written_q[place_t'(block_slot_i)];

  always_ff @(posedge clk_i) begin
    if (write_i) begin
      written_q[place_t'(slot_i)] <= slot_i;
    end
  end

  HasItsTriangle: assert property (@(posedge clk_i) disable iff (!rst_ni)
      block_i |-> here == block_slot_i)
  else $error("the place of a block's triangle has another");
`endif

endmodule
