// The blocks that have jobs in flight: those that have left and are not applied. Each is looked for by the number of
// another block: where may its jobs still raise what is stored, and where lower it?

module hi_z_flights
  import raster_pkg::*;
#(
  /// Blocks of all surfaces, 2 or more.
  parameter int unsigned MemoryBlocks = 1024,
  /// Blocks that have a job in flight at the same time, 2 or more.
  parameter int unsigned Slots = 136,
  localparam int unsigned BlockBits = $clog2(MemoryBlocks)
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  input  logic                  push_i,
  input  logic [BlockBits-1:0]  number_i,
  input  logic [BlockTiles-1:0] tiles_i,
  input  logic                  up_i,
  input  logic                  down_i,

  // Of the oldest block one job is applied; `last_i`: it was the last.
  input  logic                  applied_i,
  input  logic [BlockTiles-1:0] pick_i,
  input  logic                  last_i,

  // Combinational, from registers.
  input  logic [BlockBits-1:0]  search_i,
  output logic [BlockTiles-1:0] up_o,
  output logic [BlockTiles-1:0] down_o
);

  typedef logic [$clog2(Slots)-1:0] pointer_t;

  localparam pointer_t LastSlot = pointer_t'(Slots - 1);

  function automatic pointer_t next_slot(pointer_t slot);
    return slot == LastSlot ? '0 : slot + pointer_t'(1);
  endfunction

  pointer_t read_q, write_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      read_q  <= '0;
      write_q <= '0;
    end else begin
      if (push_i) begin
        write_q <= next_slot(write_q);
      end
      if (applied_i && last_i) begin
        read_q <= next_slot(read_q);
      end
    end
  end

  // All slots are read in every cycle, so they are registers.
  logic [Slots-1:0]                    valid_q;
  (* mem2reg *) logic [BlockBits-1:0]  number_q [Slots];
  (* mem2reg *) logic [BlockTiles-1:0] tiles_q  [Slots];
  (* mem2reg *) logic                  up_q     [Slots];
  (* mem2reg *) logic                  down_q   [Slots];

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      if (applied_i && last_i) begin
        valid_q[read_q] <= 1'b0;
      end
      if (push_i) begin
        valid_q[write_q] <= 1'b1;
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (push_i) begin
      number_q[write_q] <= number_i;
      up_q[write_q]     <= up_i;
      down_q[write_q]   <= down_i;
    end
  end

  // Never of the same slot: the one that is written is free.
  always_ff @(posedge clk_i) begin
    if (applied_i) begin
      tiles_q[read_q] <= tiles_q[read_q] & ~pick_i;
    end
    if (push_i) begin
      tiles_q[write_q] <= tiles_i;
    end
  end

  always_comb begin
    up_o   = '0;
    down_o = '0;
    for (int unsigned i = 0; i < Slots; i++) begin
      if (valid_q[i] && number_q[i] == search_i) begin
        up_o   |= up_q[i] ? tiles_q[i] : '0;
        down_o |= down_q[i] ? tiles_q[i] : '0;
      end
    end
  end

`ifndef SYNTHESIS
  SlotBeforePush: assert property (@(posedge clk_i) disable iff (!rst_ni)
      push_i |-> !valid_q[write_q])
  else $error("more blocks in flight than slots");
`endif

endmodule
