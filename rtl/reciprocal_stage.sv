// A stage of the divider: Interval steps of a restoring division of 2^63 - 1 by the divisor, radix 4.
//
// Bits of the dividend that are yet to be brought down are all 1, so a step appends 11 to the remainder and subtracts
// as many divisors as fit. The stage works on one division at a time.

module reciprocal_stage #(
  /// Bits of divisor and quotient.
  parameter int unsigned Width = 32,
  /// Steps, and so cycles: 1, 2, 4, 8 or 16.
  parameter int unsigned Interval = 1,
  /// Bits of the quotient that are found at the end of the stage.
  parameter int unsigned Found = 2 * Interval
) (
  input  logic             clk_i,
  input  logic             rst_ni,

  // At least Interval cycles after the one before.
  input  logic             start_i,
  input  logic             tag_i,
  input  logic [Width-1:0] divisor_i,
  input  logic [Width+1:0] divisor3_i,
  input  logic [Width-1:0] remainder_i,
  input  logic [Width-1:0] quotient_i,

  // Interval cycles later, from logic: the next stage has the registers.
  output logic             done_o,
  output logic             tag_o,
  output logic [Width-1:0] divisor_o,
  output logic [Width+1:0] divisor3_o,
  output logic [Width-1:0] remainder_o,
  output logic [Width-1:0] quotient_o
);

  logic             tag_q;
  logic [Width-1:0] divisor_q;
  logic [Width+1:0] divisor3_q;
  logic [Width-1:0] remainder_q;
  logic [Found-1:0] quotient_q;

  // Whether 1, 2 or 3 divisors fit, all tried at once; a borrow says no.
  logic [Width+1:0] brought;
  logic [Width+2:0] less1, less2, less3;
  logic [Width-1:0] remainder_d;
  logic [1:0]       digit;

  assign brought = {remainder_q, 2'b11};
  assign less1   = {1'b0, brought} - (Width + 3)'(divisor_q);
  assign less2   = {1'b0, brought} - (Width + 3)'({divisor_q, 1'b0});
  assign less3   = {1'b0, brought} - (Width + 3)'(divisor3_q);

  always_comb begin
    // What remains is less than the divisor, so its upper bits are 0.
    if (!less3[Width+2]) begin
      digit       = 2'd3;
      remainder_d = less3[Width-1:0];
    end else if (!less2[Width+2]) begin
      digit       = 2'd2;
      remainder_d = less2[Width-1:0];
    end else if (!less1[Width+2]) begin
      digit       = 2'd1;
      remainder_d = less1[Width-1:0];
    end else begin
      digit       = 2'd0;
      remainder_d = brought[Width-1:0];
    end
  end

  logic [Found-1:0] quotient_d;
  assign quotient_d = Found'({quotient_q, digit});

  // The stages before found fewer bits than this one holds.
  logic unused_quotient;
  assign unused_quotient = ^quotient_i;

  logic last;

  if (Interval == 1) begin : gen_once
    logic busy_q;

    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        busy_q <= 1'b0;
      end else begin
        busy_q <= start_i;
      end
    end

    assign last = busy_q;

    always_ff @(posedge clk_i) begin
      if (start_i) begin
        remainder_q <= remainder_i;
        quotient_q  <= quotient_i[Found-1:0];
      end
    end
  end else begin : gen_steps
    // The steps that are left, 0 when idle.
    localparam int unsigned LeftBits = $clog2(Interval + 1);
    typedef logic [LeftBits-1:0] left_t;
    left_t left_q;

    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        left_q <= '0;
      end else if (start_i) begin
        left_q <= left_t'(Interval);
      end else if (left_q != '0) begin
        left_q <= left_q - left_t'(1);
      end
    end

    assign last = left_q == left_t'(1);

    always_ff @(posedge clk_i) begin
      if (start_i) begin
        remainder_q <= remainder_i;
        quotient_q  <= quotient_i[Found-1:0];
      end else if (left_q != '0) begin
        remainder_q <= remainder_d;
        quotient_q  <= quotient_d;
      end
    end

`ifndef SYNTHESIS
    StageIsFree: assert property (@(posedge clk_i) disable iff (!rst_ni)
        start_i |-> left_q <= left_t'(1));
`endif
  end

  always_ff @(posedge clk_i) begin
    if (start_i) begin
      tag_q      <= tag_i;
      divisor_q  <= divisor_i;
      divisor3_q <= divisor3_i;
    end
  end

  assign done_o      = last;
  assign tag_o       = tag_q;
  assign divisor_o   = divisor_q;
  assign divisor3_o  = divisor3_q;
  assign remainder_o = remainder_d;
  assign quotient_o  = Width'(quotient_d);

endmodule
