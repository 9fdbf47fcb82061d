// Lines of depth from memory, back from what z_encoder has made of them. A line a cycle, and no stall.

module z_decoder
  import raster_pkg::*;
  import z_codec_pkg::*;
(
  input  logic         clk_i,
  input  logic         rst_ni,

  input  logic         valid_i,
  input  logic         half_i,  // unorm16: codes below 2^16
  input  coded_shift_t shift_i, // one that a line of this format can have
  input  data_t        data_i,  // memory's bytes; behind the line's anything

  // ZDecodeLatency cycles later.
  output logic         valid_o,
  output quads_t       codes_o
);

  localparam int unsigned Last = ZDecodeLatency - 1;

  // Bit i: in register i.
  logic [ZDecodeLatency:1] valid_q;
  logic [Last:1]           half_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[Last:1], valid_i};
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      half_q[1] <= half_i;
    end
    for (int unsigned i = 1; i < Last; i++) begin
      if (valid_q[i]) begin
        half_q[i+1] <= half_q[i];
      end
    end
  end

  // The plain line, or the samples of the form and size that it has. Loops, because Verilator's dataflow optimizer makes
  // of an assignment a sample a chain of concatenations, each of which copies all before it.
  rows_t plain, rows_d;

  always_comb begin
    for (int unsigned i = 0; i < Samples; i++) begin
      plain[i] = half_i ? code_t'(data_i[i*(CodeBits/2)+:CodeBits/2])
                        : data_i[i*CodeBits+:CodeBits];
    end
  end

  if (is_coded(1'b0, 1)) begin : gen_coded
    // Register 1: fields, and a value for each sample, the complement of an offset from the greatest.
    rows_t              value_d;
    logic [Samples-1:0] high_d;
    code_t              first_d, second_d, third_d;

    // By format and shift: the samples, 0 if it is another.
    rows_t [1:0] [MostCodedShift:1]              value;
    logic [1:0] [MostCodedShift:1] [Samples-1:0] high;

    for (genvar h = 0; h < 2; h++) begin : gen_format
      for (genvar s = 1; s <= MostCodedShift; s++) begin : gen_shift
        if (is_coded(h, s)) begin : gen_size
          localparam int unsigned Code = code_bits(h);
          localparam int unsigned Plane = plane_bits(h, s);
          localparam int unsigned Ends = ends_bits(h, s) + 1;
          logic               plane, ends;
          rows_t              this_value;
          logic [Samples-1:0] this_high;
          assign plane = half_i == 1'(h) && shift_i == coded_shift_t'(s) && !data_i[0];
          assign ends  = half_i == 1'(h) && shift_i == coded_shift_t'(s) && data_i[0];

          always_comb begin
            for (int unsigned i = 0; i < Samples; i++) begin
              automatic logic [Plane-1:0] in_plane = data_i[1+3*Code+i*Plane+:Plane];
              automatic logic [Ends-1:0]  at_end = data_i[1+2*Code+i*Ends+:Ends];
              automatic code_t            offset = code_t'(at_end) & code_t'((1 << (Ends - 1)) - 1);
              this_high[i]  = ends & at_end[Ends-1];
              this_value[i] = (code_t'(in_plane) & {CodeBits{plane}})
                              | ((offset ^ {CodeBits{at_end[Ends-1]}}) & {CodeBits{ends}});
            end
          end
          assign high[h][s]  = this_high;
          assign value[h][s] = this_value;
        end else begin : gen_no_size
          assign value[h][s] = '0;
          assign high[h][s]  = '0;
        end
      end
    end

    logic is_plain, is_plane;
    assign is_plain = shift_i == '0;
    assign is_plane = !is_plain && !data_i[0];

    always_comb begin
      value_d = is_plain ? plain : '0;
      high_d  = '0;
      for (int unsigned h = 0; h < 2; h++) begin
        for (int unsigned s = 1; s <= MostCodedShift; s++) begin
          value_d |= value[h][s];
          high_d  |= high[h][s];
        end
      end
    end

    function automatic code_t field(data_t data, int unsigned number, logic half);
      return half ? extended(code_t'(data[1+number*CodeBits/2+:CodeBits/2]), 1'b1)
                  : data[1+number*CodeBits+:CodeBits];
    endfunction

    assign first_d  = field(data_i, 0, half_i) & {CodeBits{!is_plain}};
    assign second_d = field(data_i, 1, half_i) & {CodeBits{!is_plain}};
    assign third_d  = field(data_i, 2, half_i) & {CodeBits{is_plane}};

    rows_t              value_q [1:3];
    logic [Samples-1:0] high_q  [1:3];
    code_t              first_q, second_q, third_q;
    logic               plane_q;

    always_ff @(posedge clk_i) begin
      if (valid_i) begin
        value_q[1] <= value_d;
        high_q[1]  <= high_d;
        first_q    <= first_d;
        second_q   <= second_d;
        third_q    <= third_d;
        plane_q    <= is_plane;
      end
      for (int unsigned i = 1; i < 3; i++) begin
        if (valid_q[i]) begin
          value_q[i+1] <= value_q[i];
          high_q[i+1]  <= high_q[i];
        end
      end
    end

    // Register 2: the rises; without a plane they are 0.
    code_t [TileSize-1:0] rise_x2_q, rise_x3_q;
    code_t [Height-1:0]   rise_y2_q;
    code_t                first2_q, second2_q;
    code_t                dx;
    assign dx = second_q & {CodeBits{plane_q}};

    for (genvar x = 0; x < TileSize; x++) begin : gen_x
      always_ff @(posedge clk_i) begin
        if (valid_q[1]) begin
          rise_x2_q[x] <= rise(dx, x, HalfWidthLog2);
        end
      end
    end
    for (genvar y = 0; y < Height; y++) begin : gen_y
      always_ff @(posedge clk_i) begin
        if (valid_q[1]) begin
          rise_y2_q[y] <= rise(third_q, y, HalfHeightLog2);
        end
      end
    end
    always_ff @(posedge clk_i) begin
      if (valid_q[1]) begin
        first2_q  <= first_q;
        second2_q <= second_q;
      end
    end

    // Register 3: what the samples of a row start from, and those nearer to the greatest: m - offset = m + 1 + ~offset.
    code_t [Height-1:0] row3_q;
    code_t              high3_q;

    for (genvar y = 0; y < Height; y++) begin : gen_row
      always_ff @(posedge clk_i) begin
        if (valid_q[2]) begin
          row3_q[y] <= first2_q + rise_y2_q[y];
        end
      end
    end
    always_ff @(posedge clk_i) begin
      if (valid_q[2]) begin
        rise_x3_q <= rise_x2_q;
        high3_q   <= second2_q + code_t'(1);
      end
    end

    always_comb begin
      for (int unsigned i = 0; i < Samples; i++) begin
        automatic code_t start = high_q[3][i] ? high3_q : row3_q[i/TileSize];
        rows_d[i] = (start + rise_x3_q[i%TileSize] + value_q[3][i])
                    & {{CodeBits/2{~half_q[Last]}}, {CodeBits/2{1'b1}}};
      end
    end
  end else begin : gen_plain_only
    rows_t rows_q [1:3];
    logic  unused;
    assign unused = ^{shift_i, half_q[Last]};

    always_ff @(posedge clk_i) begin
      if (valid_i) begin
        rows_q[1] <= plain;
      end
      for (int unsigned i = 1; i < 3; i++) begin
        if (valid_q[i]) begin
          rows_q[i+1] <= rows_q[i];
        end
      end
    end
    assign rows_d = rows_q[Last];
  end

  // The last register.
  for (genvar i = 0; i < Samples; i++) begin : gen_quad_order
    always_ff @(posedge clk_i) begin
      if (valid_q[Last]) begin
        codes_o[quad_of(i)][sample_of(i)] <= rows_d[i];
      end
    end
  end
  assign valid_o = valid_q[ZDecodeLatency];

`ifndef SYNTHESIS
  ShiftIsCoded: assert property (@(posedge clk_i) disable iff (!rst_ni)
      valid_i && shift_i != '0 |-> half_i ? is_coded(1'b1, 32'(shift_i))
                                          : is_coded(1'b0, 32'(shift_i)))
  else $error("a shift that no line of this format has");
`endif

endmodule
