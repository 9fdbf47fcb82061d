// The slope of a line between pixel centres, for DDA: rise / run with 16 bits of fraction, rounded to the nearest. There is
// no half: run would have to be a multiple of 2^17.
//
// One line a cycle, ten registers: sizes of rise and run; eight of a restoring division, two digits each; rounding. Of a
// line that is no DDA line the slope means nothing.

module line_slope
  import raster_pkg::*;
  import setup_pkg::*;
(
  input  logic             clk_i,
  input  logic             rst_ni,

  input  logic             valid_i,
  input  coord_t [1:0]     x_i, // of the start, and of the end
  input  coord_t [1:0]     y_i,
  input  line_t            line_i,

  // Ten cycles later: its size. Rise is not more than run, so it is at most 1.
  output logic [SlopeBits:0] slope_o
);

  localparam int unsigned RunBits = CoordBits - SubPixelBits;
  localparam int unsigned Steps = SlopeBits / 2;

  typedef logic [RunBits-1:0] run_t;

  // Both ends in pixels, the larger first.
  function automatic run_t pixel(coord_t c);
    return run_t'(c >>> SubPixelBits);
  endfunction

  function automatic run_t size(run_t start, run_t stop, logic back);
    return back ? start - stop : stop - start;
  endfunction

  // Element i is at the beginning of step i.
  logic [Steps+1:1]        valid_q;
  run_t                    run_q       [Steps+1] /*verilator split_var*/;
  run_t                    remainder_q [Steps+1] /*verilator split_var*/;
  logic [SlopeBits-1:0]    quotient_q  [Steps+1] /*verilator split_var*/;
  logic [Steps:0]          is_one_q;
  run_t                    x_size, y_size, rise, run;

  assign x_size = size(pixel(x_i[0]), pixel(x_i[1]), line_i.left);
  assign y_size = size(pixel(y_i[0]), pixel(y_i[1]), line_i.up);
  assign rise   = line_i.x_major ? y_size : x_size;
  assign run    = line_i.x_major ? x_size : y_size;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[Steps:1], valid_i};
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      run_q[0]       <= run;
      remainder_q[0] <= rise;
      is_one_q[0]    <= x_size == y_size;
    end
  end

  assign quotient_q[0] = '0;

  // A binary digit: whether the divisor fits the doubled remainder.
  typedef struct packed {
    logic digit;
    run_t remainder;
  } step_result_t;

  function automatic step_result_t divide(run_t remainder, run_t divisor);
    logic [RunBits+1:0] less = {1'b0, remainder, 1'b0} - {2'b00, divisor};
    step_result_t result;
    result.digit     = !less[RunBits+1];
    result.remainder = less[RunBits+1] ? {remainder[RunBits-2:0], 1'b0} : less[RunBits-1:0];
    return result;
  endfunction

  for (genvar i = 0; i < Steps; i++) begin : gen_step
    step_result_t first, second;
    assign first  = divide(remainder_q[i], run_q[i]);
    assign second = divide(first.remainder, run_q[i]);

    always_ff @(posedge clk_i) begin
      if (valid_q[i+1]) begin
        run_q[i+1]       <= run_q[i];
        remainder_q[i+1] <= second.remainder;
        quotient_q[i+1]  <= {quotient_q[i][SlopeBits-3:0], first.digit, second.digit};
        is_one_q[i+1]    <= is_one_q[i];
      end
    end
  end

  // What is left against half of the run.
  logic [RunBits:0] twice;
  logic             round_up;
  assign twice    = {remainder_q[Steps], 1'b0};
  assign round_up = twice > {1'b0, run_q[Steps]};

  always_ff @(posedge clk_i) begin
    if (valid_q[Steps+1]) begin
      slope_o <= is_one_q[Steps] ? {1'b1, {SlopeBits{1'b0}}}
                                 : {1'b0, quotient_q[Steps]} + {{SlopeBits{1'b0}}, round_up};
    end
  end

  logic unused_parts;
  assign unused_parts = line_i.ties_up;

endmodule
