// A linear function of the pixel on a walk that is not block by block in row order: its value at the block. Walks in rows
// keep it here and at the entry, and go to a neighbour by one adder; walks that jump make it from the first block's.

module walk_value
  import raster_pkg::*;
  import walk_pkg::*;
#(
  parameter int unsigned Width = PixelEdgeBits,
  parameter int unsigned SlopeBits = StepBits,
  parameter bit          Jumps = 1'b0
) (
  input  logic                        clk_i,
  input  logic                        load_i,
  input  logic signed [Width-1:0]     value_i,  // at the first block
  // What a pixel adds, to the right and down; from the cycle after load_i on.
  input  logic signed [SlopeBits-1:0] dx_i,
  input  logic signed [SlopeBits-1:0] dy_i,

  input  logic                        advance_i, // to the next block, at the end of the cycle
  input  walk_move_t                  move_i,

  output logic signed [Width-1:0]     value_o
);

  typedef logic signed [Width-1:0] value_t;

  if (Jumps) begin : gen_jumps
    value_t first_q;
    always_ff @(posedge clk_i) begin
      if (load_i) begin
        first_q <= value_i;
      end
    end

    value_t across, down;
    assign across  = value_t'(dx_i) * value_t'(move_i.x);
    assign down    = value_t'(dy_i) * value_t'(move_i.y);
    assign value_o = first_q + ((across + down) <<< BlockLog2);

    logic unused_rows;
    assign unused_rows = ^{advance_i, move_i.from_entry, move_i.west, move_i.east, move_i.south,
                           move_i.save};
  end else begin : gen_rows
    value_t here_q, entry_q, base, step, next;
    assign base = move_i.from_entry ? entry_q : here_q;
    assign step = move_i.east    ? value_t'(dx_i) <<< BlockLog2
                  : move_i.west  ? -(value_t'(dx_i) <<< BlockLog2)
                  : move_i.south ? value_t'(dy_i) <<< BlockLog2 : '0;
    assign next = base + step;

    always_ff @(posedge clk_i) begin
      if (load_i) begin
        here_q  <= value_i;
        entry_q <= value_i;
      end else if (advance_i) begin
        here_q <= next;
        if (move_i.save) begin
          entry_q <= next;
        end
      end
    end
    assign value_o = here_q;

    logic unused_jumps;
    assign unused_jumps = ^{move_i.x, move_i.y};
  end

endmodule
