// Lines of depth on their way to memory, in as few bytes as the better of two forms allows. A line a cycle, and no stall.

module z_encoder
  import raster_pkg::*;
  import z_codec_pkg::*;
(
  input  logic         clk_i,
  input  logic         rst_ni,

  input  logic         valid_i,
  input  logic         half_i,  // unorm16: codes below 2^16
  input  quads_t       codes_i,

  // ZEncodeLatency cycles later.
  output logic         valid_o,
  output coded_shift_t shift_o, // data_o has the line's bytes >> shift_o
  output data_t        data_o   // memory's bytes, 0 behind the last
);

  localparam int unsigned Last = ZEncodeLatency - 1;

  // Bit and element i: in register i, 0 at the input.
  logic [ZEncodeLatency:1] valid_q;
  logic [Last:1]           half_q;
  rows_t                   rows;
  rows_t                   rows_q [1:Last];

  // Loops over samples as in z_decoder. The line by itself, or a simulator fetches it from where it is for each sample.
  always_comb begin
    automatic quads_t codes = codes_i;
    for (int unsigned i = 0; i < Samples; i++) begin
      rows[i] = codes[quad_of(i)][sample_of(i)];
    end
  end

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
      rows_q[1] <= rows;
    end
    for (int unsigned i = 1; i < Last; i++) begin
      if (valid_q[i]) begin
        half_q[i+1] <= half_q[i];
        rows_q[i+1] <= rows_q[i];
      end
    end
  end

  // What the two forms make of it.
  coded_shift_t shift;
  data_t        coded, plain;

  if (is_coded(1'b0, 1)) begin : gen_coded
    logic [MostCodedShift:1] plane_fits, ends_fits;
    code_t base, dx, dy, least, most;
    logic [Samples-1:0] [MostPlaneBits-1:0] plane_offset;
    logic [Samples-1:0] [MostEndsBits-1:0]  ends_offset;
    logic [Samples-1:0]                     high;

    z_encode_plane u_plane (
      .clk_i    (clk_i),
      .valid_i  ({valid_q[4:1], valid_i}),
      .half_i   (half_i),
      .rows_i   (rows),
      .half1_i  (half_q[1]),
      .rows1_i  (rows_q[1]),
      .half5_i  (half_q[5]),
      .first5_i (rows_q[5][0]),
      .fits_o   (plane_fits),
      .base_o   (base),
      .dx_o     (dx),
      .dy_o     (dy),
      .offset_o (plane_offset)
    );

    z_encode_ends u_ends (
      .clk_i    (clk_i),
      .valid_i  ({valid_q[4:1], valid_i}),
      .rows_i   (rows),
      .rows3_i  (rows_q[3]),
      .half4_i  (half_q[4]),
      .fits_o   (ends_fits),
      .least_o  (least),
      .most_o   (most),
      .offset_o (ends_offset),
      .high_o   (high)
    );

    // By format and shift: the line, 0 if it is coded otherwise. What does not fit into its bits is then cut off.
    data_t [1:0] [MostCodedShift:1] line;

    always_comb begin
      shift = '0;
      for (int unsigned s = 1; s <= MostCodedShift; s++) begin
        if (plane_fits[s] || ends_fits[s]) begin
          shift = coded_shift_t'(s);
        end
      end
    end

    for (genvar h = 0; h < 2; h++) begin : gen_format
      for (genvar s = 1; s <= MostCodedShift; s++) begin : gen_shift
        if (is_coded(h, s)) begin : gen_size
          localparam int unsigned Code = code_bits(h);
          localparam int unsigned Plane = plane_bits(h, s);
          localparam int unsigned Ends = ends_bits(h, s) + 1;
          logic this_one;
          data_t plane, ends;

          always_comb begin
            plane           = '0;
            ends            = '0;
            plane[3*Code:0] = {dy[Code-1:0], dx[Code-1:0], base[Code-1:0], 1'b0};
            ends[2*Code:0]  = {most[Code-1:0], least[Code-1:0], 1'b1};
            for (int unsigned i = 0; i < Samples; i++) begin
              plane[1+3*Code+i*Plane+:Plane] = plane_offset[i][Plane-1:0];
              ends[1+2*Code+i*Ends+:Ends]    = Ends'(high[i]) << (Ends - 1) | Ends'(ends_offset[i]);
            end
          end

          assign this_one   = half_q[5] == 1'(h) && shift == coded_shift_t'(s);
          assign line[h][s] = (this_one & plane_fits[s] ? plane : '0)
                              | (this_one & ~plane_fits[s] ? ends : '0);
        end else begin : gen_no_size
          assign line[h][s] = '0;
        end
      end
    end

    always_comb begin
      coded = '0;
      for (int unsigned h = 0; h < 2; h++) begin
        for (int unsigned s = 1; s <= MostCodedShift; s++) begin
          coded |= line[h][s];
        end
      end
    end
  end else begin : gen_plain
    assign shift = '0;
    assign coded = '0;
  end

  // Or it stays as it is.
  always_comb begin
    plain = '0;
    for (int unsigned i = 0; i < Samples; i++) begin
      if (half_q[Last]) begin
        plain[i*(CodeBits/2)+:CodeBits/2] = rows_q[Last][i][CodeBits/2-1:0];
      end else begin
        plain[i*CodeBits+:CodeBits] = rows_q[Last][i];
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_q[Last]) begin
      shift_o <= shift;
      data_o  <= coded | (shift == '0 ? plain : '0);
    end
  end
  assign valid_o = valid_q[ZEncodeLatency];

endmodule
