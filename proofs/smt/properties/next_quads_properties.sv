// next_quads: pick n is the set's n-th lowest bit, and the rest is the set without its picks, for every set.

module next_quads_properties #(
  parameter int unsigned Size = 16,
  parameter int unsigned Picks = 4
) (
  input logic            clk_i,
  input logic            rst_ni,
  input logic [Size-1:0] set_i
);

  logic [Picks-1:0][Size-1:0] pick;
  logic [Size-1:0]            rest;

  next_quads #(
    .Size  (Size),
    .Picks (Picks)
  ) u_dut (
    .set_i  (set_i),
    .pick_o (pick),
    .rest_o (rest)
  );

  // A set without its lowest bit is left & (left - 1).
  for (genvar n = 0; n < Picks; n++) begin : gen_pick
    logic [Size-1:0] left;
    if (n == 0) begin : gen_first
      assign left = set_i;
    end else begin : gen_next
      assign left = gen_pick[n-1].left & (gen_pick[n-1].left - Size'(1));
    end
    always_comb begin
      Lowest: assert (pick[n] == (left & ~(left - Size'(1))));
    end
  end

  always_comb begin
    Rest: assert (rest == (gen_pick[Picks-1].left & (gen_pick[Picks-1].left - Size'(1))));

    Few: cover (set_i != '0 && rest == '0 && pick[Picks-1] == '0);
    Many: cover (rest != '0);
  end

endmodule
