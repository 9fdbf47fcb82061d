// The first bit of a set, in an order of the places of a square, and the others: the bits in that order, the lowest of
// them, and back. The orders are wires.

module ordered_pick #(
  parameter int unsigned Side = 4,
  /// walk_pkg: RasterTiles, BoustrophedonicTiles, MortonTiles or HilbertTiles.
  parameter int unsigned Order = walk_pkg::RasterTiles,
  localparam int unsigned Places = Side * Side
) (
  input  logic [Places-1:0] set_i,
  output logic [Places-1:0] pick_o,
  output logic [Places-1:0] rest_o
);

  logic [Places-1:0] ordered, above, rest;

  for (genvar n = 0; n < Places; n++) begin : gen_place
    localparam int unsigned Place = walk_pkg::place_in_order(Order, Side, n);
    assign ordered[n]    = set_i[Place];
    assign rest_o[Place] = rest[n];
    assign pick_o[Place] = ordered[n] & ~rest[n];
  end

  // The places above the lowest bit, by doubling: log2(Places) ORs deep.
  always_comb begin
    above = ordered << 1;
    for (int unsigned k = 1; k < Places; k *= 2) begin
      above |= above << k;
    end
  end

  assign rest = ordered & above;

endmodule
